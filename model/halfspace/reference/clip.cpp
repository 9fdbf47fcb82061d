#include "halfspace/reference/clip.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace halfspace::reference {
namespace {

double evaluate(const Homogeneous& plane, const Homogeneous& v) {
  return plane.x * v.x + plane.y * v.y + plane.z * v.z + plane.w * v.w;
}

/// Where the edge from `in` (distance d_in >= 0) to `out` (d_out < 0) meets the plane. Always computed from
/// the inside to the outside, so that the two triangles at an edge get the same new vertex.
Corner intersection(const Corner& in, double d_in, const Corner& out, double d_out) {
  const double t = d_in / (d_in - d_out);
  Corner cut;
  cut.x = in.x + t * (out.x - in.x);
  cut.y = in.y + t * (out.y - in.y);
  cut.z = in.z + t * (out.z - in.z);
  cut.w = in.w + t * (out.w - in.w);
  for (std::size_t i = 0; i < 3; ++i) cut.color[i] = in.color[i] + t * (out.color[i] - in.color[i]);
  return cut;
}

/// The largest k, up to `factor`, for which start + (k + 1) * size / 2 and start + (-k + 1) * size / 2 stay
/// in +-limit.
double widening(double factor, double limit, double start, double size) {
  const double half = std::abs(size) / 2;
  const double centre = std::abs(start + size / 2);
  return half == 0 ? factor : std::min(factor, (limit - centre) / half);
}

}  // namespace

Polygon clip(const Polygon& polygon, const Homogeneous& plane) {
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Corner& from = polygon[i];
    const Corner& to = polygon[(i + 1) % polygon.size()];
    const double d_from = evaluate(plane, from);
    const double d_to = evaluate(plane, to);
    if (d_from >= 0) result.push_back(from);
    if (d_from >= 0 && d_to < 0) result.push_back(intersection(from, d_from, to, d_to));
    if (d_from < 0 && d_to >= 0) result.push_back(intersection(to, d_to, from, d_from));
  }
  return result;
}

Polygon clip(const Polygon& polygon, const std::vector<Homogeneous>& planes) {
  Polygon result = polygon;
  for (const Homogeneous& plane : planes) result = clip(result, plane);
  return result;
}

std::vector<Homogeneous> depth_planes(bool ndc_z_minus_one_to_one) {
  const Homogeneous near_plane = ndc_z_minus_one_to_one ? Homogeneous{0, 0, 1, 1} : Homogeneous{0, 0, 1, 0};
  const Homogeneous far_plane = {0, 0, -1, 1};
  return {near_plane, far_plane};
}

std::vector<Homogeneous> guard_band_planes(double factor, double limit, double viewport_x, double viewport_y,
                                           double width, double height) {
  const double kx = widening(factor, limit, viewport_x, width);
  const double ky = widening(factor, limit, viewport_y, height);
  return {{-1, 0, 0, kx}, {1, 0, 0, kx}, {0, -1, 0, ky}, {0, 1, 0, ky}};
}

}  // namespace halfspace::reference
