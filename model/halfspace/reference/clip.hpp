/// Homogeneous clipping of one triangle, in double precision (Sutherland and Hodgman, "Reentrant polygon
/// clipping", CACM 17(1), 1974, on the clip space of Blinn and Newell, "Clipping using homogeneous
/// coordinates", 1978).
#pragma once

#include <array>
#include <vector>

namespace halfspace::reference {

/// A position in clip space, or a linear function a*x + b*y + c*z + d*w on it.
struct Homogeneous {
  double x = 0;
  double y = 0;
  double z = 0;
  double w = 0;
};

using Color = std::array<double, 3>;  ///< red, green and blue in [0, 1]

/// A corner of a polygon, with an attribute that a cut interpolates as it does the position.
struct Corner : Homogeneous {
  Color color = {};
};

using Polygon = std::vector<Corner>;

/// The part of `polygon` where `plane` is not negative. Vertices that are kept are kept unchanged.
[[nodiscard]] Polygon clip(const Polygon& polygon, const Homogeneous& plane);

/// The same, one plane after the other.
[[nodiscard]] Polygon clip(const Polygon& polygon, const std::vector<Homogeneous>& planes);

/// Depth planes of the clip volume: -w <= z <= w, or 0 <= z <= w.
[[nodiscard]] std::vector<Homogeneous> depth_planes(bool ndc_z_minus_one_to_one);

/// Planes of the guard band: |x| <= k_x w and |y| <= k_y w, that is, the clip volume made k times as wide and
/// high. Each k is `factor`, or less where that would leave the window coordinates within +-`limit` pixels,
/// for a viewport of x, y, width and height.
[[nodiscard]] std::vector<Homogeneous> guard_band_planes(double factor, double limit, double viewport_x,
                                                         double viewport_y, double width, double height);

}  // namespace halfspace::reference
