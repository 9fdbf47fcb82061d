/// Edge functions in floating point, in the ways that textbooks and programs write them. Subjects of study:
/// none is exact.
#pragma once

#include <cmath>

#include "halfspace/reference/exact_triangle.hpp"
#include "halfspace/reference/tie_rule.hpp"

namespace halfspace::reference {

/// In window coordinates, in pixels.
template <class T>
struct FloatPoint {
  T x = 0;
  T y = 0;
};

/// A point of the grid of 1/2^subpixel_bits pixel.
inline FloatPoint<float> float_point(const GridPoint& p, int subpixel_bits) {
  return {std::ldexp(static_cast<float>(p.x), -subpixel_bits),
          std::ldexp(static_cast<float>(p.y), -subpixel_bits)};
}

/// E = A x + B y + C, positive inside.
template <class T>
struct FloatLine {
  T a = 0;
  T b = 0;
  T c = 0;

  [[nodiscard]] T at(T x, T y) const { return a * x + b * y + c; }
};

/// C as the difference of two products. The same edge turned round has the same line with the other sign.
template <class T>
FloatLine<T> line_by_difference(const FloatPoint<T>& from, const FloatPoint<T>& to) {
  return {from.y - to.y, to.x - from.x, from.x * to.y - to.x * from.y};
}

/// C as the mean of those of both ends: L. McMillan, MIT 6.837 Computer Graphics, lecture 6, 2000, slide 14.
/// Turned round it has the other sign too.
template <class T>
FloatLine<T> line_by_average(const FloatPoint<T>& from, const FloatPoint<T>& to) {
  const T a = from.y - to.y;
  const T b = to.x - from.x;
  return {a, b, -(a * (from.x + to.x) + b * (from.y + to.y)) / 2};
}

/// C of the vertex at which the edge begins, which is another one for the triangle on the other side.
template <class T>
FloatLine<T> line_from_vertex(const FloatPoint<T>& from, const FloatPoint<T>& to) {
  const T a = from.y - to.y;
  const T b = to.x - from.x;
  return {a, b, -(a * from.x + b * from.y)};
}

/// E = A (x - x0) + B (y - y0), relative to the vertex at which the edge begins.
template <class T>
struct VertexLine {
  T a = 0;
  T b = 0;
  FloatPoint<T> from;

  VertexLine() = default;
  VertexLine(const FloatPoint<T>& begin, const FloatPoint<T>& end)
      : a(begin.y - end.y), b(end.x - begin.x), from(begin) {}

  [[nodiscard]] T at(T x, T y) const { return a * (x - from.x) + b * (y - from.y); }
};

/// Whether a sample at which `edge` is `e` is on its inside.
template <class Edge, class T>
bool on_inside(const Edge& edge, T e, TieRule rule = TieRule::kTopLeft) {
  return e > 0 || (e == 0 && owns_samples(edge.a, edge.b, rule));
}

/// The same with all within `epsilon` taken for ties.
template <class Edge, class T>
bool on_inside_but_for(T epsilon, const Edge& edge, T e, TieRule rule = TieRule::kTopLeft) {
  return std::abs(e) <= epsilon ? owns_samples(edge.a, edge.b, rule) : e > 0;
}

}  // namespace halfspace::reference
