/// A triangle whose depth the arithmetics of the study interpolate.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <tuple>
#include <utility>

#include "halfspace/reference/exact_triangle.hpp"
#include "halfspace/study/baseline.hpp"

namespace halfspace::study {

struct DepthVertex {
  std::int64_t x = 0;  ///< in 1/2^kSubPixelBits pixel
  std::int64_t y = 0;
  float z = 0;
};

/// In the order in which setup takes vertices: the topmost, then leftmost first, and of positive area. Vertex
/// i is opposite to the edge from i + 1 to i + 2.
struct DepthTriangle {
  std::array<DepthVertex, 3> v;
  std::int64_t area2 = 0;  ///< twice the area

  /// The area must not be 0.
  DepthTriangle(const reference::GridTriangle& grid, const std::array<float, 3>& z) {
    for (std::size_t i = 0; i < 3; ++i) {
      v[i] = {grid[i].x, grid[i].y, z[i]};
    }
    area2 = static_cast<std::int64_t>(reference::twice_area(grid[0], grid[1], grid[2]));
    if (area2 < 0) {
      std::swap(v[1], v[2]);
      area2 = -area2;
    }
    const auto above = [](const DepthVertex& l, const DepthVertex& r) {
      return std::tie(l.y, l.x) < std::tie(r.y, r.x);
    };
    std::rotate(v.begin(), std::min_element(v.begin(), v.end(), above), v.end());
  }

  [[nodiscard]] reference::GridTriangle grid() const {
    return {reference::GridPoint{v[0].x, v[0].y}, {v[1].x, v[1].y}, {v[2].x, v[2].y}};
  }
  /// A and B of edge i, and its value at a sample.
  [[nodiscard]] std::int64_t a(std::size_t i) const { return v[(i + 1) % 3].y - v[(i + 2) % 3].y; }
  [[nodiscard]] std::int64_t b(std::size_t i) const { return v[(i + 2) % 3].x - v[(i + 1) % 3].x; }
  [[nodiscard]] std::int64_t edge(std::size_t i, const reference::GridPoint& p) const {
    const DepthVertex& from = v[(i + 1) % 3];
    return a(i) * (p.x - from.x) + b(i) * (p.y - from.y);
  }
};

}  // namespace halfspace::study
