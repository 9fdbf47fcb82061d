#include "halfspace/timing/systemc/source.hpp"

#include <algorithm>

#include "halfspace/timing/contract.hpp"

namespace halfspace::systemc {
namespace {

/// Triangles that the front end makes in one go.
constexpr std::uint32_t kFrontEndBatch = 256;

}  // namespace

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
        wait(submitted_);
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
  draws_ = 0;
  first_triangle_ = 0;
  triangles_ = 0;
  next_arrival_ = 0;
  const std::vector<Command>& commands = run_.frame->commands;
  draws_of_frame_ = static_cast<std::size_t>(std::count_if(
      commands.begin(), commands.end(), [](const Command& c) { return c.kind == CommandKind::kDraw; }));
  control_.begin_frame();
  depth_written_.assign(run_.result.surfaces.size(), false);
  for (const Command& command : commands) {
    const std::uint32_t surface = run_.frame->targets[command.target].depth_surface;
    if (command.kind == CommandKind::kDraw && command.has(Flag::kDepthWrite) && surface != kNoSurface) {
      depth_written_[surface] = true;
    }
  }
}

/// Waits for the first cycle in which everything has left the pipe, and returns it.
Cycle Source::drain() {
  run_.in_pipe.wait_until_empty();
  const Cycle written = depth->wait_until_written();
  const Cycle from = std::max({control_.idle_from(), written, next_arrival_});
  run_.clock.wait_until(from);
  return from;
}

void Source::end_frame() {
  const Cycle begin = drain();
  const Cycle last = depth->flush(begin);
  run_.clock.wait_until(last + 1);
  control_.end_frame(last + 1);
  in_frame_ = false;
}

void Source::execute(std::uint32_t index) {
  const Command& command = run_.frame->commands[index];
  if (command.kind == CommandKind::kClear) {
    clear(command);
    return;
  }
  draw(command, index);
  if (run_.observer != nullptr) {
    run_.observer->draw_done(draws_, draws_of_frame_);
  }
}

void Source::draw(const Command& command, std::uint32_t index) {
  const Target& target = run_.frame->targets[command.target];
  const std::uint32_t number = target.depth_surface;
  const bool has_depth = number != kNoSurface;
  const DepthFormat format = has_depth ? run_.result.surfaces[number].format : DepthFormat::kNone;
  DrawWork& work = run_.works.emplace_back();
  work.draw = draws_++;
  work.command = index;
  work.surface = number;
  work.first_triangle = first_triangle_;
  work.setup = setup_state(command, target, format, run_.config);
  work.early_z = early_z_state(command, format, run_.config);
  work.keeps_visible = has_depth && !run_.result.surfaces[number].visible.empty() &&
                       (work.early_z.write || !depth_written_[number]);
  if (run_.observer != nullptr) {
    work.record_quads = run_.observer->wants_quads();
    work.record_decisions = run_.observer->wants_decisions();
    work.record_jobs = run_.observer->wants_tile_jobs();
  }
  if (command.has(Flag::kNotFilled)) {
    ++run_.result.draws_not_filled;
  } else {
    draw_triangles(command, work);
  }
  first_triangle_ += command.index_count / 3;
}

void Source::draw_triangles(const Command& command, DrawWork& work) {
  const FrontEnd front_end(*run_.frame, command, work.setup.depth_format, run_.config.sub_pixel_bits);
  const std::uint32_t count = command.index_count / 3;
  for (std::uint32_t first = 0; first < count; first += kFrontEndBatch) {
    batch_.clear();
    for (std::uint32_t i = first; i < count && i - first < kFrontEndBatch; ++i) {
      front_end.process(i, batch_, work.counters.front_end);
    }
    for (const ScreenTriangle& triangle : batch_) {
      give(work, triangle);
    }
  }
}

void Source::give(DrawWork& work, const ScreenTriangle& triangle) {
  run_.in_pipe.add();
  const Cycle arrive = next_arrival_ + run_.stalls.cycles(StallPoint::kSource, triangles_++);
  next_arrival_ = out->take({.work = &work, .triangle = triangle}, arrive) + 1;
}

void Source::clear(const Command& command) {
  const Target& target = run_.frame->targets[command.target];
  if (!command.has(Flag::kClearDepth) || target.depth_surface == kNoSurface) {
    return;
  }
  ++run_.result.clears;
  Surface& surface = run_.result.surfaces[target.depth_surface];
  const PixelRect rect = drawable_rect(command.scissor, target);
  const std::uint32_t code = clear_code(surface.format, command.clear_depth);
  if (!clears_fast(rect, surface, run_.config)) {
    if (!rect.empty()) {
      draw_clear(rect, code, target.depth_surface);
    }
    return;
  }
  const Cycle begin = drain();
  depth->clear(target.depth_surface, code);
  if (!surface.visible.empty()) {
    surface.visible.fill(rect, kNothingVisible);
  }
  const std::uint32_t tiles = run_.places[target.depth_surface].tiles;
  next_arrival_ = begin + static_cast<Cycle>(fast_clear_cycles(tiles, run_.config));
}

void Source::draw_clear(const PixelRect& rect, std::uint32_t code, std::uint32_t surface) {
  const DrawnClear clear = drawn_clear(rect, code, run_.result.surfaces[surface].format, run_.config);
  DrawWork& work = run_.works.emplace_back();
  work.surface = surface;
  work.setup = clear.setup;
  work.early_z = clear.early_z;
  work.keeps_visible = !run_.result.surfaces[surface].visible.empty();
  for (const ScreenTriangle& triangle : clear.triangle) {
    give(work, triangle);
  }
}

}  // namespace halfspace::systemc
