/// Triangles for the setup bench.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "common/stream_bench.hpp"
#include "job.hpp"
#include "models.hpp"

namespace halfspace::tb {

/// Cases that a random search might miss: every order of the vertices with every tie, fill rule and culling;
/// the smallest and the largest areas; bounds at the borders of tiles and blocks; codes at their roundings;
/// every bit of the state.
[[nodiscard]] std::vector<SetupJob> directed_jobs(const SetupModel& model);

/// Drawn and dropped triangles as `drawn` says, small ones.
[[nodiscard]] std::vector<SetupJob> timing_jobs(const SetupModel& model, const std::vector<bool>& drawn);

/// What the front end makes of a frame, with the states of its draws; clears that are drawn included. Then
/// the same with the sides of its triangles as thin lines, by every rule, where the RTL has them.
[[nodiscard]] std::vector<SetupJob> frame_jobs(const std::filesystem::path& file, const SetupModel& model);

/// Random triangles of every kind: slivers, tiny, large, at the guard band, on pixel centres, without area,
/// with shared vertices, with horizontal and vertical edges; states and depths of every kind.
[[nodiscard]] std::unique_ptr<Stimulus> random_stimulus(const SetupModel& model, std::uint64_t seed,
                                                        std::uint64_t count);
[[nodiscard]] std::unique_ptr<Stimulus> list_stimulus(const SetupModel& model, std::vector<SetupJob> jobs);

}  // namespace halfspace::tb
