/// Families of which a second frame must give the same picture.
#include <algorithm>
#include <array>
#include <vector>

#include "halfspace/stress/draw_list.hpp"
#include "halfspace/stress/family.hpp"

namespace halfspace::stress {
namespace {

struct Shape {
  GridTriangle triangle;
  std::array<float, 3> z;
};

/// Triangles of all sizes within a square of `extent` sub-pixels.
std::vector<Shape> any_shapes(DrawList& list, std::int64_t extent) {
  std::vector<Shape> shapes(60);
  for (Shape& shape : shapes) {
    const std::int64_t reach = std::int64_t{1} << list.between(2, 13);
    const GridPoint middle = list.point(0, extent);
    for (GridPoint& p : shape.triangle) {
      p = {std::clamp<std::int64_t>(middle.x + list.between(-reach, reach), 0, extent),
           std::clamp<std::int64_t>(middle.y + list.between(-reach, reach), 0, extent)};
    }
    if (list.one_in(3)) {  // a sample on a vertex, where the precision has room for halves
      const std::int64_t half = list.one() / 2;
      shape.triangle[0] = {shape.triangle[0].x / list.one() * list.one() + half,
                           shape.triangle[0].y / list.one() * list.one() + half};
    }
    shape.z = {list.depth(), list.depth(), list.depth()};
  }
  return shapes;
}

Frame drawn(const Precision& precision, std::uint32_t size, const std::vector<Shape>& shapes) {
  DrawList list(precision, size, 0);
  list.draw();
  for (const Shape& shape : shapes) {
    list.add(shape.triangle, shape.z);
  }
  return list.take_frame();
}

}  // namespace

Case permuted(const Precision& precision, std::uint64_t seed) {
  constexpr std::uint32_t kSize = 32;
  DrawList list(precision, kSize, seed);
  std::vector<Shape> shapes = any_shapes(list, list.extent());
  list.draw();
  for (const Shape& shape : shapes) {
    list.add(shape.triangle, shape.z);
  }
  for (Shape& shape : shapes) {
    std::array<std::size_t, 3> order{0, 1, 2};
    list.shuffle(order);
    const Shape from = shape;
    for (std::size_t i = 0; i < 3; ++i) {
      shape.triangle[i] = from.triangle[order[i]];
      shape.z[i] = from.z[order[i]];
    }
  }
  Case made = list.take_defined();
  made.twin = {.frame = drawn(precision, kSize, shapes)};
  return made;
}

Case translated(const Precision& precision, std::uint64_t seed) {
  constexpr std::uint32_t kSize = 64;
  constexpr std::int64_t kRoom = 40;  // pixels that the triangles keep to
  DrawList list(precision, kSize, seed);
  std::vector<Shape> shapes = any_shapes(list, kRoom * list.one());
  list.draw();
  for (const Shape& shape : shapes) {
    list.add(shape.triangle, shape.z);
  }
  const std::int64_t dx = list.between(0, kSize - kRoom);
  const std::int64_t dy = list.between(0, kSize - kRoom);
  for (Shape& shape : shapes) {
    for (GridPoint& p : shape.triangle) {
      p = {p.x + dx * list.one(), p.y + dy * list.one()};
    }
  }
  Case made = list.take_defined();
  made.twin = {.frame = drawn(precision, kSize, shapes),
               .dx = static_cast<std::int32_t>(dx),
               .dy = static_cast<std::int32_t>(dy),
               .same_depth = dx == 0 && dy == 0};
  return made;
}

}  // namespace halfspace::stress
