#include "halfspace/reference/pixel_square.hpp"

#include <algorithm>
#include <array>

namespace halfspace::reference {
namespace {

std::array<GridPoint, 4> corners_of(const PixelSquare& square) {
  return {square.least, {square.most.x, square.least.y}, square.most, {square.least.x, square.most.y}};
}

bool holds(const PixelSquare& square, const GridPoint& p) {
  return p.x >= square.least.x && p.x <= square.most.x && p.y >= square.least.y && p.y <= square.most.y;
}

/// Of a triangle with area: the point is on no side's outer side.
bool holds(const GridTriangle& triangle, const GridPoint& p) {
  if (twice_area(triangle[0], triangle[1], triangle[2]) == 0) return false;
  const GridTriangle t = clockwise(triangle);
  return twice_area(t[0], t[1], p) >= 0 && twice_area(t[1], t[2], p) >= 0 && twice_area(t[2], t[0], p) >= 0;
}

int side(const GridPoint& a, const GridPoint& b, const GridPoint& p) {
  const Int128 area = twice_area(a, b, p);
  return area > 0 ? 1 : area < 0 ? -1 : 0;
}

/// Of a point on the line through a and b: between them, ends included.
bool is_between(const GridPoint& a, const GridPoint& b, const GridPoint& p) {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

/// Whether two segments, which may be points, have a point in common.
bool meet(const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& d) {
  const int c_side = side(a, b, c);
  const int d_side = side(a, b, d);
  const int a_side = side(c, d, a);
  const int b_side = side(c, d, b);
  if (c_side * d_side < 0 && a_side * b_side < 0) return true;
  return (c_side == 0 && is_between(a, b, c)) || (d_side == 0 && is_between(a, b, d)) ||
         (a_side == 0 && is_between(c, d, a)) || (b_side == 0 && is_between(c, d, b));
}

}  // namespace

PixelSquare pixel_square(std::int64_t x, std::int64_t y, int subpixel_bits, std::int64_t uncertainty) {
  const std::int64_t one = std::int64_t{1} << subpixel_bits;
  return {.least = {x * one - uncertainty, y * one - uncertainty},
          .most = {(x + 1) * one + uncertainty, (y + 1) * one + uncertainty}};
}

bool touches(const GridTriangle& triangle, const PixelSquare& square) {
  const std::array<GridPoint, 4> corner = corners_of(square);
  if (std::ranges::any_of(triangle, [&](const GridPoint& vertex) { return holds(square, vertex); }) ||
      std::ranges::any_of(corner, [&](const GridPoint& p) { return holds(triangle, p); })) {
    return true;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      if (meet(triangle[i], triangle[(i + 1) % 3], corner[k], corner[(k + 1) % 4])) return true;
    }
  }
  return false;
}

bool fills(const GridTriangle& triangle, const PixelSquare& square) {
  return std::ranges::all_of(corners_of(square), [&](const GridPoint& p) { return holds(triangle, p); });
}

}  // namespace halfspace::reference
