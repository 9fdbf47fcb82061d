#include "halfspace/timing/record/retime.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <tuple>
#include <utility>

#include "halfspace/machine/surfaces.hpp"
#include "halfspace/numerics/error.hpp"
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

/// On the machine whose z cache is that of `trace`.
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

}  // namespace

void check_retimable(const FrameRecord& record, const Config& config) {
  if (same_packets(record.config, config)) {
    return;
  }
  const std::vector<ConfigKey> recorded = config_keys(record.config);
  const std::vector<ConfigKey> wanted = config_keys(config);
  for (std::size_t i = 0; i < recorded.size(); ++i) {
    if (!recorded[i].timing && recorded[i].value != wanted[i].value) {
      throw InputError(
          fmt::format("configuration key '{}' is {}, the record of {} was made with {}: it changes packets, "
                      "not only their cycles; legal: {}, or a new record",
                      recorded[i].name, wanted[i].value, record.name, recorded[i].value, recorded[i].value));
    }
  }
}

Retimer::Retimer(FrameRecord record) : record_(std::move(record)) {
  for (const StreamJob& job : record_.packets.jobs) {
    most_steps_ = std::max(most_steps_, job.steps());
  }
  for (const StreamTriangle& triangle : record_.packets.triangles) {
    most_steps_ = std::max(most_steps_, triangle.steps_after);
  }
  traced(z_cache_shape(record_.config));
}

const Retimer::Traced& Retimer::traced(const ZCacheShape& shape) {
  for (const Traced& known : traced_) {
    if (known.shape == shape) {
      return known;
    }
  }
  ZTrace trace = trace_z_cache(record_, shape);
  FrameWork work;
  work.add(whole_stream(record_, trace), record_.surfaces);
  work.flush = trace.flush;
  DrawWork sum = work.sum();
  traced_.push_back({.shape = shape, .trace = std::move(trace), .work = std::move(work), .sum = sum});
  return traced_.back();
}

RetimedFrame Retimer::retime(const Config& config) {
  check_retimable(record_, config);
  return retime_one(record_, traced(z_cache_shape(config)).trace, config);
}

AnalyticFrame Retimer::analytic(const Config& config) {
  check_retimable(record_, config);
  return analytic_frame(traced(z_cache_shape(config)).work, config);
}

void Retimer::retime_group(const Traced& known, std::span<const Config> configs,
                           std::span<const std::size_t> group, std::span<RetimedFrame> results) const {
  struct Place {
    bool slow;
    std::array<int, kFifos> capacity;
    std::size_t i;
  };
  std::vector<Place> places;
  places.reserve(group.size());
  for (const std::size_t i : group) {
    const bool slow = detail::longest_job(configs[i], most_steps_) > detail::kNarrowRoom;
    places.push_back({.slow = slow, .capacity = capacities(configs[i]), .i = i});
  }
  // a pass is as wide as its slowest machine needs, and costs less where capacities are the same
  std::ranges::sort(places, {},
                    [](const Place& place) { return std::tie(place.slow, place.capacity, place.i); });
  std::vector<Config> machines;
  machines.reserve(places.size());
  for (const Place& place : places) {
    machines.push_back(configs[place.i]);
  }
  std::vector<RetimedFrame> retimed(places.size());
  detail::retime_lanes(record_, known.trace, machines, most_steps_, retimed.data());
  for (std::size_t k = 0; k < places.size(); ++k) {
    results[places[k].i] = std::move(retimed[k]);
  }
}

std::vector<RetimedFrame> Retimer::retime(std::span<const Config> configs) {
  for (const Config& config : configs) {
    check_retimable(record_, config);
  }
  std::vector<RetimedFrame> results(configs.size());
  std::vector<bool> done(configs.size(), false);
  for (std::size_t first = 0; first < configs.size(); ++first) {
    if (done[first]) {
      continue;
    }
    const Traced& known = traced(z_cache_shape(configs[first]));
    std::vector<std::size_t> group;  // positions of what shares its z cache
    for (std::size_t i = first; i < configs.size(); ++i) {
      if (done[i] || z_cache_shape(configs[i]) != known.shape) {
        continue;
      }
      done[i] = true;
      if (detail::longest_time(known.work, known.sum, configs[i]) >
          std::numeric_limits<std::uint32_t>::max()) {
        results[i] = retime_one(record_, known.trace, configs[i]);  // needs 64 bits
      } else {
        group.push_back(i);
      }
    }
    retime_group(known, configs, group, results);
  }
  return results;
}

namespace detail {

std::uint64_t longest_job(const Config& config, std::uint32_t most_steps) {
  const Machine<std::uint64_t> m = machine(config);
  const int tile = config.tile_walker.tile_size;
  const auto line = static_cast<std::size_t>(
      std::countr_zero(static_cast<unsigned>(tile * tile * 4 / config.z_cache.parts)));
  const auto quads = static_cast<std::size_t>(tile * tile / 4);
  const auto parts = static_cast<std::uint64_t>(config.z_cache.parts);
  // up to two walks, the job's own and that after the last job before
  return 2 * std::uint64_t{most_steps} * m.step_interval +
         static_cast<std::uint64_t>(sum_of_latencies(config)) + 16 + m.quad_beats[quads] +
         m.test_beats[quads] + parts * (m.memory_latency + m.read_cycles[line] + m.write_cycles[line] + 8);
}

std::uint64_t longest_time(const FrameWork& work, const DrawWork& sum, const Config& config) {
  const Machine<std::uint64_t> m = machine(config);
  std::uint64_t time = static_cast<std::uint64_t>(config.z_cache.lines) + 64;
  for (const std::uint32_t tiles : work.fast_clears) {
    time += static_cast<std::uint64_t>(fast_clear_cycles(tiles, config));
  }
  // 16 and 4: the cycles in which credits travel, and more than that
  const auto through = static_cast<std::uint64_t>(sum_of_latencies(config));
  const std::uint64_t each_job = through + 16;
  for (std::size_t quads = 0; quads < sum.tiles.size(); ++quads) {
    time += sum.tiles[quads] * (each_job + m.quad_beats[quads] + m.test_beats[quads]);
  }
  const std::uint64_t each_triangle = through + m.setup_interval + 4;
  time += sum.triangles * each_triangle + sum.steps * m.step_interval;
  for (std::size_t i = 0; i < sum.fetched.size(); ++i) {
    time += sum.fetched[i] * (m.memory_latency + m.read_cycles[i] + 4) +
            sum.written_back[i] * (m.write_cycles[i] + 4);
  }
  return time + work.flush.size() * (m.write_cycles.back() + 4);
}

}  // namespace detail
}  // namespace halfspace
