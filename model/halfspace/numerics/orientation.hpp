/// Which way three points turn, without an error of rounding.
///
/// J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates",
/// Discrete & Computational Geometry 18, 1997, section 4.2. Coordinates are exact as factors are (see
/// exact_sum.hpp).
#pragma once

#include <cmath>
#include <glm/vec2.hpp>
#include <limits>

#include "halfspace/numerics/exact_sum.hpp"

namespace halfspace {

/// 1 when a, b, c turn left, -1 when they turn right, 0 when they are on one line.
inline int orientation(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
  const glm::dvec2 u = a - c;
  const glm::dvec2 v = b - c;
  const double left = u.x * v.y;
  const double right = u.y * v.x;
  // The error of left - right (Shewchuk's ccwerrboundA), and the little that tiny products can lose.
  constexpr double kHalfUlp = std::numeric_limits<double>::epsilon() / 2;
  constexpr double kErrorBound = (3 + 16 * kHalfUlp) * kHalfUlp;
  const double bound = kErrorBound * (std::abs(left) + std::abs(right)) + std::numeric_limits<double>::min();
  if (std::abs(left - right) > bound) return left > right ? 1 : -1;

  const bool exact_differences = error_of_sum(a.x, -c.x, u.x) == 0 && error_of_sum(a.y, -c.y, u.y) == 0 &&
                                 error_of_sum(b.x, -c.x, v.x) == 0 && error_of_sum(b.y, -c.y, v.y) == 0;
  if (exact_differences) {
    // Rounding keeps the order of the products, and their errors decide between equals.
    if (left != right) return left > right ? 1 : -1;
    const double left_error = error_of_product(u.x, v.y, left);
    const double right_error = error_of_product(u.y, v.x, right);
    return left_error == right_error ? 0 : left_error > right_error ? 1 : -1;
  }
  ExactSum<12> sum;
  const auto add_cross = [&sum](glm::dvec2 p, glm::dvec2 q) {
    sum.add_product(p.x, q.y);
    sum.add_product(-p.y, q.x);
  };
  add_cross(a, b);
  add_cross(b, c);
  add_cross(c, a);
  return sum.sign();
}

/// Of points on one line: b lies between a and c, and is neither.
inline bool strictly_between(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
  const auto less = [](glm::dvec2 p, glm::dvec2 q) { return p.x != q.x ? p.x < q.x : p.y < q.y; };
  return (less(a, b) && less(b, c)) || (less(c, b) && less(b, a));
}

}  // namespace halfspace
