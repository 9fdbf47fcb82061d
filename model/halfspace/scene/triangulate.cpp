#include "halfspace/scene/triangulate.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <utility>

#include "halfspace/numerics/exact_sum.hpp"
#include "halfspace/numerics/orientation.hpp"
#include "halfspace/scene/ear_clipping.hpp"

namespace halfspace {
namespace {

/// The polygon's corners, scaled by a power of two so that products and their sums are exact; empty when a
/// coordinate is not finite.
std::vector<glm::dvec3> scaled_corners(std::span<const std::uint32_t> polygon,
                                       std::span<const glm::dvec3> positions) {
  constexpr int kGreatestLog2 = kGreatestFactorLog2 - 50;  // the normal is a sum of many products
  double greatest = 0;
  for (const std::uint32_t corner : polygon) {
    for (int axis = 0; axis < 3; ++axis) {
      const double size = std::abs(positions[corner][axis]);
      if (!std::isfinite(size)) return {};
      greatest = std::max(greatest, size);
    }
  }
  int log2 = 0;
  std::frexp(greatest, &log2);
  const auto scaled = [shift = kGreatestLog2 - log2](double x) { return std::ldexp(x, shift); };
  std::vector<glm::dvec3> corners;
  corners.reserve(polygon.size());
  for (const std::uint32_t corner : polygon) {
    const glm::dvec3& p = positions[corner];
    corners.emplace_back(scaled(p.x), scaled(p.y), scaled(p.z));
  }
  return corners;
}

/// The axis nearest to the polygon's normal.
int axis_of_normal(std::span<const glm::dvec3> corners) {
  glm::dvec3 normal{0};  // Newell's: exact for a plane polygon, an average otherwise
  glm::dvec3 extent{0};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3 cross =
        glm::cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
    normal += cross;
    extent += glm::abs(cross);
  }
  glm::dvec3 size = glm::abs(normal);
  // Where the areas cancel out, what is left is rounding; in a plane the extent points the same way.
  if (glm::length(normal) <= 0x1p-30 * glm::length(extent)) size = extent;
  const double largest = std::max(size.x, std::max(size.y, size.z));
  return size.x == largest ? 0 : size.y == largest ? 1 : 2;
}

/// The polygon seen along an axis, so that it winds counter-clockwise: no coordinate is rounded.
std::vector<glm::dvec2> flatten(std::span<const glm::dvec3> corners, int axis) {
  std::vector<glm::dvec2> points;
  points.reserve(corners.size());
  for (const glm::dvec3& p : corners) points.emplace_back(p[(axis + 1) % 3], p[(axis + 2) % 3]);
  ExactSum<kMostParts> area;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec2 a = points[i];
    const glm::dvec2 b = points[(i + 1) % points.size()];
    area.add_product(a.x, b.y);
    area.add_product(-a.y, b.x);
  }
  if (area.sign() < 0) {
    for (glm::dvec2& p : points) std::swap(p.x, p.y);
  }
  return points;
}

/// No reflex corner, and no triangle of the fan around the first corner winds the other way.
bool is_convex(std::span<const glm::dvec2> points) {
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (orientation(points[i], points[(i + 1) % n], points[(i + 2) % n]) < 0) return false;
  }
  for (std::size_t i = 1; i + 1 < n; ++i) {
    if (orientation(points[0], points[i], points[i + 1]) < 0) return false;
  }
  return true;
}

}  // namespace

bool triangulate(std::span<const std::uint32_t> polygon, std::span<const glm::dvec3> positions,
                 std::vector<std::uint32_t>& triangles) {
  const auto fan = [&] {
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
      triangles.insert(triangles.end(), {polygon[0], polygon[i], polygon[i + 1]});
    }
    return true;
  };
  if (polygon.size() == 3) return fan();
  const std::vector<glm::dvec3> corners = scaled_corners(polygon, positions);
  if (corners.empty()) return fan();
  const std::vector<glm::dvec2> points = flatten(corners, axis_of_normal(corners));
  if (is_convex(points)) return fan();
  if (polygon.size() > kMaxConcaveCorners) return false;
  for (const std::uint32_t corner : clip_ears(points)) triangles.push_back(polygon[corner]);
  return true;
}

}  // namespace halfspace
