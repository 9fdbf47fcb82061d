#include "halfspace/timing/record/retime.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <utility>

#include "halfspace/machine/surfaces.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/numerics/parallel.hpp"
#include "halfspace/timing/record/retime_passes.hpp"
#include "halfspace/timing/recurrence/machine.hpp"

namespace halfspace {

void check_retimable(const FrameRecord& record, const Config& config) {
  if (same_packets(record.config, config)) {
    const Config& recorded = record.config;
    const int parts = recorded.z_cache.parts;
    if (config.z_cache.parts != parts && (recorded.hi_z.enabled || recorded.z_cache.compression)) {
      throw OptionError(
          fmt::format("configuration key 'z_cache.parts' is {}, the record of {} was made with {}: with hi_z "
                      "or coded lines it changes more than cycles; legal: {}, or a new record",
                      config.z_cache.parts, record.name, parts, parts));
    }
    return;
  }
  const std::vector<ConfigKey> recorded = config_keys(record.config);
  const std::vector<ConfigKey> wanted = config_keys(config);
  for (std::size_t i = 0; i < recorded.size(); ++i) {
    if (!recorded[i].timing && recorded[i].value != wanted[i].value) {
      throw OptionError(
          fmt::format("configuration key '{}' is {}, the record of {} was made with {}: it changes packets, "
                      "not only their cycles; legal: {}, or a new record",
                      recorded[i].name, wanted[i].value, record.name, recorded[i].value, recorded[i].value));
    }
  }
}

Retimer::Retimer(FrameRecord record, int threads) : record_(std::move(record)), threads_(threads) {
  traced(z_cache_shape(record_.config));
}

void Retimer::trace_all(std::span<const ZCacheShape> shapes) {
  std::list<Traced> found;
  std::vector<Traced*> places;
  for (const ZCacheShape& shape : shapes) {
    if (std::ranges::find(traced_, shape, &Traced::shape) == traced_.end()) {
      places.push_back(&found.emplace_back(Traced{.shape = shape, .trace = {}, .work = {}}));
    }
  }
  parallel_for(places.size(), threads_, [&](std::size_t i) {
    Traced& place = *places[i];
    place.trace = trace_z_cache(record_, place.shape);
    place.work = frame_work(whole_stream(record_, place.trace), record_.surfaces, place.trace.flush);
  });
  traced_.splice(traced_.end(), found);
}

Retimer::Traced& Retimer::traced(const ZCacheShape& shape) {
  trace_all({&shape, 1});
  return *std::ranges::find(traced_, shape, &Traced::shape);
}

std::vector<Retimer::Group> Retimer::groups(std::span<const Config> configs) {
  std::vector<ZCacheShape> shapes;
  std::vector<Group> groups;
  for (std::size_t i = 0; i < configs.size(); ++i) {
    check_retimable(record_, configs[i]);
    const ZCacheShape shape = z_cache_shape(configs[i]);
    const auto at = static_cast<std::size_t>(std::ranges::find(shapes, shape) - shapes.begin());
    if (at == shapes.size()) {
      shapes.push_back(shape);
      groups.emplace_back();
    }
    groups[at].machines.push_back(i);
  }
  trace_all(shapes);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    groups[i].traced = &traced(shapes[i]);
  }
  return groups;
}

RetimedFrame Retimer::retime(const Config& config) {
  check_retimable(record_, config);
  return retime_one(record_, traced(z_cache_shape(config)).trace, config);
}

std::vector<RetimedFrame> Retimer::retime(std::span<const Config> configs) {
  std::vector<RetimeGroup> whole;
  for (Group& group : groups(configs)) {
    whole.push_back({.record = &record_,
                     .trace = &group.traced->trace,
                     .work = &group.traced->work,
                     .machines = std::move(group.machines)});
  }
  std::vector<RetimedFrame> results(configs.size());
  retime_groups(whole, configs, threads_, results);
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
  const std::vector<Group> all = groups(configs);
  std::vector<RetimeGroup> sampled(all.size());
  parallel_for(all.size(), threads_, [&](std::size_t i) {
    std::optional<SampleTrace>& sample = all[i].traced->sample;
    if (!sample) {
      sample = sample_->trace(all[i].traced->trace);
    }
    sampled[i] = {.record = &sample_->packets(),
                  .trace = &sample->trace,
                  .work = &sample->work,
                  .machines = all[i].machines};
  });
  std::vector<RetimedFrame> retimed(configs.size());
  retime_groups(sampled, configs, threads_, retimed);
  for (const Group& group : all) {
    for (const std::size_t i : group.machines) {
      cycles[i] = sample_->cycles(configs[i], retimed[i], *group.traced->sample);
    }
  }
  return cycles;
}

namespace detail {

std::uint64_t longest_job(const Config& config, std::uint32_t most_empty) {
  const Machine<std::uint64_t> m = machine(config);
  const int tile = config.tile_walker.tile_size;
  const auto line = static_cast<std::size_t>(
      std::countr_zero(static_cast<unsigned>(tile * tile * 4 / config.z_cache.parts)));
  const auto quads = static_cast<std::size_t>(tile * tile / 4);
  const auto parts = static_cast<std::uint64_t>(config.z_cache.parts);
  // and all late writes that are out, before it
  const std::uint64_t late =
      config.late_z.mode == LateZ::kLate
          ? m.late_latency + static_cast<std::uint64_t>(config.late_z.queue) * m.test_beats[quads]
          : 0;
  // up to two walks, the job's own and that after the last job before
  return 2 * (std::uint64_t{most_empty} + 1) + static_cast<std::uint64_t>(sum_of_latencies(config)) + 16 +
         m.quad_beats[quads] + m.test_beats[quads] + late +
         parts * (m.memory_latency + m.read_cycles[line] + m.write_cycles[line] + m.decode_latency +
                  m.encode_latency + 8);
}

}  // namespace detail
}  // namespace halfspace
