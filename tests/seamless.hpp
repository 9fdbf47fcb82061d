/// Do triangles fill a polygon without a seam? A question of corners alone, wherever they lie.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <utility>

namespace halfspace::testing {

/// Each edge of the polygon is an edge of the triangles, and every other of theirs goes both ways equally
/// often.
inline bool is_seamless(std::span<const std::uint32_t> polygon, std::span<const std::uint32_t> triangles) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  const auto count = [&](std::uint32_t from, std::uint32_t to, int change) {
    if (from < to) edges[{from, to}] += change;
    if (from > to) edges[{to, from}] -= change;
  };
  for (std::size_t i = 0; i < polygon.size(); ++i) count(polygon[i], polygon[(i + 1) % polygon.size()], -1);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    count(triangles[i], triangles[i % 3 == 2 ? i - 2 : i + 1], 1);
  }
  return std::all_of(edges.begin(), edges.end(), [](const auto& edge) { return edge.second == 0; });
}

}  // namespace halfspace::testing
