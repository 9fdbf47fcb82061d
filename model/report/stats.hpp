/// stats.json: what a run counted.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "halfspace/config/config.hpp"
#include "halfspace/scene/frame.hpp"
#include "halfspace/timing/functional.hpp"

namespace halfspace {

inline constexpr const char* kStatsFile = "stats.json";
inline constexpr const char* kStatsSchema = "halfspace-stats";
inline constexpr int kStatsSchemaVersion = 1;

/// Writes stats.json to `path`. `files` lists the names of all files of the result, stats.json included.
/// The content depends on frame, configuration and version only. Throws InputError.
void write_stats(const std::filesystem::path& path, const Frame& frame, const Config& config,
                 const std::string& fidelity, const FrameResult& result,
                 const std::vector<std::string>& files);

}  // namespace halfspace
