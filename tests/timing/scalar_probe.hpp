/// What CycleProbe and LinkMeter find, packet by packet and event by event: slow, and plain enough to be
/// believed.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "halfspace/machine/draw_context.hpp"
#include "halfspace/timing/cycle_stats.hpp"
#include "halfspace/timing/recurrence/machine.hpp"

namespace halfspace::testing {

/// Occupancy of a link: credits are taken and returned in the order of their cycles.
class EventMeter {
 public:
  EventMeter() = default;
  explicit EventMeter(int capacity) : cycles_(static_cast<std::size_t>(capacity) + 1) {}

  void add(std::uint64_t take, std::uint64_t back) {
    return_up_to(take);
    pass(take);
    back_.push_back(back);
  }

  Occupancy finish(std::uint64_t end) {
    return_up_to(end);
    pass(end);
    return cycles_;
  }

 private:
  void return_up_to(std::uint64_t cycle) {
    while (!back_.empty() && back_.front() <= cycle) {
      pass(back_.front());
      back_.pop_front();
    }
  }
  void pass(std::uint64_t cycle) {
    cycles_.at(back_.size()) += cycle - last_;
    last_ = cycle;
  }

  Occupancy cycles_;
  std::deque<std::uint64_t> back_;  ///< of the packets that hold a credit
  std::uint64_t last_ = 0;
};

/// A probe that believes the terms alone, not how far the core says it is.
class ScalarProbe {
 public:
  static constexpr bool kLooks = true;
  using Cycle = std::uint64_t;

  explicit ScalarProbe(const std::array<int, kFifos>& capacity) {
    for (std::size_t i = 0; i < kLinks; ++i) {
      meter_[i] = EventMeter(capacity[i]);
    }
  }

  void draw(std::uint32_t index, const Progress<Cycle>& /*at*/) {
    in_draw_ = index != kNoDraw;
    if (in_draw_) {
      draws_.push_back({.end = end_, .stats = {}});
    }
  }
  void drained(const Progress<Cycle>& /*at*/) { in_draw_ = false; }

  template <std::size_t N>
  void split(Stage which, Cycle free, const std::array<Cycle, N>& until, Cycle busy_for) {
    Cycle at = free;
    for (std::size_t i = 0; i < N; ++i) {
      const Cycle to = std::max(at, until[i]);
      wait(which, i, at, to);
      at = to;
    }
    busy(which, at, at + busy_for);
  }
  void busy(Stage which, Cycle from, Cycle to) { stage(which).busy += to - from; }
  void wait(Stage which, std::size_t reason, Cycle from, Cycle to) {
    stage(which).stall[reason] += to - from;
  }

  void link(Link which, std::uint64_t /*n*/, Cycle take, Cycle back) {
    const auto i = static_cast<std::size_t>(which);
    meter_[i].add(take, back);
    here().held[i] += back - take;
    ++here().packets[i];
    if (which == Link::kEarlyZ && in_draw_) {
      draws_.back().end = end_ = back - 1;
    }
  }
  void note(std::vector<Cycle> PacketTimes::*stream, Cycle cycle) { (times.*stream).push_back(cycle); }
  void read(Cycle cycles, Cycle /*end*/) { here().read_busy += cycles; }
  void write(Cycle cycles, Cycle /*end*/) { here().write_busy += cycles; }

  FrameCycles finish(Cycle cycles, const Progress<Cycle>& /*at*/) {
    FrameCycles frame{.cycles = cycles, .stats = outside_, .draws = draws_};
    for (const DrawCycles& draw : draws_) {
      frame.stats += draw.stats;
    }
    for (StageCycles& stage : frame.stats.stage) {
      stage.stall[stall::kNoInput] += cycles - stage.total();
    }
    for (std::size_t i = 0; i < kLinks; ++i) {
      frame.stats.occupancy[i] = meter_[i].finish(cycles);
    }
    return frame;
  }

  PacketTimes times;

 private:
  CycleStats& here() { return in_draw_ ? draws_.back().stats : outside_; }
  StageCycles& stage(Stage which) { return here().stage[static_cast<std::size_t>(which)]; }

  std::array<EventMeter, kLinks> meter_;
  std::vector<DrawCycles> draws_;
  CycleStats outside_;
  bool in_draw_ = false;
  Cycle end_ = 0;
};

}  // namespace halfspace::testing
