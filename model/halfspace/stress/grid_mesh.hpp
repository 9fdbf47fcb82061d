/// A mesh of the cells of a grid of vertices, drawn in any order.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "halfspace/stress/draw_list.hpp"

namespace halfspace::stress {

/// Two triangles for each cell of `vertices`, which has `row` vertices in a row; either diagonal, the
/// triangles and their vertices in any order.
template <class Vertex>
std::vector<std::array<Vertex, 3>> grid_mesh(DrawList& list, const std::vector<Vertex>& vertices,
                                             std::int64_t row) {
  std::vector<std::array<Vertex, 3>> triangles;
  const std::int64_t rows = static_cast<std::int64_t>(vertices.size()) / row;
  for (std::int64_t j = 0; j + 1 < rows; ++j) {
    for (std::int64_t i = 0; i + 1 < row; ++i) {
      const Vertex* top = &vertices[static_cast<std::size_t>(j * row + i)];
      const Vertex* bottom = top + row;
      if (list.one_in(2)) {
        triangles.push_back({top[0], top[1], bottom[0]});
        triangles.push_back({top[1], bottom[1], bottom[0]});
      } else {
        triangles.push_back({top[0], top[1], bottom[1]});
        triangles.push_back({top[0], bottom[1], bottom[0]});
      }
    }
  }
  list.shuffle(triangles);
  for (auto& triangle : triangles) {
    list.shuffle(triangle);
  }
  return triangles;
}

}  // namespace halfspace::stress
