#include "halfspace/timing/record/retime.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "halfspace/numerics/error.hpp"
#include "halfspace/timing/draw_state.hpp"
#include "halfspace/timing/record/replay-inl.hpp"
#include "halfspace/timing/recurrence/core.hpp"

namespace halfspace {
namespace {

/// On the machine whose z cache is that of `trace`.
RetimedFrame retime_one(const FrameRecord& record, const ZTrace& trace, const Config& config) {
  NoProbe probe;
  RecurrenceCore<OneMachine, NoStalls, NoProbe> core(machine(config), make_credits(config), NoStalls{},
                                                     probe);
  RetimedFrame result;
  HWY_NAMESPACE::replay(
      record, trace, core,
      [&](std::uint32_t tiles) { return static_cast<std::uint64_t>(fast_clear_cycles(tiles, config)); },
      [&](const auto& c) { result.draw_end.push_back(std::max<std::uint64_t>(c.sink_next(), 1) - 1); });
  result.cycles = core.flush(trace.flush, static_cast<std::uint32_t>(config.z_lines));
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

RetimedFrame retime(const FrameRecord& record, const Config& config) {
  check_retimable(record, config);
  return retime_one(record, trace_z_cache(record, z_cache_shape(config)), config);
}

std::vector<RetimedFrame> retime(const FrameRecord& record, std::span<const Config> configs) {
  std::vector<RetimedFrame> results(configs.size());
  std::vector<bool> done(configs.size(), false);
  for (std::size_t first = 0; first < configs.size(); ++first) {
    check_retimable(record, configs[first]);
    if (done[first]) {
      continue;
    }
    const ZCacheShape shape = z_cache_shape(configs[first]);
    const ZTrace trace = trace_z_cache(record, shape);
    std::vector<std::size_t> group;  // positions of what goes through in one pass
    const auto pass = [&] {
      std::vector<Config> machines;
      for (const std::size_t i : group) {
        machines.push_back(configs[i]);
      }
      std::vector<RetimedFrame> retimed(group.size());
      detail::retime_lanes(record, trace, machines, retimed.data());
      for (std::size_t k = 0; k < group.size(); ++k) {
        results[group[k]] = std::move(retimed[k]);
      }
      group.clear();
    };
    for (std::size_t i = first; i < configs.size(); ++i) {
      if (done[i] || z_cache_shape(configs[i]) != shape) {
        continue;
      }
      done[i] = true;
      if (detail::longest_time(record, trace, configs[i]) > std::numeric_limits<std::uint32_t>::max()) {
        check_retimable(record, configs[i]);
        results[i] = retime_one(record, trace, configs[i]);  // needs 64 bits
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

std::uint64_t longest_time(const FrameRecord& record, const ZTrace& trace, const Config& config) {
  const Machine<std::uint64_t> m = machine(config);
  std::uint64_t triangles = 0;
  std::uint64_t clears = 0;
  for (const RecordedSegment& segment : record.segments) {
    triangles += segment.dropped_after;
    if (segment.kind == RecordedSegment::Kind::kFastClear) {
      clears += static_cast<std::uint64_t>(fast_clear_cycles(record.surfaces[segment.surface].tiles, config));
    }
  }
  std::uint64_t steps = 0;
  for (const RecordedTriangle& triangle : record.triangles) {
    triangles += triangle.dropped_before + 1;
    steps += triangle.steps_after;
  }
  std::uint64_t beats = 0;
  for (const RecordedJob& job : record.jobs) {
    steps += job.steps();
    beats += m.quad_beats[static_cast<std::size_t>(job.quads())] +
             m.test_beats[static_cast<std::size_t>(job.quads())];
  }
  const std::uint64_t each_triangle =
      kSetupCullLatency + kSetupDivideLatency + m.setup_interval + 4;  // and the cycles that credits take
  const std::uint64_t each_job =
      kWalkerLatency + m.edge_latency + kQuadLatency + kLookupLatency + kTestLatency + 16;
  const std::uint64_t each_line = m.memory_latency + m.read_cycles.back() + m.write_cycles.back() + 4;
  return triangles * each_triangle + steps * m.step_interval + record.jobs.size() * each_job + beats +
         (trace.misses.size() + trace.flush.size()) * each_line + clears +
         static_cast<std::uint64_t>(config.z_lines) + 64;
}

}  // namespace detail
}  // namespace halfspace
