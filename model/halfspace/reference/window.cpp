#include "halfspace/reference/window.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace halfspace::reference {

WindowVertex to_window(const Homogeneous& v, const Command& draw) {
  WindowVertex result;
  result.x = draw.viewport.x + (v.x / v.w + 1) * draw.viewport.z / 2;
  result.y = draw.viewport.y + (v.y / v.w + 1) * draw.viewport.w / 2;
  result.z = to_depth(v.z / v.w, draw);
  return result;
}

double to_depth(double ndc_z, const Command& draw) {
  const double range_near = draw.depth_range.x;
  const double range_far = draw.depth_range.y;
  return draw.has(Flag::kNdcZMinusOneToOne)
             ? (range_far - range_near) / 2 * ndc_z + (range_far + range_near) / 2
             : range_near + ndc_z * (range_far - range_near);
}

GridPoint snap(const WindowVertex& v, int subpixel_bits) {
  // nearbyint rounds ties to even in the default rounding mode, which nothing here changes.
  const double scale = std::ldexp(1.0, subpixel_bits);
  return {static_cast<std::int64_t>(std::nearbyint(v.x * scale)),
          static_cast<std::int64_t>(std::nearbyint(v.y * scale))};
}

WindowTriangle on_grid(const WindowTriangle& t, int subpixel_bits) {
  WindowTriangle result = t;
  for (WindowVertex& v : result) {
    const GridPoint p = snap(v, subpixel_bits);
    v.x = std::ldexp(static_cast<double>(p.x), -subpixel_bits);
    v.y = std::ldexp(static_cast<double>(p.y), -subpixel_bits);
  }
  return result;
}

DepthPlane depth_plane(const WindowTriangle& t) {
  // Cramer's rule for z - z0 = dzdx (x - x0) + dzdy (y - y0) at the other two vertices.
  const double x1 = t[1].x - t[0].x;
  const double y1 = t[1].y - t[0].y;
  const double z1 = t[1].z - t[0].z;
  const double x2 = t[2].x - t[0].x;
  const double y2 = t[2].y - t[0].y;
  const double z2 = t[2].z - t[0].z;
  const double area = x1 * y2 - x2 * y1;
  if (area == 0) return {t[0].x, t[0].y, t[0].z, 0, 0};
  return {t[0].x, t[0].y, t[0].z, (z1 * y2 - z2 * y1) / area, (x1 * z2 - x2 * z1) / area};
}

double polygon_offset(const DepthPlane& plane, double largest_depth, const Command& draw, Storage storage) {
  if (!draw.has(Flag::kPolygonOffset)) return 0;
  const double slope = std::max(std::abs(plane.dzdx), std::abs(plane.dzdy));
  double step = 0;
  if (storage == Storage::kFloat32) {
    // 2^(e - 23), with e the exponent of the largest depth; float32 has 23 bits after the point.
    if (largest_depth > 0) step = std::ldexp(1.0, std::ilogb(largest_depth) - 23);
  } else {
    step = 1 / (std::ldexp(1.0, unorm_bits(storage)) - 1);
  }
  const double offset = slope * draw.offset_factor + step * draw.offset_units;
  if (draw.offset_clamp > 0) return std::min(offset, static_cast<double>(draw.offset_clamp));
  if (draw.offset_clamp < 0) return std::max(offset, static_cast<double>(draw.offset_clamp));
  return offset;
}

double offset_and_clamped(double depth, double offset, const Command& draw) {
  const double moved = depth + offset;
  const auto [low, high] = std::minmax({draw.depth_range.x, draw.depth_range.y});
  if (draw.has(Flag::kDepthClamp))
    return std::clamp(moved, static_cast<double>(low), static_cast<double>(high));
  if (low >= 0 && high <= 1) return std::clamp(moved, 0.0, 1.0);
  constexpr double kLargest = std::numeric_limits<float>::max();
  return std::clamp(moved, -kLargest, kLargest);
}

}  // namespace halfspace::reference
