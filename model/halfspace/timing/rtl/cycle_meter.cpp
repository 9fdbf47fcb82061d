#include "halfspace/timing/rtl/cycle_meter.hpp"

#include <algorithm>

namespace halfspace::rtl {
namespace {

/// Whether a stage spends such a cycle on the packet that it has, not on waiting for the next.
bool of_current(Stage stage, std::size_t activity) {
  const std::size_t reason = activity - 1;
  switch (stage) {
    case Stage::kBlockWalker:
      return activity == 0 || reason == stall::kBlockNoCredit;
    case Stage::kZLookup:
      return activity == 0 || reason >= stall::kLookupWriteBack;
    default:
      return activity == 0;
  }
}

}  // namespace

CycleMeter::CycleMeter(const Config& config, PacketReport& report) : report_(report) {
  const std::array<int, kFifos> capacity = capacities(config);
  for (std::size_t i = 0; i < kLinks; ++i) {
    capacity_[i] = static_cast<std::size_t>(capacity[i]);
    links_[i] = LinkMeter(capacity[i]);
  }
}

void CycleMeter::begins(Stage stage, const DrawContext* draw) {
  flush(stage, draw);
  current_[static_cast<std::size_t>(stage)] = draw;
}

void CycleMeter::flush(Stage stage, const DrawContext* next) {
  const auto i = static_cast<std::size_t>(stage);
  for (std::size_t activity = 0; activity < kActivities; ++activity) {
    if (counts_[i][activity] != before_[i][activity]) {
      add(i, activity, of_current(stage, activity) ? current_[i] : next);
    }
  }
}

void CycleMeter::add(std::size_t stage, std::size_t activity, const DrawContext* draw) {
  const std::uint64_t cycles = counts_[stage][activity] - before_[stage][activity];
  before_[stage][activity] = counts_[stage][activity];
  book_.count(draw, [&](CycleStats& stats) {
    StageCycles& to = stats.stage[stage];
    (activity == 0 ? to.busy : to.stall[activity - 1]) += cycles;
  });
}

void CycleMeter::take(Link link, const DrawContext* draw, Cycle cycle) {
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
  links_[i].add(book_.frame().packets[i], held.since, usable);
  book_.count(held.draw, [&](CycleStats& stats) {
    stats.held[i] += usable - held.since;
    ++stats.packets[i];
  });
}

void CycleMeter::transfer(std::uint64_t CycleStats::*channel, const DrawContext* draw, std::uint64_t cycles) {
  book_.count(draw, [&](CycleStats& stats) { stats.*channel += cycles; });
}

FrameCycles CycleMeter::finish(Cycle cycles, const std::deque<DrawContext>& draws) {
  for (std::size_t i = 0; i < kStages; ++i) {
    flush(static_cast<Stage>(i), nullptr);
  }
  for (std::size_t i = 0; i < kLinks; ++i) {
    book_.frame().occupancy[i] = links_[i].finish(book_.frame().packets[i], cycles);
  }
  const auto count = std::ranges::count_if(draws, [](const DrawContext& draw) { return !draw.is_clear(); });
  return book_.finish(cycles, static_cast<std::size_t>(count));
}

}  // namespace halfspace::rtl
