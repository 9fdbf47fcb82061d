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

/// Positions of the machines that share the shape of the z cache. Throws as check_retimable.
std::vector<std::vector<std::size_t>> groups(const FrameRecord& record, std::span<const Config> configs) {
  std::vector<std::vector<std::size_t>> groups;
  std::vector<ZCacheShape> shapes;
  for (std::size_t i = 0; i < configs.size(); ++i) {
    check_retimable(record, configs[i]);
    const ZCacheShape shape = z_cache_shape(configs[i]);
    const auto at = static_cast<std::size_t>(std::ranges::find(shapes, shape) - shapes.begin());
    if (at == shapes.size()) {
      shapes.push_back(shape);
      groups.emplace_back();
    }
    groups[at].push_back(i);
  }
  return groups;
}

/// Fills the `results` of a group, whose z cache is that of `trace`.
void retime_group(const FrameRecord& record, const ZTrace& trace, const FrameWork& work,
                  std::span<const Config> configs, std::span<const std::size_t> group,
                  std::span<RetimedFrame> results) {
  struct Place {
    bool slow;
    std::array<int, kFifos> capacity;
    std::size_t i;
  };
  std::vector<Place> places;
  places.reserve(group.size());
  for (const std::size_t i : group) {
    const bool wide = longest_time(work, configs[i]) > std::numeric_limits<std::uint32_t>::max();
    if (wide || group.size() == 1) {  // it needs 64 bits, or is faster without lanes
      results[i] = retime_one(record, trace, configs[i]);
      continue;
    }
    const bool slow = detail::longest_job(configs[i], work.most_steps) > detail::kNarrowRoom;
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
  detail::retime_lanes(record, trace, machines, work.most_steps, retimed.data());
  for (std::size_t k = 0; k < places.size(); ++k) {
    results[places[k].i] = std::move(retimed[k]);
  }
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

Retimer::Retimer(FrameRecord record) : record_(std::move(record)) { traced(z_cache_shape(record_.config)); }

Retimer::Traced& Retimer::traced(const ZCacheShape& shape) {
  for (Traced& known : traced_) {
    if (known.shape == shape) {
      return known;
    }
  }
  ZTrace trace = trace_z_cache(record_, shape);
  const FrameWork work = frame_work(whole_stream(record_, trace), record_.surfaces, trace.flush);
  traced_.push_back({.shape = shape, .trace = std::move(trace), .work = work});
  return traced_.back();
}

RetimedFrame Retimer::retime(const Config& config) {
  check_retimable(record_, config);
  return retime_one(record_, traced(z_cache_shape(config)).trace, config);
}

std::vector<RetimedFrame> Retimer::retime(std::span<const Config> configs) {
  std::vector<RetimedFrame> results(configs.size());
  for (const std::vector<std::size_t>& group : groups(record_, configs)) {
    const Traced& known = traced(z_cache_shape(configs[group.front()]));
    retime_group(record_, known.trace, known.work, configs, group, results);
  }
  return results;
}

std::vector<std::uint64_t> Retimer::estimate(std::span<const Config> configs) {
  if (!sample_) {
    sample_.emplace(record_);
  }
  std::vector<std::uint64_t> cycles(configs.size());
  if (!sample_->pays()) {
    const std::vector<RetimedFrame> exact = retime(configs);
    std::ranges::transform(exact, cycles.begin(), &RetimedFrame::cycles);
    return cycles;
  }
  std::vector<RetimedFrame> retimed(configs.size());
  for (const std::vector<std::size_t>& group : groups(record_, configs)) {
    Traced& known = traced(z_cache_shape(configs[group.front()]));
    if (!known.sample) {
      known.sample = sample_->trace(known.trace);
    }
    const SampleTrace& sample = *known.sample;
    retime_group(sample_->packets(), sample.trace, sample.work, configs, group, retimed);
    for (const std::size_t i : group) {
      cycles[i] = sample_->cycles(configs[i], retimed[i], sample);
    }
  }
  return cycles;
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

}  // namespace detail
}  // namespace halfspace
