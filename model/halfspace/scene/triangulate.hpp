/// Polygons into triangles.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace halfspace {

/// Most corners of a polygon that is not convex: cutting it up takes time with their square, or worse.
inline constexpr std::size_t kMaxConcaveCorners = 1024;

/// Appends the triangles of a polygon to `triangles`, three corners each, in the polygon's own winding.
/// The polygon has 3 or more corners, each below positions.size(). A convex or degenerate polygon becomes a
/// fan around its first corner; another loses one ear at a time, seen along its normal. Returns false,
/// appending nothing, when the polygon is not convex and has more than kMaxConcaveCorners corners.
[[nodiscard]] bool triangulate(std::span<const std::uint32_t> polygon, std::span<const glm::dvec3> positions,
                               std::vector<std::uint32_t>& triangles);

}  // namespace halfspace
