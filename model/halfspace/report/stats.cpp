#include "halfspace/report/stats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>

#include "halfspace/numerics/error.hpp"

namespace halfspace {
namespace {

using Json = nlohmann::ordered_json;

/// What reference rasterizers count: they have no blocks, tiles and caches.
constexpr std::array<std::string_view, 11> kReferenceCounters{
    "front_end.triangles",       "front_end.non_finite",     "front_end.clipped_away", "quad_generator.quads",
    "quad_generator.quads_full", "quad_generator.fragments", "quad_generator.helpers", "early_z.tested",
    "early_z.untested",          "early_z.survivors",        "early_z.written"};

Json counters_json(const Counters& counters, bool of_reference) {
  Json json;
  Counters::units([&](const char* unit_name, auto unit) {
    using Unit = std::remove_cvref_t<decltype(counters.*unit)>;
    Unit::fields([&](const char* name, const char* /*help*/, auto member) {
      const std::string path = fmt::format("{}.{}", unit_name, name);
      if (!of_reference || std::ranges::find(kReferenceCounters, path) != kReferenceCounters.end()) {
        json[unit_name][name] = counters.*unit.*member;
      }
    });
  });
  return json;
}

Json reference_json(const ReferenceRun& reference) {
  return {{"name", reference.name},
          {"degenerate", reference.degenerate},
          {"culled", reference.culled},
          {"drawn", reference.drawn}};
}

double ratio(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
}

/// Of a frame or a draw: every stage's own cycles, those with something to do and the others by their reason.
Json stages_json(const CycleStats& stats) {
  Json json;
  for (std::size_t i = 0; i < kStages; ++i) {
    const StageCycles& cycles = stats.stage[i];
    Json& stage = json[std::string(kStageInfo[i].name)];
    stage = {{"cycles", cycles.total()},
             {"busy", cycles.busy},
             {"utilisation", ratio(cycles.busy, cycles.total())}};
    for (std::size_t k = 0; k < kMostStallReasons && !kStageInfo[i].stall[k].empty(); ++k) {
      stage["stalls"][std::string(kStageInfo[i].stall[k])] = cycles.stall[k];
    }
  }
  return json;
}

Json links_json(const CycleStats& stats) {
  Json json;
  for (std::size_t i = 0; i < kLinks; ++i) {
    Json& link = json[std::string(kLinkName[i])];
    link = {{"packets", stats.packets[i]}, {"held", stats.held[i]}};
    const Occupancy& occupancy = stats.occupancy[i];
    const auto most = std::find_if(occupancy.rbegin(), occupancy.rend(), [](auto n) { return n != 0; });
    if (most != occupancy.rend()) {  // of a frame that took time
      const std::uint64_t cycles = std::accumulate(occupancy.begin(), occupancy.end(), std::uint64_t{0});
      link["mean_occupancy"] = ratio(stats.held[i], cycles);
      link["max_occupancy"] = occupancy.rend() - most - 1;
      link["occupancy"] = occupancy;
    }
  }
  return json;
}

Json memory_json(const CycleStats& stats, std::uint64_t bytes_read, std::uint64_t bytes_written) {
  return {{"read_busy", stats.read_busy},
          {"write_busy", stats.write_busy},
          {"bytes_read", bytes_read},
          {"bytes_written", bytes_written}};
}

Json frame_time_json(const FrameCycles& frame, const FrameResult& result) {
  Json memory = memory_json(frame.stats, memory_bytes_read(result), memory_bytes_written(result));
  memory["read_utilisation"] = ratio(frame.stats.read_busy, frame.cycles);
  memory["write_utilisation"] = ratio(frame.stats.write_busy, frame.cycles);
  return {{"stages", stages_json(frame.stats)},
          {"links", links_json(frame.stats)},
          {"memory", std::move(memory)}};
}

Json draw_time_json(const DrawCycles& draw, const EarlyZCounters& counters) {
  return {{"end", draw.end},
          {"stages", stages_json(draw.stats)},
          {"links", links_json(draw.stats)},
          {"memory", memory_json(draw.stats, counters.bytes_read, counters.bytes_written)}};
}

Json quad_merging_json(const QuadMergingCounters& counters) {
  Json json;
  QuadMergingCounters::fields(
      [&](const char* name, const char* /*help*/, auto member) { json[name] = counters.*member; });
  json["quads_shaded"] = quads_shaded(counters);
  json["fragments_unmerged"] = fragments_unmerged(counters);
  json["fragments_shaded"] = fragments_shaded(counters);
  json["saved"] = ratio(counters.joined, counters.quads);
  return json;
}

Json pixel_rate_json(const PixelRateCounters& counters) {
  Json json;
  PixelRateCounters::fields(
      [&](const char* name, const char* /*help*/, auto member) { json[name] = counters.*member; });
  return json;
}

Json frame_json(const Frame& frame, const FrameResult& result, bool of_reference) {
  Json json = {{"name", frame.name},
               {"targets", frame.targets.size()},
               {"commands", frame.commands.size()},
               {"draws", result.draws.size()},
               {"draws_not_filled", result.draws_not_filled},
               {"depth_clears", result.clears},
               {"magnified", frame.magnified}};
  if (!of_reference) {
    json["flushed_lines"] = result.flushed_lines;
    json["flushed_bytes"] = result.flushed_bytes;
  }
  json["counters"] = counters_json(result.counters, of_reference);
  if (!of_reference) {
    json["drawn_clears"] = counters_json(result.drawn_clears, of_reference);
  }
  return json;
}

Json stalls_json(const StallPlan& plan) {
  Json json = Json::object();
  for (std::size_t i = 0; i < kStallPoints; ++i) {
    const StallPlan::Rate& rate = plan.rate[i];
    if (rate.percent != 0) {
      json[std::string(kStallPointName[i])] = {{"percent", rate.percent}, {"max_cycles", rate.max_cycles}};
    }
  }
  return json;
}

Json what_if_json(const WhatIfReport& report) {
  Json json{{"applied", Json::array()}};
  for (const whatif::Applied& applied : report.applied) {
    json["applied"].push_back(
        {{"name", applied.name}, {"draws", applied.acted.draws}, {"ranges", applied.acted.ranges}});
  }
  for (const WhatIfRow& row : rows(report)) {
    const std::optional<double> ratio = row.ratio();
    json[std::string(row.name)] = {
        {"without", row.without}, {"with", row.with}, {"ratio", ratio ? Json(*ratio) : Json()}};
  }
  return json;
}

}  // namespace

std::uint64_t memory_bytes_read(const FrameResult& result) {
  return result.counters.early_z.bytes_read + result.drawn_clears.early_z.bytes_read;
}

std::uint64_t memory_bytes_written(const FrameResult& result) {
  return result.counters.early_z.bytes_written + result.drawn_clears.early_z.bytes_written +
         result.flushed_bytes;
}

void write_stats(const std::filesystem::path& path, const Frame& frame, const Config& config,
                 Fidelity fidelity, const StallPlan& stalls, const RunResult& run,
                 const std::optional<WhatIfReport>& what_if, const std::vector<std::string>& files) {
  const FrameResult& result = run.frame;
  const bool packets = info(fidelity).packets;
  const bool of_reference = run.reference.has_value();
  Json json;
  json["schema"] = kStatsSchema;
  json["schema_version"] = kStatsSchemaVersion;
  json["tool"] = {{"name", "halfspace"}, {"version", HALFSPACE_VERSION}, {"compiler", __VERSION__}};
  json["fidelity"] = of_reference ? Json() : Json(info(fidelity).name);
  if (of_reference) {
    json["reference"] = reference_json(*run.reference);
  }
  json["core"] =
      info(fidelity).core && !of_reference ? Json(kCoreName[static_cast<std::size_t>(result.core)]) : Json();
  json["cycles"] = run.cycles ? Json(run.cycles->cycles) : Json();
  json["seed"] = packets ? Json(stalls.seed) : Json();
  json["stalls"] = packets ? stalls_json(stalls) : Json();
  for (const ConfigKey& key : config_keys(config)) {
    json["config"][key.name] = key.value;
  }
  json["config_hash"] = config_hash(config);
  if (what_if) {
    json["what_if"] = what_if_json(*what_if);
  }
  json["frame"] = frame_json(frame, result, of_reference);
  if (run.cycles) {
    const std::uint64_t cycles = run.cycles->cycles;
    json["frame"]["time"] = {{"cycles", cycles},
                             {"quads_per_cycle", ratio(result.counters.quad_generator.quads, cycles)}};
    json["frame"]["time"].update(frame_time_json(*run.cycles, result));
  }
  if (run.quad_merging) {
    json["frame"]["quad_merging"] = quad_merging_json(run.quad_merging->frame);
    json["frame"]["quad_merging"]["buffer"] = run.quad_merging->buffer;
  }
  if (run.pixel_rate) {
    json["frame"]["pixel_rate"] = pixel_rate_json(run.pixel_rate->frame);
  }
  json["surfaces"] = Json::array();
  for (std::size_t i = 0; i < result.surfaces.size(); ++i) {
    const Surface& surface = result.surfaces[i];
    json["surfaces"].push_back({{"surface", surface.target ? Json() : Json(i)},
                                {"target", surface.target ? Json(*surface.target) : Json()},
                                {"format", name(surface.format)},
                                {"width", surface.codes.width()},
                                {"height", surface.codes.height()},
                                {"counters", counters_json(surface.counters, of_reference)}});
  }
  json["draws"] = Json::array();
  for (std::size_t i = 0; i < result.draws.size(); ++i) {
    const DrawStats& draw = result.draws[i];
    const Command& command = frame.commands[draw.command];
    json["draws"].push_back({{"draw", i},
                             {"command", draw.command},
                             {"source_event", command.source_event},
                             {"target", command.target},
                             {"surface", draw.surface == kNoSurface ? Json() : Json(draw.surface)},
                             {"counters", counters_json(draw.counters, of_reference)}});
    if (run.cycles) {
      json["draws"].back()["time"] = draw_time_json(run.cycles->draws[i], draw.counters.early_z);
    }
    if (run.pixel_rate) {
      json["draws"].back()["pixel_rate"] = pixel_rate_json(run.pixel_rate->draws[i]);
    }
    if (run.quad_merging) {
      json["draws"].back()["quad_merging"] = quad_merging_json(run.quad_merging->draws[i]);
    }
  }
  json["files"] = files;
  std::ofstream file(path);
  file << json.dump(1) << '\n';
  file.close();
  if (!file) {
    throw InputError(fmt::format("{}: cannot be written: {}", path.string(), std::strerror(errno)));
  }
}

}  // namespace halfspace
