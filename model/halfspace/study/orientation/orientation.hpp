/// The orientation of three points: the sign of
///
///     (qx - px) (ry - py) - (qy - py) (rx - px)
///
/// by floating-point and by exact arithmetic. L. Kettner, K. Mehlhorn, S. Pion, S. Schirra, C. Yap,
/// "Classroom examples of robustness problems in geometric computations", Computational Geometry 40 (2008).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace halfspace::study {

struct Point {
  double x = 0;
  double y = 0;
};

using Triple = std::array<Point, 3>;  ///< p, q, r

/// The point from which the others are seen, p in the formula above. In exact arithmetic the result is the
/// same for each: section 3 of the paper.
enum class Pivot : std::uint8_t { kP, kQ, kR };

/// -1, 0 or 1, with every operation rounded to Real. The coordinates must be values of Real.
template <class Real>
int rounded_orientation(const Triple& points, Pivot pivot) {
  const auto first = static_cast<std::size_t>(pivot);
  const Point& a = points[first];
  const Point& b = points[(first + 1) % 3];
  const Point& c = points[(first + 2) % 3];
  const auto difference = [](double to, double from) {
    return static_cast<Real>(static_cast<Real>(to) - static_cast<Real>(from));
  };
  const Real left = difference(b.x, a.x) * difference(c.y, a.y);
  const Real right = difference(b.y, a.y) * difference(c.x, a.x);
  const Real value = left - right;
  return (value > 0) - (value < 0);
}

/// In rational numbers.
int exact_orientation(const Triple& points);

/// A figure of the paper: q, r, and the first of the points p.
struct Setting {
  std::string_view name;
  Triple points;
};

/// Those of figure 2.
std::span<const Setting> settings();

}  // namespace halfspace::study
