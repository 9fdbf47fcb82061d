/// The arithmetics of the edge function as a table.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "halfspace/study/precision/float_triangle.hpp"

namespace halfspace::study {

struct EdgeSubject {
  std::string_view name;
  std::string_view computes;
  std::string_view source;
  int bits;  ///< of the grid that it snaps to, below the pixel; 0: it takes positions as they are
  /// Appends (y - first_y) * width + x - first_x of the covered pixels of `target`.
  void (*cover)(const FloatTriangle& triangle, const PixelRect& target, std::vector<std::uint32_t>& pixels);
  /// Counts them, and nothing else: what is timed.
  std::uint64_t (*count)(std::span<const FloatTriangle> triangles, const PixelRect& target);
};

/// The arithmetic of the default machine.
inline constexpr std::string_view kBaseline = "fixed_8";

[[nodiscard]] std::span<const EdgeSubject> edge_subjects();

}  // namespace halfspace::study
