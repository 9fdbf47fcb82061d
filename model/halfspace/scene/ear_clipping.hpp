/// Triangles of a polygon in the plane, one corner cut off at a time.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace halfspace {

/// The n - 2 triangles of n >= 3 points, three indices each, that triangulate() promises. The polygon winds
/// counter-clockwise; coordinates are as orientation() can take them.
[[nodiscard]] std::vector<std::uint32_t> clip_ears(std::span<const glm::dvec2> points);

}  // namespace halfspace
