#include "halfspace/timing/record/retime_passes.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <tuple>
#include <utility>

#include "halfspace/machine/surfaces.hpp"
#include "halfspace/numerics/parallel.hpp"
#include "halfspace/timing/record/retime.hpp"
#include "halfspace/timing/recurrence/core.hpp"

namespace halfspace {
namespace {

/// Notes the end of every draw.
struct DrawEnds : ReplayHooks {
  const RecurrenceCore<OneMachine, NoStalls, NoProbe>& core;
  std::vector<std::uint64_t>& ends;

  void end_segment(const StreamSegment& segment, bool bursts) {
    if (segment.kind == StreamSegment::Kind::kDraw) {
      const std::uint64_t before = ends.empty() ? 0 : ends.back();
      ends.push_back(bursts ? core.sink_next() - 1 : before);
    }
  }
};

/// Machines of a group, by index, that share a pass. One by itself is timed in 64 bits.
struct Pass {
  const RetimeGroup* group;
  std::vector<std::size_t> machines;
};

/// Cuts a group into passes of up to `most` machines.
void cut(const RetimeGroup& group, std::span<const Config> configs, std::size_t most,
         std::vector<Pass>& passes) {
  struct Place {
    bool slow;
    std::array<int, kFifos> capacity;
    std::size_t i;
  };
  std::vector<Place> places;
  places.reserve(group.machines.size());
  for (const std::size_t i : group.machines) {
    if (longest_time(*group.work, configs[i]) > std::numeric_limits<std::uint32_t>::max()) {
      passes.push_back({.group = &group, .machines = {i}});
      continue;
    }
    const bool slow = detail::longest_job(configs[i], group.work->most_empty) > detail::kNarrowRoom;
    places.push_back({.slow = slow, .capacity = capacities(configs[i]), .i = i});
  }
  // a pass is as wide as its slowest machine needs, and costs less where capacities are the same
  std::ranges::sort(places, {},
                    [](const Place& place) { return std::tie(place.slow, place.capacity, place.i); });
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (k % most == 0) {
      passes.push_back({.group = &group, .machines = {}});
    }
    passes.back().machines.push_back(places[k].i);
  }
}

/// All groups in passes that have every lane filled, or, where those are too few for the threads, half as
/// many.
std::vector<Pass> cut_all(std::span<const RetimeGroup> groups, std::span<const Config> configs, int threads) {
  const std::size_t most = detail::pass_machines();
  std::vector<Pass> passes;
  for (const RetimeGroup& group : groups) {
    cut(group, configs, most, passes);
  }
  if (passes.size() < static_cast<std::size_t>(threads)) {
    passes.clear();
    for (const RetimeGroup& group : groups) {
      cut(group, configs, most / 2, passes);
    }
  }
  return passes;
}

void run(const Pass& pass, std::span<const Config> configs, std::span<RetimedFrame> results) {
  const RetimeGroup& group = *pass.group;
  if (pass.machines.size() == 1) {
    const std::size_t i = pass.machines.front();
    results[i] = retime_one(*group.record, *group.trace, configs[i]);
    return;
  }
  std::vector<Config> machines;
  machines.reserve(pass.machines.size());
  for (const std::size_t i : pass.machines) {
    machines.push_back(configs[i]);
  }
  std::vector<RetimedFrame> retimed(machines.size());
  detail::retime_lanes(*group.record, *group.trace, machines, group.work->most_empty, retimed.data());
  for (std::size_t k = 0; k < retimed.size(); ++k) {
    results[pass.machines[k]] = std::move(retimed[k]);
  }
}

}  // namespace

RetimedFrame retime_one(const FrameRecord& record, const ZTrace& trace, const Config& config) {
  NoProbe probe;
  RecurrenceMemory<OneMachine> memory = recurrence_memory(config, trace.rows);
  RecurrenceCore<OneMachine, NoStalls, NoProbe> core(memory, NoStalls{}, probe);
  RetimedFrame result;
  DrawEnds hooks{{}, core, result.draw_end};
  bool bursts = false;
  replay(whole_stream(record, trace), core, hooks, bursts, [&](std::uint32_t surface) {
    return static_cast<std::uint64_t>(fast_clear_cycles(record.surfaces[surface].tiles, config));
  });
  result.cycles = core.flush(trace.flush, static_cast<std::uint32_t>(config.z_cache.lines));
  return result;
}

void retime_groups(std::span<const RetimeGroup> groups, std::span<const Config> configs, int threads,
                   std::span<RetimedFrame> results) {
  const std::vector<Pass> passes = cut_all(groups, configs, threads);
  parallel_for(passes.size(), threads, [&](std::size_t i) { run(passes[i], configs, results); });
}

}  // namespace halfspace
