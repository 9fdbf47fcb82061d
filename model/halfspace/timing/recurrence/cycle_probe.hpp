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

  void decide(Cycle cull_next, Cycle free, Cycle head, Cycle divider, Cycle decide) {
    link(Link::kSetupQueue, cull_next - 1, decide + 1);
    split<3>(Stage::kSetup, free, {head, divider, decide}, 1);
    note(&PacketTimes::decide, decide);
  }

  void accept(Cycle decide, Cycle free, Cycle taken) {
    link(Link::kSetup, decide, taken);
    if (taken > free) {
      split<2>(Stage::kTileWalker, free, {taken - 1, taken}, 0);
    }
    note(&PacketTimes::accept, taken - 1);
  }

  void emit(Cycle free, Cycle stepped, Cycle emitted, Cycle back) {
    link(Link::kTileWalker, emitted - 1, back);
    busy(Stage::kTileWalker, free, stepped);
    wait(Stage::kTileWalker, stall::kWalkerNoCredit, stepped, emitted);
    note(&PacketTimes::emit, emitted - 1);
  }

  void walked(Cycle free, Cycle done) { busy(Stage::kTileWalker, free, done); }

  void edge(Cycle free, Cycle visible, Cycle e, Cycle back) {
    link(Link::kEdgeEvaluator, e, back);
    split<2>(Stage::kEdgeEvaluator, free, {visible, e}, 1);
    note(&PacketTimes::e, e);
  }

  void quad(Cycle free, Cycle visible, Cycle g, Cycle beats) {
    split<2>(Stage::kQuadGenerator, free, {visible, g}, beats);
    note(&PacketTimes::g, g);
  }

  void lookup(Cycle g, Cycle free, Cycle visible, Cycle f, Cycle moved) {
    link(Link::kQuadGenerator, g, moved);
    split<2>(Stage::kZLookup, free, {visible, f}, moved - f);
    note(&PacketTimes::f, f);
  }

  /// A missing part that could be resolved from `ready` on was out of the cache from `out` on, and resolved
  /// in `r`, when a fill buffer was free; of these cycles those count in which no beat moves any more, from
  /// `moved` on. In that of the last part the next burst may be taken already: it is not this one's.
  void request(Cycle moved, Cycle ready, Cycle out, Cycle r, bool last) {
    const auto after = [moved](Cycle cycle) { return std::max(cycle, moved); };
    wait(Stage::kZLookup, stall::kLookupWriteBack, after(ready), after(out));
    wait(Stage::kZLookup, stall::kLookupFillBuffers, after(out), after(r));
    wait(Stage::kZLookup, stall::kLookupRequest, after(r), after(last ? r : r + 1));
  }

  void test(Cycle f, Cycle free, Cycle filled, Cycle slots, Cycle b, Cycle beats) {
    link(Link::kEarlyZPending, f, b + beats);
    split<4>(Stage::kZTest, free, {f + kLookupLatency, filled, slots, b}, beats);
    note(&PacketTimes::b, b);
  }

  void sink(Cycle b, Cycle y, Cycle next) {
    link(Link::kEarlyZ, b, next);
    if (in_draw_) {
      draws_.back().end = end_ = next - 1;
    }
    note(&PacketTimes::y, y);
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

  void link(Link which, Cycle take, Cycle back) {
    const auto i = static_cast<std::size_t>(which);
    meter_[i].add(take, back);
    here().held[i] += back - take;
    ++here().packets[i];
    if constexpr (kObserved) {
      observer_->link(which, take, back);
    }
  }

  void note(std::vector<Cycle> PacketTimes::*stream, Cycle cycle) {
    if (times_ != nullptr) {
      (times_->*stream).push_back(cycle);
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
