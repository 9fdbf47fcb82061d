/// How far a stored depth may be from the exact one: the bounds of docs/numerics.md.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "halfspace/stress/case.hpp"
#include "halfspace/stress/exact_plane.hpp"
#include "halfspace/units/depth_interpolator.hpp"

namespace halfspace::stress {

/// In units of the last place of the stored code at the sample of `error`. `spread`: the sum of the
/// magnitudes of the vertices' weights there, 1 inside the triangle; outside, the plane carries on what the
/// vertices were rounded by.
inline double depth_bound(const Precision& precision, DepthInterpolator interpolator,
                          const std::array<float, 3>& z, const ExactPlane& plane,
                          const ExactPlane::Error& error, double spread = 1) {
  const DepthFormat format = precision.format;
  // The front end resolves depths that are tiny beside the largest vertex, where it covers centres and
  // samples are there.
  const bool by_sample = precision.samples.is_centre() && precision.conservative == Conservative::kOff;
  const auto [least, most] = std::minmax({z[0], z[1], z[2]});
  const double vertex = std::max(std::abs(least), std::abs(most));
  const double largest = std::ldexp(1.0, std::ilogb(std::max(vertex, plane.offset())) + 1);
  const bool is_plane = interpolator == DepthInterpolator::kPlane;
  if (format == DepthFormat::kFloat32) {
    const double relative = is_plane ? 0.59 : 0.52;
    if (least >= 0 && plane.offset() == 0 && (by_sample || !is_plane)) {
      return relative;
    }
    // An offset is a float32, and where terms cancel they keep their own last place.
    const double rounded = plane.offset() == 0 ? 0 : std::max(plane.offset() * 0x1p-24, 0x1p-150);
    const double carried = (spread - 1) * 0x1p-63;  // words of vertices are cut
    const double absolute = rounded + largest * (is_plane ? 0x1p-58 + carried : 5 * 0x1p-31);
    return is_plane && by_sample && plane.offset() == 0 ? relative : relative + absolute / error.unit;
  }
  // Vertices and offset are rounded to half a unit of a vertex depth each.
  const double fraction = std::ldexp(1.0, -vertex_depth_fraction(format));
  const double rounding = 0.5 + ((plane.offset() == 0 ? 0 : 0.5) + 0.5 * spread) * fraction;
  // Which words the plane takes is decided by the rounded vertices: one just below 0 is 0.
  const bool beyond =
      vertex_depth_code(format, least) < 0 || vertex_depth_code(format, most) >= kShortWordEnd;
  if (is_plane) {
    return rounding + (beyond ? largest * 0x1p-56 / error.unit : 21.5 * fraction);
  }
  const double cut = beyond ? 2 * std::max(largest, 1.0) * fraction : 0;
  return rounding + (most - least) * 0.82 * 0x1p-28 / error.unit + cut;
}

}  // namespace halfspace::stress
