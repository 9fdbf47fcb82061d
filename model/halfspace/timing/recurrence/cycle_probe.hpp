/// Turns the terms of the recurrence into stall reasons, occupancies and times of packets.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "halfspace/machine/draw_context.hpp"
#include "halfspace/machine/packet_stream.hpp"
#include "halfspace/timing/cycle_observer.hpp"
#include "halfspace/timing/cycle_stats.hpp"
#include "halfspace/timing/link_meter.hpp"
#include "halfspace/timing/recurrence/machine.hpp"

namespace halfspace {

/// What RecurrenceCore tells. Every stage's cycles are split at the terms that held its packet back, in the
/// order of the stall reasons. With kObserved there is somebody who wants them one by one: a type of its own,
/// because even to ask for a pointer at every packet costs time.
template <bool kObserved>
class CycleProbe {
 public:
  static constexpr bool kLooks = true;
  using Cycle = std::uint64_t;

  /// `times` may be null, and without kObserved `observer` too.
  CycleProbe(const std::array<int, kFifos>& capacity, PacketTimes* times, CycleObserver* observer)
      : times_(times), observer_(observer) {
    for (std::size_t i = 0; i < kLinks; ++i) {
      meter_[i] = LinkMeter(capacity[i]);
    }
  }

  /// What follows belongs to this draw, or to none.
  void draw(std::uint32_t index) {
    in_draw_ = index != kNoDraw;
    if (in_draw_) {
      draws_.push_back({.end = end_, .stats = {}});
    }
    if constexpr (kObserved) {
      observer_->draw(index);
    }
  }

  /// The next job is the tile whose top left pixel this is.
  void tile(const StreamTile& tile) {
    if constexpr (kObserved) {
      observer_->tile(tile.x, tile.y);
    }
  }

  // What the stages tell, each in the order of its packets. Terms are first cycles and exclusive ends.

  /// From `free` on the stage waited: for its first reason until cycle `until[0]`, then for its second until
  /// until[1], ...; then it was busy.
  template <std::size_t N>
  void split(Stage which, Cycle free, const std::array<Cycle, N>& until, Cycle busy) {
    StageCycles& cycles = stage(which);
    Cycle at = free;
    for (std::size_t i = 0; i < N; ++i) {
      const Cycle to = std::max(at, until[i]);
      cycles.stall[i] += to - at;
      tell(which, i, at, to);
      at = to;
    }
    cycles.busy += busy;
    tell(which, std::nullopt, at, at + busy);
  }

  void busy(Stage which, Cycle from, Cycle to) {
    stage(which).busy += to - from;
    tell(which, std::nullopt, from, to);
  }

  void wait(Stage which, std::size_t reason, Cycle from, Cycle to) {
    stage(which).stall[reason] += to - from;
    tell(which, reason, from, to);
  }

  /// The next packet of `which` holds its credit.
  void link(Link which, Cycle take, Cycle back) {
    const auto i = static_cast<std::size_t>(which);
    meter_[i].add(take, back);
    here().held[i] += back - take;
    ++here().packets[i];
    if constexpr (kObserved) {
      observer_->link(which, take, back);
    }
  }

  /// The next packet of a list of PacketTimes.
  void note(std::vector<Cycle> PacketTimes::*stream, Cycle cycle) {
    if (times_ != nullptr) {
      (times_->*stream).push_back(cycle);
    }
  }

  /// The last beat of a burst is in the sink in the cycle before `next`.
  void burst_left(Cycle next) {
    if (in_draw_) {
      draws_.back().end = end_ = next - 1;
    }
  }

  /// A line has come from memory, or gone there, in so many cycles before `end`.
  void read(Cycle cycles, Cycle end) {
    here().read_busy += cycles;
    transfer(CycleObserver::Channel::kRead, cycles, end);
  }
  void write(Cycle cycles, Cycle end) {
    here().write_busy += cycles;
    transfer(CycleObserver::Channel::kWrite, cycles, end);
  }

  /// What follows, the flush, belongs to no draw.
  void drained() {
    in_draw_ = false;
    if constexpr (kObserved) {
      observer_->drained();
    }
  }

  FrameCycles finish(Cycle cycles) {
    FrameCycles frame{.cycles = cycles, .stats = std::move(outside_), .draws = std::move(draws_)};
    CycleStats& sum = frame.stats;
    for (const DrawCycles& draw : frame.draws) {
      sum += draw.stats;
    }
    for (std::size_t i = 0; i < kStages; ++i) {
      const Cycle last = sum.stage[i].total();
      sum.stage[i].stall[stall::kNoInput] += cycles - last;
      tell(static_cast<Stage>(i), stall::kNoInput, last, cycles);
    }
    for (std::size_t i = 0; i < kLinks; ++i) {
      sum.occupancy[i] = meter_[i].finish(cycles);
    }
    return frame;
  }

 private:
  [[nodiscard]] CycleStats& here() { return in_draw_ ? draws_.back().stats : outside_; }
  [[nodiscard]] StageCycles& stage(Stage which) { return here().stage[static_cast<std::size_t>(which)]; }

  void tell(Stage which, std::optional<std::size_t> reason, Cycle from, Cycle to) {
    if constexpr (kObserved) {
      if (from != to) {
        observer_->slice(which, reason, from, to);
      }
    }
  }

  void transfer(CycleObserver::Channel channel, Cycle cycles, Cycle end) {
    if constexpr (kObserved) {
      observer_->transfer(channel, end - cycles, end);
    }
  }

  PacketTimes* times_;
  CycleObserver* observer_;
  std::array<LinkMeter, kLinks> meter_;
  std::vector<DrawCycles> draws_;
  CycleStats outside_;
  bool in_draw_ = false;
  Cycle end_ = 0;
};

}  // namespace halfspace
