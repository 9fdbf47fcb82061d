/// stats.json: what a run counted.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "halfspace/config/config.hpp"
#include "halfspace/machine/frame_result.hpp"
#include "halfspace/report/what_if.hpp"
#include "halfspace/run/run_result.hpp"
#include "halfspace/scene/frame.hpp"
#include "halfspace/timing/stall_plan.hpp"

namespace halfspace {

inline constexpr const char* kStatsFile = "stats.json";
inline constexpr const char* kStatsSchema = "halfspace-stats";
inline constexpr int kStatsSchemaVersion = 5;

/// Bytes that went between the z cache and memory: of draws, of clears that are drawn, and of the flush.
std::uint64_t memory_bytes_read(const FrameResult& result);
std::uint64_t memory_bytes_written(const FrameResult& result);

/// Writes stats.json to `path`. `files` lists the names of all files of the result, stats.json included. The
/// content depends on frame, configuration, injected stalls, what-if and version only. Throws InputError.
void write_stats(const std::filesystem::path& path, const Frame& frame, const Config& config,
                 Fidelity fidelity, const StallPlan& stalls, const RunResult& result,
                 const std::optional<WhatIfReport>& what_if, const std::vector<std::string>& files);

}  // namespace halfspace
