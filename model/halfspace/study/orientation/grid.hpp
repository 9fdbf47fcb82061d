/// Orientations of 256 x 256 points p, neighbours a unit in the last place apart.
#pragma once

#include <functional>
#include <vector>

#include "halfspace/study/orientation/orientation.hpp"

namespace halfspace::study {

inline constexpr int kGridSide = 256;

/// Where p goes: points[0] + (x unit, y unit).
struct Grid {
  Triple points;
  double unit;

  [[nodiscard]] Triple at(int x, int y) const {
    return {Point{points[0].x + x * unit, points[0].y + y * unit}, points[1], points[2]};
  }
};

/// Of double, as published: the unit is 2^-53.
Grid double_grid(const Setting& setting);

/// The same with all points rounded to float32: the unit is 2^-24.
Grid float_grid(const Setting& setting);

/// A value for each point, row by row, the least y first.
using Values = std::vector<int>;

Values over(const Grid& grid, const std::function<int(const Triple&)>& value);

/// What floating-point arithmetic makes of signs.
struct Errors {
  int false_zero = 0;  ///< 0 for another sign
  int false_sign = 0;  ///< another sign for 0
  int opposite = 0;    ///< the other sign

  [[nodiscard]] int all() const { return false_zero + false_sign + opposite; }
};

Errors errors(const Values& exact, const Values& computed);

/// Into how many of the two half planes p falls of which one is to the left of the line from q to r and the
/// other of the line from r to q, as a rasterizer finds it: each edge is seen from where it begins, and a
/// point on it belongs to the half plane whose edge is a left or a top one. It should be one.
template <class Real>
int rounded_owners(const Triple& points) {
  const auto owns = [](const Point& from, const Point& to) {
    return from.y > to.y || (from.y == to.y && from.x < to.x);
  };
  const auto inside = [&](const Point& from, const Point& to) {
    const int side = rounded_orientation<Real>({from, to, points[0]}, Pivot::kP);
    return side > 0 || (side == 0 && owns(from, to));
  };
  return (inside(points[1], points[2]) ? 1 : 0) + (inside(points[2], points[1]) ? 1 : 0);
}

}  // namespace halfspace::study
