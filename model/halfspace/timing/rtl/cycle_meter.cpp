#include "halfspace/timing/rtl/cycle_meter.hpp"

#include <utility>

namespace halfspace::rtl {
namespace {

/// Whether a stage spends such a cycle on the packet that it has, not on waiting for the next.
bool of_current(Stage stage, std::size_t activity) {
  const std::size_t reason = activity - 1;
  switch (stage) {
    case Stage::kTileWalker:
      return activity == 0 || reason == stall::kWalkerNoCredit;
    case Stage::kZLookup:
      return activity == 0 || reason >= stall::kLookupWriteBack;
    default:
      return activity == 0;
  }
}

CycleStats* stats_of(DrawContext* draw) { return draw == nullptr ? nullptr : draw->stats(); }

}  // namespace

CycleMeter::CycleMeter(const Config& config, PacketReport& report) : report_(report) {
  const std::array<int, kFifos> capacity = capacities(config);
  for (std::size_t i = 0; i < kLinks; ++i) {
    capacity_[i] = static_cast<std::size_t>(capacity[i]);
    links_[i] = LinkMeter(capacity[i]);
  }
}

void CycleMeter::begins(Stage stage, DrawContext* draw) {
  flush(stage, draw);
  current_[static_cast<std::size_t>(stage)] = draw;
}

void CycleMeter::flush(Stage stage, DrawContext* next) {
  const auto i = static_cast<std::size_t>(stage);
  for (std::size_t activity = 0; activity < kActivities; ++activity) {
    if (counts_[i][activity] != before_[i][activity]) {
      add(i, activity, of_current(stage, activity) ? current_[i] : next);
    }
  }
}

void CycleMeter::add(std::size_t stage, std::size_t activity, DrawContext* draw) {
  const std::uint64_t cycles = counts_[stage][activity] - before_[stage][activity];
  before_[stage][activity] = counts_[stage][activity];
  const auto count = [&](CycleStats& stats) {
    StageCycles& to = stats.stage[stage];
    (activity == 0 ? to.busy : to.stall[activity - 1]) += cycles;
  };
  count(frame_);
  if (CycleStats* const of_draw = stats_of(draw)) {
    count(*of_draw);
  }
}

void CycleMeter::take(Link link, DrawContext* draw, Cycle cycle) {
  const auto i = static_cast<std::size_t>(link);
  if (held_[i].size() == capacity_[i]) {
    report_.differ(fmt::format("link {}: more than its {} credits are in use in cycle {}", kLinkName[i],
                               capacity_[i], cycle));
    held_[i].pop_front();
  }
  held_[i].push_back({.draw = draw, .since = cycle});
}

void CycleMeter::give_back(Link link, Cycle usable) {
  const auto i = static_cast<std::size_t>(link);
  if (held_[i].empty()) {
    report_.differ(
        fmt::format("link {}: a credit comes back before cycle {} that nobody had", kLinkName[i], usable));
    return;
  }
  const Held held = held_[i].front();
  held_[i].pop_front();
  links_[i].add(held.since, usable);
  for (CycleStats* const stats : {&frame_, stats_of(held.draw)}) {
    if (stats != nullptr) {
      stats->held[i] += usable - held.since;
      ++stats->packets[i];
    }
  }
}

void CycleMeter::transfer(std::uint64_t CycleStats::*channel, DrawContext* draw, std::uint64_t cycles) {
  frame_.*channel += cycles;
  if (CycleStats* const of_draw = stats_of(draw)) {
    of_draw->*channel += cycles;
  }
}

CycleStats CycleMeter::finish(Cycle cycles) {
  for (std::size_t i = 0; i < kStages; ++i) {
    flush(static_cast<Stage>(i), nullptr);
  }
  for (std::size_t i = 0; i < kLinks; ++i) {
    frame_.occupancy[i] = links_[i].finish(cycles);
  }
  return std::move(frame_);
}

}  // namespace halfspace::rtl
