/// Polygons into triangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace halfspace {

/// Most corners of a polygon that is not convex: in the worst case the time grows with their square.
inline constexpr std::size_t kMaxConcaveCorners = std::size_t{1} << 15;

/// Appends the n - 2 triangles of a polygon of n corners to `triangles`, three corners each, in the polygon's
/// own winding. The polygon has 3 or more corners, each below positions.size(). Returns false, appending
/// nothing, when it is not convex and has more than kMaxConcaveCorners corners.
///
/// - The triangles are seamless: each edge of the polygon is an edge of one triangle, each other edge is
///   shared by two, in opposite directions.
/// - The polygon is seen along the axis nearest to its normal. Seen so, the triangles' signed areas add up
///   to the polygon's. Where the polygon is weakly simple, which is that it may touch itself, run back along
///   itself and repeat corners but not cross itself, no triangle winds the other way: the triangles cover
///   what is inside, once. Where it crosses itself, triangles may overlap or wind the other way; those that
///   cover a point, less those that do and wind the other way, are still as many as the polygon winds
///   around it.
/// - Decisions are exact unless a coordinate is not 0 but 2^900 times smaller than the greatest.
/// - A convex polygon, and one with coordinates that are not finite, becomes a fan around its first corner.
[[nodiscard]] bool triangulate(std::span<const std::uint32_t> polygon, std::span<const glm::dvec3> positions,
                               std::vector<std::uint32_t>& triangles);

}  // namespace halfspace
