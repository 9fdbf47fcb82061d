/// Clipping of convex polygons: I. Sutherland and G. Hodgman, "Reentrant Polygon Clipping", CACM 17(1), 1974.
#pragma once

#include <array>
#include <cstddef>

namespace halfspace {

/// A convex polygon. A triangle cut by the six planes of a clip volume has at most 9 corners.
template <class Vertex>
struct Polygon {
  std::array<Vertex, 9> v;
  std::size_t size = 0;

  void push(const Vertex& vertex) { v[size++] = vertex; }
};

/// Where the line from a to b meets the plane, given the distances of both, which differ in sign. Swapping a
/// and b or turning the plane over gives the same result to the bit, so polygons that share an edge share the
/// cut.
template <class Vertex>
Vertex cut(const Vertex& a, double distance_a, const Vertex& b, double distance_b) {
  return (a * distance_b - b * distance_a) / (distance_b - distance_a);
}

/// The part of `in` where distance(vertex) >= 0, a linear function.
template <class Vertex, class Distance>
Polygon<Vertex> clip(const Polygon<Vertex>& in, const Distance& distance) {
  Polygon<Vertex> out;
  for (std::size_t i = 0; i < in.size; ++i) {
    const Vertex& here = in.v[i];
    const Vertex& next = in.v[i + 1 == in.size ? 0 : i + 1];
    const double d_here = distance(here);
    const double d_next = distance(next);
    if (d_here >= 0) {
      out.push(here);
    }
    if ((d_here >= 0) != (d_next >= 0)) {
      out.push(cut(here, d_here, next, d_next));
    }
  }
  return out;
}

}  // namespace halfspace
