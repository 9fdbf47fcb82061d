#include "halfspace/timing/systemc/source.hpp"

#include <algorithm>

#include "halfspace/timing/contract.hpp"

namespace halfspace::systemc {

Source::Source(const sc_core::sc_module_name& name, RunState& run, FrameControl& control)
    : sc_module(name), out("out"), depth("depth"), run_(run), control_(control) {
  SC_THREAD(execute_commands);
  set_stack_size(kStackBytes);
}

void Source::submit(std::uint32_t command) {
  commands_.push_back(command);
  submitted_.notify();
}

void Source::submit_end() { submit(kEnd); }

void Source::wait_until_idle() {
  while (!commands_.empty()) {
    wait(finished_);
  }
}

std::string Source::describe() const {
  if (commands_.empty()) {
    return "waits for a command";
  }
  return commands_.front() == kEnd ? "at the end of the frame"
                                   : "at command " + std::to_string(commands_.front());
}

void Source::execute_commands() {
  run_.guard([&] {
    for (;;) {
      while (commands_.empty()) {
        run_.clock.wait_for(submitted_);
      }
      if (!in_frame_) {
        begin_frame();
      }
      next_arrival_ = std::max(next_arrival_, run_.clock.now());
      if (commands_.front() == kEnd) {
        end_frame();
      } else {
        execute(commands_.front());
      }
      commands_.pop_front();
      ++done_;
      if (commands_.empty()) {
        finished_.notify();
      }
    }
  });
}

void Source::begin_frame() {
  in_frame_ = true;
  done_ = 0;
  triangles_ = 0;
  next_arrival_ = 0;
  control_.begin_frame();
  frame_.emplace(*run_.frame, run_.config, run_.observer, run_.result.surfaces, run_.result, run_.draws);
}

/// Waits for the first cycle in which everything has left the pipe, and returns it.
Cycle Source::drain() {
  run_.in_pipe.wait_until_empty(run_.clock);
  control_.write_all_late(next_arrival_);
  const Cycle written = depth->wait_until_written();
  const Cycle from = std::max({control_.idle_from(), written, next_arrival_});
  run_.clock.wait_until(from);
  return from;
}

void Source::end_frame() {
  const Cycle drained = drain();
  const Cycle last = depth->flush(std::max(drained, control_.hi_z_out()));
  run_.clock.wait_until(last + 1);
  control_.end_frame(last + 1);
  in_frame_ = false;
}

void Source::execute(std::uint32_t index) {
  frame_->begin(index);
  while (const std::optional<SourceItem> item = frame_->next()) {
    if (item->draw == nullptr) {
      fast_clear(item->surface, item->code);
    }
    for (const ScreenTriangle& triangle : item->triangles) {
      give(*item->draw, triangle);
    }
  }
}

void Source::give(DrawContext& draw, const ScreenTriangle& triangle) {
  run_.in_pipe.add();
  const Cycle arrive = next_arrival_ + run_.stalls.cycles(StallPoint::kSource, triangles_++);
  next_arrival_ = out->take({.draw = &draw, .triangle = triangle}, arrive) + 1;
}

void Source::fast_clear(std::uint32_t surface, std::uint32_t code) {
  const Cycle begin = control_.clear_hi_z(surface, code, drain());
  depth->clear(surface, code);
  clear_surface(run_.result.surfaces[surface], code);
  const std::uint32_t tiles = run_.places[surface].tiles;
  next_arrival_ = begin + static_cast<Cycle>(fast_clear_cycles(tiles, run_.config));
}

}  // namespace halfspace::systemc
