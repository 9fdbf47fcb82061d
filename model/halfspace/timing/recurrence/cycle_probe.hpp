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
/// order of the stall reasons. Packets are told one after the other, and most of what is told only goes into
/// the sums of the draw that runs; the rest follows from how far the machine is where the draw ends. With
/// kEach there is somebody who wants packets one by one: a type of its own, because even to ask for a pointer
/// at every packet costs time.
template <bool kEach>
class CycleProbe {
 public:
  static constexpr bool kLooks = true;
  using Cycle = std::uint64_t;

  /// With kEach, `times` or `observer` may be null; without, nobody asks for them.
  explicit CycleProbe(const std::array<int, kFifos>& capacity, PacketTimes* times = nullptr,
                      CycleObserver* observer = nullptr)
      : times_(times), observer_(observer) {
    for (std::size_t i = 0; i < kLinks; ++i) {
      meter_[i] = LinkMeter(capacity[i]);
    }
  }

  /// What follows belongs to this draw, or to none. `at`: how far the machine is.
  void draw(std::uint32_t index, const Progress<Cycle>& at) {
    close(at);
    in_draw_ = index != kNoDraw;
    if (in_draw_) {
      draws_.push_back({.end = end_, .stats = {}});
    }
    if (observed()) {
      observer_->draw(index);
    }
  }

  /// The next job is the tile whose top left pixel this is.
  void tile(const StreamTile& tile) {
    if (observed()) {
      observer_->tile(tile.x, tile.y);
    }
  }

  // What the stages tell, each in the order of its packets. Terms are first cycles and exclusive ends.

  /// From `free` on the stage waited: for its first reason until cycle `until[0]`, then for its second until
  /// until[1], ...; then it was busy.
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

  void busy(Stage which, Cycle from, Cycle to) {
    stage(now_, which).busy += to - from;
    tell(which, std::nullopt, from, to);
  }

  void wait(Stage which, std::size_t reason, Cycle from, Cycle to) {
    if (reason != no_credit(which)) {
      stage(now_, which).stall[reason] += to - from;
    }
    tell(which, reason, from, to);
  }

  /// Packet n of `which` holds its credit.
  void link(Link which, std::uint64_t n, Cycle take, Cycle back) {
    meter_[static_cast<std::size_t>(which)].add(n, take, back);
    if (observed()) {
      observer_->link(which, take, back);
    }
  }

  /// The next packet of a list of PacketTimes.
  void note(std::vector<Cycle> PacketTimes::*stream, Cycle cycle) {
    if (kEach && times_ != nullptr) {
      (times_->*stream).push_back(cycle);
    }
  }

  /// A line has come from memory, or gone there, in so many cycles before `end`.
  void read(Cycle cycles, Cycle end) {
    now_.read_busy += cycles;
    transfer(CycleObserver::Channel::kRead, cycles, end);
  }
  void write(Cycle cycles, Cycle end) {
    now_.write_busy += cycles;
    transfer(CycleObserver::Channel::kWrite, cycles, end);
  }

  /// What follows, the flush, belongs to no draw, and no packet moves any more.
  void drained(const Progress<Cycle>& at) {
    close(at);
    in_draw_ = false;
    if (observed()) {
      observer_->drained();
    }
  }

  /// `at`: how far the machine is after the flush.
  FrameCycles finish(Cycle cycles, const Progress<Cycle>& at) {
    close(at);
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
      sum.occupancy[i] = meter_[i].finish(sum.packets[i], cycles);
    }
    return frame;
  }

 private:
  static constexpr StageCycles& stage(CycleStats& stats, Stage which) {
    return stats.stage[static_cast<std::size_t>(which)];
  }

  /// The reason that gets what is left: all cycles in which the stage is not busy, and does not wait for
  /// anything but a credit of the link that it fills.
  static constexpr std::size_t no_credit(Stage which) {
    constexpr std::array kReason{
        stall::kSetupNoCredit,     stall::kBlockNoCredit, stall::kHiZNoCredit,
        stall::kTileNoCredit,      stall::kEdgeNoCredit,  stall::kQuadNoCredit,
        stall::kLookupPendingFull, stall::kTestNoCredit,  stall::kInterpolatorNoCredit};
    static_assert(kReason.size() == kStages);
    return kReason[static_cast<std::size_t>(which)];
  }

  /// What ran until the machine was so far goes to its draw.
  void close(const Progress<Cycle>& at) {
    for (std::size_t i = 0; i < kStages; ++i) {
      StageCycles& cycles = now_.stage[i];
      cycles.stall[no_credit(static_cast<Stage>(i))] = at.free[i] - begin_.free[i] - cycles.total();
    }
    for (std::size_t i = 0; i < kLinks; ++i) {
      now_.held[i] = meter_[i].held(at.packets[i]);
      now_.packets[i] = at.packets[i] - begin_.packets[i];
    }
    if (in_draw_ && now_.packets[static_cast<std::size_t>(Link::kEarlyZ)] != 0) {
      draws_.back().end = end_ = at.sink_next - 1;
    }
    (in_draw_ ? draws_.back().stats : outside_) += now_;
    now_ = {};
    begin_ = at;
  }

  [[nodiscard]] bool observed() const { return kEach && observer_ != nullptr; }

  void tell(Stage which, std::optional<std::size_t> reason, Cycle from, Cycle to) {
    if (observed() && from != to) {
      observer_->slice(which, reason, from, to);
    }
  }

  void transfer(CycleObserver::Channel channel, Cycle cycles, Cycle end) {
    if (observed()) {
      observer_->transfer(channel, end - cycles, end);
    }
  }

  PacketTimes* times_;
  CycleObserver* observer_;
  std::array<LinkMeter, kLinks> meter_;
  CycleStats now_;           ///< of what runs now
  Progress<Cycle> begin_{};  ///< how far the machine was before
  std::vector<DrawCycles> draws_;
  CycleStats outside_;  ///< of what belongs to no draw
  bool in_draw_ = false;
  Cycle end_ = 0;  ///< of the last draw that had a burst
};

}  // namespace halfspace
