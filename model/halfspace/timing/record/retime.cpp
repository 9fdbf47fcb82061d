#include "halfspace/timing/record/retime.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

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
  RecurrenceCore<OneMachine, NoStalls, NoProbe> core(machine(config), make_credits(config), NoStalls{},
                                                     probe);
  RetimedFrame result;
  DrawEnds hooks{{}, core, result.draw_end};
  bool bursts = false;
  core.start(trace.memory_lines);
  replay(whole_stream(record, trace), core, hooks, bursts, [&](std::uint32_t surface) {
    return static_cast<std::uint64_t>(fast_clear_cycles(record.surfaces[surface].tiles, config));
  });
  result.cycles = core.flush(trace.flush, static_cast<std::uint32_t>(config.z_cache.lines));
  return result;
}

}  // namespace

void check_retimable(const FrameRecord& record, const Config& config) {
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
  traced_.push_back({.shape = shape, .trace = std::move(trace), .work = std::move(work)});
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
    std::vector<std::size_t> group;  // positions of what goes through in one pass
    const auto pass = [&] {
      std::vector<Config> machines;
      machines.reserve(group.size());
      for (const std::size_t i : group) {
        machines.push_back(configs[i]);
      }
      std::vector<RetimedFrame> retimed(group.size());
      detail::retime_lanes(record_, known.trace, machines, retimed.data());
      for (std::size_t k = 0; k < group.size(); ++k) {
        results[group[k]] = std::move(retimed[k]);
      }
      group.clear();
    };
    for (std::size_t i = first; i < configs.size(); ++i) {
      if (done[i] || z_cache_shape(configs[i]) != known.shape) {
        continue;
      }
      done[i] = true;
      if (detail::longest_time(known.work, configs[i]) > std::numeric_limits<std::uint32_t>::max()) {
        results[i] = retime_one(record_, known.trace, configs[i]);  // needs 64 bits
        continue;
      }
      group.push_back(i);
      if (group.size() == detail::kLanes) {
        pass();
      }
    }
    if (!group.empty()) {
      pass();
    }
  }
  return results;
}

namespace detail {

std::uint64_t longest_time(const FrameWork& work, const Config& config) {
  const Machine<std::uint64_t> m = machine(config);
  DrawWork sum = work.drawn_clears;
  for (const DrawWork& draw : work.draws) {
    sum += draw;
  }
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
