#include "halfspace/reference/exact_triangle.hpp"

#include <utility>

namespace halfspace::reference {
namespace {

bool inside_edge(const GridPoint& a, const GridPoint& b, const GridPoint& sample, TieRule rule) {
  // The edge function is the doubled area of the triangle that the edge and the sample span.
  const Int128 side = twice_area(a, b, sample);
  if (side == 0) return owns_samples(a.y - b.y, b.x - a.x, rule);
  return side > 0;
}

}  // namespace

Int128 twice_area(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  return static_cast<Int128>(b.x - a.x) * (c.y - a.y) - static_cast<Int128>(c.x - a.x) * (b.y - a.y);
}

GridTriangle clockwise(const GridTriangle& triangle) {
  GridTriangle result = triangle;
  if (twice_area(result[0], result[1], result[2]) < 0) std::swap(result[1], result[2]);
  return result;
}

GridPoint pixel_centre(std::int64_t x, std::int64_t y, int subpixel_bits) {
  const std::int64_t one = std::int64_t{1} << subpixel_bits;
  return {x * one + one / 2, y * one + one / 2};
}

GridPoint place_in_pixel(std::int64_t x, std::int64_t y, int right, int down, int subpixel_bits) {
  const std::int64_t one = std::int64_t{1} << subpixel_bits;
  return {x * one + right * one / 16, y * one + down * one / 16};
}

bool covers(const GridTriangle& triangle, const GridPoint& sample, TieRule rule) {
  if (twice_area(triangle[0], triangle[1], triangle[2]) == 0) return false;
  const GridTriangle t = clockwise(triangle);
  return inside_edge(t[0], t[1], sample, rule) && inside_edge(t[1], t[2], sample, rule) &&
         inside_edge(t[2], t[0], sample, rule);
}

}  // namespace halfspace::reference
