#include "halfspace/scene/triangulate.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <utility>

namespace halfspace {
namespace {

/// Twice the signed area of a, b, c.
double cross(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
  return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
}

/// The polygon seen along its normal, so that it winds counter-clockwise; empty when it has no normal.
std::vector<glm::dvec2> flatten(std::span<const std::uint32_t> polygon,
                                std::span<const glm::dvec3> positions) {
  const glm::dvec3 origin = positions[polygon[0]];
  glm::dvec3 normal{0};  // Newell's: exact for a plane polygon, an average otherwise
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 a = positions[polygon[i]] - origin;
    const glm::dvec3 b = positions[polygon[(i + 1) % polygon.size()]] - origin;
    normal += glm::cross(a, b);
  }
  const glm::dvec3 size = glm::abs(normal);
  const double largest = std::max(size.x, std::max(size.y, size.z));
  if (!(largest > 0) || !std::isfinite(largest)) return {};
  // Drop the axis nearest to the normal; swap the others where that would mirror the polygon.
  int u = size.x == largest ? 1 : size.y == largest ? 2 : 0;
  int v = (u + 1) % 3;
  if (normal[(u + 2) % 3] < 0) std::swap(u, v);
  std::vector<glm::dvec2> points;
  points.reserve(polygon.size());
  for (const std::uint32_t corner : polygon) {
    const glm::dvec3 p = positions[corner] - origin;
    points.emplace_back(p[u], p[v]);
  }
  return points;
}

/// No reflex corner, and not wound more than once around.
bool is_convex(std::span<const glm::dvec2> points) {
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (cross(points[i], points[(i + 1) % n], points[(i + 2) % n]) < 0) return false;
  }
  for (std::size_t i = 1; i + 1 < n; ++i) {
    if (cross(points[0], points[i], points[i + 1]) < 0) return false;
  }
  return true;
}

/// The corner `at` of the ring cuts off a triangle that holds no other corner.
bool is_ear(std::span<const glm::dvec2> points, std::span<const std::uint32_t> ring, std::size_t at) {
  const std::size_t n = ring.size();
  const std::size_t before = (at + n - 1) % n;
  const std::size_t after = (at + 1) % n;
  const glm::dvec2 a = points[ring[before]];
  const glm::dvec2 b = points[ring[at]];
  const glm::dvec2 c = points[ring[after]];
  if (!(cross(a, b, c) > 0)) return false;
  for (std::size_t i = 0; i < n; ++i) {
    if (i == before || i == at || i == after) continue;
    const glm::dvec2 p = points[ring[i]];
    if (p == a || p == b || p == c) continue;
    if (cross(a, b, p) >= 0 && cross(b, c, p) >= 0 && cross(c, a, p) >= 0) return false;
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
  const std::vector<glm::dvec2> points = flatten(polygon, positions);
  if (points.empty() || is_convex(points)) return fan();
  if (polygon.size() > kMaxConcaveCorners) return false;

  std::vector<std::uint32_t> ring(polygon.size());
  for (std::size_t i = 0; i < ring.size(); ++i) ring[i] = static_cast<std::uint32_t>(i);
  std::size_t at = 0;
  std::size_t tried = 0;
  while (ring.size() > 3) {
    const std::size_t n = ring.size();
    // A polygon that crosses itself may have no ear left: then any corner goes.
    if (tried < n && !is_ear(points, ring, at)) {
      ++tried;
      at = (at + 1) % n;
      continue;
    }
    triangles.insert(triangles.end(),
                     {polygon[ring[(at + n - 1) % n]], polygon[ring[at]], polygon[ring[(at + 1) % n]]});
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(at));
    at %= ring.size();
    tried = 0;
  }
  triangles.insert(triangles.end(), {polygon[ring[0]], polygon[ring[1]], polygon[ring[2]]});
  return true;
}

}  // namespace halfspace
