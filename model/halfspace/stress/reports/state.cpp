/// Reports of scissor, viewport and culling.
#include <array>
#include <vector>

#include "halfspace/stress/draw_list.hpp"
#include "halfspace/stress/grid_mesh.hpp"
#include "halfspace/stress/reports/scenes.hpp"

namespace halfspace::stress::report {

Case odd_scissor(const Precision& precision, std::uint64_t seed) {
  constexpr std::int32_t kSize = 32;
  DrawList list(precision, kSize, seed);
  const auto cuts = [&] {
    return std::array{0, static_cast<std::int32_t>(2 * list.between(1, 6) + 1),
                      static_cast<std::int32_t>(2 * list.between(8, 14) + 1), kSize};
  };
  const std::array columns = cuts();
  const std::array rows = cuts();
  for (std::size_t j = 0; j < 3; ++j) {
    for (std::size_t i = 0; i < 3; ++i) {
      list.draw().scissor = {columns[i], rows[j], columns[i + 1] - columns[i], rows[j + 1] - rows[j]};
      const std::int64_t end = list.extent();
      for (const GridTriangle& triangle :
           grid_mesh<GridPoint>(list, {{0, 0}, {end, 0}, {0, end}, {end, end}}, 2)) {
        list.add(triangle);
      }
    }
  }
  Case made{.frame = list.take_frame()};
  made.fragments.assign(std::size_t{kSize} * kSize, 1);
  return made;
}

Case viewport_above(const Precision& precision, std::uint64_t seed) {
  constexpr std::int64_t kSize = 64;
  DrawList list(precision, kSize, seed);
  Command& draw = list.draw();
  const std::int64_t left = list.one_in(2) ? -list.between(1, 40) : 0;
  const std::int64_t above = list.one_in(2) || left == 0 ? -list.between(1, 40) : 0;
  draw.viewport = {left, above, kSize, kSize};
  for (int n = 0; n < 20; ++n) {
    list.add({list.point_on_target(), list.point_on_target(), list.point_on_target()});
  }
  Case made = list.take_defined();
  for (KnownTriangle& triangle : made.triangles) {
    for (GridPoint& p : triangle.grid) {
      p = {p.x + left * list.one(), p.y + above * list.one()};
    }
  }
  return made;
}

Case flipped_culling(const Precision& precision, std::uint64_t seed) {
  constexpr float kSize = 16;
  DrawList list(precision, 16, seed);
  Command& draw = list.draw();
  draw.flags |= bits({Flag::kCullBack});
  const bool flipped = list.one_in(2);
  if (flipped) {
    draw.viewport = {0, kSize, kSize, -kSize};
  }
  std::vector<GridPoint> vertices;
  constexpr std::int64_t kCells = 3;
  const std::int64_t step = list.extent() / kCells + 1;
  for (std::int64_t j = -1; j <= kCells + 1; ++j) {
    for (std::int64_t i = -1; i <= kCells + 1; ++i) {
      vertices.push_back({i * step + list.between(0, step / 4), j * step + list.between(0, step / 4)});
    }
  }
  for (const GridTriangle& t : grid_mesh(list, vertices, kCells + 3)) {
    const GridTriangle right = reference::clockwise(t);
    const GridTriangle left{right[0], right[2], right[1]};
    list.add(flipped ? left : right);
    if (list.one_in(2)) {
      list.add(flipped ? right : left);
    }
  }
  Case made = list.take_defined();
  made.partition = true;  // those that turn left on the screen are culled
  for (KnownTriangle& triangle : made.triangles) {
    for (GridPoint& p : triangle.grid) {
      p.y = flipped ? list.extent() - p.y : p.y;
    }
  }
  return made;
}

}  // namespace halfspace::stress::report
