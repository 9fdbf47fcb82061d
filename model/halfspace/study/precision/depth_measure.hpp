/// How wrong an arithmetic of depth is.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "halfspace/numerics/depth.hpp"
#include "halfspace/reference/exact_triangle.hpp"
#include "halfspace/study/precision/depth_subjects.hpp"

namespace halfspace::study {

/// A triangle on the sub-pixel grid, and depths in [0, 1] of its vertices.
struct GridDepth {
  reference::GridTriangle grid;
  std::array<float, 3> z;
};

/// Triangles without end.
struct DepthFamily {
  std::string name;
  std::string looks;
  std::function<GridDepth()> next;
  std::uint32_t size = 0;  ///< of the target, a power of two
};

/// Those of the stress campaign, each on targets of 64, 1024 and 16384 pixels a side.
[[nodiscard]] std::vector<std::vector<DepthFamily>> depth_families(std::uint64_t seed);

/// The triangles of a frame that face the camera's way, again and again. Throws InputError.
[[nodiscard]] DepthFamily frame_depths(const std::filesystem::path& path);

/// Errors in units of the last place of the format.
struct ErrorSummary {
  std::uint64_t samples = 0;
  double mean = 0;
  double most_of_all = 0;  ///< 99.9 % of them are this or less
  double worst = 0;
};

/// The least of the errors that is not less than `share` of them. There must be some.
[[nodiscard]] double percentile(std::span<float> errors, double share);

[[nodiscard]] ErrorSummary summary(std::span<float> errors);

/// For each of depth_subjects() the errors at `samples` covered samples, or a few more: up to four of a
/// triangle. Empty for those that do not take the format. Judged by stress::ExactPlane.
[[nodiscard]] std::vector<std::vector<float>> depth_errors(const DepthFamily& family, DepthFormat format,
                                                           std::uint64_t samples, std::uint64_t seed);

}  // namespace halfspace::study
