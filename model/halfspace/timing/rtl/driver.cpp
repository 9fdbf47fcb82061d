#include "halfspace/timing/rtl/driver.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "halfspace/timing/rtl/rtl_error.hpp"
#include "halfspace/units/link_packets.hpp"
#include "halfspace/units/packing.hpp"

namespace halfspace::rtl {
namespace {

using Cycle = RunState::Cycle;

constexpr int kResetCycles = 2;
/// A machine in which nothing moves for so long, and the longest wait for memory, will not move any more: the
/// longest clear takes a cycle a tile.
Cycle longest_rest(const Config& config) {
  return 2 * Cycle{memory_tiles(config)} +
         4 * static_cast<Cycle>(config.memory.latency + config.late_z.latency);
}

}  // namespace

Driver::Driver(const Frame& frame, RunState& run, PortListener& listener)
    : frame_(frame),
      run_(run),
      listener_(listener),
      source_(frame, run.config, run.options.watch.observer, run.result.surfaces, run.result, run.draws),
      before_(run.config, run.report),
      longest_rest_(longest_rest(run.config)) {
  const int tile_size = run.config.tile_walker.tile_size;
  run.in.triangle.resize(words_for(packed_bits<ScreenTrianglePacket>(run.widths)));
  run.in.state.resize(words_for(packed_bits<DrawStatePacket>(run.widths)));
  run.in.fill.resize(words_for(
      8 * std::min(run.config.memory.read_bytes, tile_size * tile_size * 4 / run.config.z_cache.parts)));
  run.in.late_keep.resize(words_for(tile_size * tile_size));
}

void Driver::run() {
  reset();
  while (!done_) {
    step();
  }
}

/// Cycle 0 is the first in which a triangle could be taken.
void Driver::reset() {
  VerilatedPipeline& pipeline = run_.pipeline;
  run_.in.reset = true;
  for (int i = 0; i < kResetCycles; ++i) {
    pipeline.settle(run_.in, run_.out);
    pipeline.clock_edge();
  }
  run_.in.reset = false;
  pipeline.settle(run_.in, run_.out);
  while (!run_.out.triangle_ready) {
    before_.cycle(run_.out.activity);
    clock_edge();
    pipeline.settle(run_.in, run_.out);
    if (++run_.rest > longest_rest_) {
      throw RtlError("deadlock: triangle_ready_o does not rise after reset");
    }
  }
  run_.rest = 0;
}

void Driver::step() {
  PipelineInputs& in = run_.in;
  const PipelineOutputs& out = run_.out;
  offer();
  listener_.offer_fill();
  in.beat_ready = listener_.sink_ready();
  listener_.answer_late();
  run_.pipeline.settle(in, run_.out);
  ++run_.rest;
  begin_clear_or_flush();
  listener_.begin_packets();
  run_.meter.cycle(out.activity);
  busy_reads_ += in.fill_valid ? 1 : 0;
  busy_writes_ += out.write_valid ? 1 : 0;
  if (in.triangle_valid && out.triangle_ready) {
    run_.rest = 0;
    listener_.take_triangle(item_->triangles[next_in_item_], *item_->draw, state_);
    if (++next_in_item_ == item_->triangles.size()) {
      item_.reset();
    }
    next_arrival_ = run_.cycle + 1;
    in_triangle_ = false;
  }
  if (out.read_valid) {
    listener_.request();  // of the burst before one whose lookup begins in this cycle
  }
  if (out.events != 0) {
    run_.rest = 0;
    listener_.links();
  }
  if (out.beat_valid && in.beat_ready) {
    run_.rest = 0;
    listener_.take_tested_beat();
  }
  if (out.write_valid) {
    listener_.write();
  }
  clock_edge();
  ++run_.cycle;
  end_clear_or_flush();
  if (run_.rest > longest_rest_) {
    const PacketReport& report = run_.report;
    throw RtlError(fmt::format("deadlock in cycle {}: nothing has moved for {} cycles; {} packets differ{}{}",
                               run_.cycle, run_.rest, report.different,
                               report.different == 0 ? "" : ", first: ", report.first));
  }
}

void Driver::clock_edge() {
  run_.pipeline.clock_edge();
  if (run_.pipeline.assertion_failed()) {
    throw RtlError(
        fmt::format("an assertion of the RTL failed in cycle {}: see its message above", run_.cycle));
  }
}

/// What the source offers in this cycle: a triangle, a clear or the flush.
void Driver::offer() {
  PipelineInputs& in = run_.in;
  in.triangle_valid = in.clear_valid = in.flush = false;
  if (waits_for_done_ || run_.cycle < next_arrival_) {
    return;
  }
  while (!item_ && next_command_ <= frame_.commands.size()) {
    if (in_command_) {
      item_ = source_.next();
      next_in_item_ = 0;
      in_command_ = item_.has_value();
    } else if (next_command_ < frame_.commands.size()) {
      source_.begin(next_command_++);
      in_command_ = true;
    } else {
      ++next_command_;  // the end of the frame
    }
  }
  if (!item_) {
    in.flush = true;
  } else if (item_->draw == nullptr) {
    in.clear_valid = true;
    in.clear_first = run_.places[item_->surface].first_tile;
    in.clear_last = in.clear_first + run_.places[item_->surface].tiles - 1;
    in.clear_first_block = run_.blocks[item_->surface].first_block;
    in.clear_last_block = in.clear_first_block + run_.blocks[item_->surface].blocks - 1;
  } else {
    if (!in_triangle_) {
      load_triangle();
    }
    in.triangle_valid = run_.cycle >= next_arrival_;
  }
}

void Driver::load_triangle() {
  const DrawContext& draw = *item_->draw;
  const bool has_depth = draw.surface != kNoSurface;
  const ScreenTriangle& triangle = item_->triangles[next_in_item_];
  state_ = draw_state_packet(
      setup_state(draw.setup, triangle), draw.early_z, has_depth ? run_.places[draw.surface] : ZSurface{},
      has_depth ? run_.blocks[draw.surface] : HiZSurface{}, has_depth ? run_.clear_code[draw.surface] : 0);
  pack(to_packet(triangle, draw.setup), run_.widths, run_.in.triangle);
  pack(state_, run_.widths, run_.in.state);
  next_arrival_ = run_.cycle + run_.options.stalls.cycles(StallPoint::kSource, triangles_++);
  in_triangle_ = true;
}

void Driver::begin_clear_or_flush() {
  if (!run_.out.idle || !(run_.in.clear_valid || run_.in.flush)) {
    return;
  }
  run_.rest = 0;
  waits_for_done_ = true;
  run_.flushing = run_.in.flush;
  if (run_.flushing) {
    listener_.flush();
    return;
  }
  listener_.clear(item_->surface, item_->code);
  item_.reset();
}

void Driver::end_clear_or_flush() {
  if (!waits_for_done_ || !(run_.flushing ? run_.pipeline.flush_done() : run_.pipeline.clear_done())) {
    return;
  }
  waits_for_done_ = false;
  next_arrival_ = run_.cycle;
  done_ = run_.flushing;
}

void Driver::check_counter(std::size_t stage, std::size_t activity, std::uint64_t count) {
  PipelineInputs& in = run_.in;
  in.counter_select = static_cast<std::uint32_t>(stage << kActivityBits | activity);
  in.triangle_valid = in.clear_valid = in.flush = in.fill_valid = in.late_valid = false;
  run_.pipeline.settle(in, run_.out);
  run_.meter.cycle(run_.out.activity);
  clock_edge();
  run_.pipeline.settle(in, run_.out);
  ++run_.report.compared;
  if (run_.out.counter != count) {
    run_.report.differ(fmt::format("counter {} of stage {}: {} cycles were seen, RTL {}", activity, stage,
                                   count, run_.out.counter));
  }
}

void Driver::check_counters() {
  for (std::size_t stage = 0; stage < kStages; ++stage) {
    for (std::size_t activity = 0; activity < kActivities; ++activity) {
      check_counter(stage, activity,
                    before_.counts()[stage][activity] + run_.meter.counts()[stage][activity]);
    }
  }
  check_counter(kStages, 0, busy_reads_);
  check_counter(kStages, 1, busy_writes_);
}

}  // namespace halfspace::rtl
