#include "halfspace/report/stats.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "halfspace/numerics/error.hpp"

namespace halfspace {
namespace {

using Json = nlohmann::ordered_json;

Json counters_json(const Counters& counters) {
  Json json;
  Counters::units([&](const char* unit_name, auto unit) {
    using Unit = std::remove_cvref_t<decltype(counters.*unit)>;
    Json& group = json[unit_name];
    Unit::fields(
        [&](const char* name, const char* /*help*/, auto member) { group[name] = counters.*unit.*member; });
  });
  return json;
}

const char* format_name(DepthFormat format) {
  switch (format) {
    case DepthFormat::kUnorm16:
      return "unorm16";
    case DepthFormat::kUnorm24:
      return "unorm24";
    case DepthFormat::kFloat32:
      return "float32";
    default:
      return "none";
  }
}

}  // namespace

void write_stats(const std::filesystem::path& path, const Frame& frame, const Config& config,
                 const std::string& fidelity, const FrameResult& result,
                 const std::vector<std::string>& files) {
  Json json;
  json["schema"] = kStatsSchema;
  json["schema_version"] = kStatsSchemaVersion;
  json["tool"] = {{"name", "halfspace"}, {"version", HALFSPACE_VERSION}, {"compiler", __VERSION__}};
  json["fidelity"] = fidelity;
  json["cycles"] = nullptr;  // functional has no time
  json["seed"] = nullptr;    // and nothing random
  for (const ConfigKey& key : config_keys(config)) {
    json["config"][key.name] = key.value;
  }
  json["config_hash"] = config_hash(config);
  json["frame"] = {{"name", frame.name},
                   {"targets", frame.targets.size()},
                   {"commands", frame.commands.size()},
                   {"draws", result.draws.size()},
                   {"draws_not_filled", result.draws_not_filled},
                   {"depth_clears", result.clears},
                   {"counters", counters_json(result.counters)}};
  json["surfaces"] = Json::array();
  for (std::size_t i = 0; i < result.surfaces.size(); ++i) {
    const Surface& surface = result.surfaces[i];
    json["surfaces"].push_back({{"surface", i},
                                {"format", format_name(surface.format)},
                                {"width", surface.codes.width()},
                                {"height", surface.codes.height()},
                                {"counters", counters_json(surface.counters)}});
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
                             {"counters", counters_json(draw.counters)}});
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
