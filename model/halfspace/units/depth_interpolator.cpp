#include "halfspace/units/depth_interpolator.hpp"

#include <algorithm>

#include "halfspace/units/depth_barycentric.hpp"
#include "halfspace/units/depth_plane.hpp"

namespace halfspace {

void make_depth_equation(const std::array<ScreenVertex, 3>& v, const std::array<Edge, 3>& edge,
                         std::int64_t area2, DepthFormat format, DepthInterpolator interpolator,
                         DepthEquation& out) {
  if (interpolator == DepthInterpolator::kPlane) {
    out.plane = plane_equation(v, edge, area2, format);
    return;
  }
  out.z = {v[0].z, v[1].z, v[2].z};
  out.area2 = area2;
  const auto [z_min, z_max] = std::minmax({v[0].z, v[1].z, v[2].z});
  out.min_code = stored_code(format, z_min);
  out.max_code = stored_code(format, z_max);
  set_reciprocal(out);
}

}  // namespace halfspace
