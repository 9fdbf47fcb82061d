#include "halfspace/scene/front_end.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace halfspace {
namespace {

/// Pixels to each side of the origin of the window; 16 integer bits would hold one more.
constexpr double kGuardBand = 32767;

bool finite(const glm::vec4& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}

}  // namespace

FrontEnd::FrontEnd(const Frame& frame, const Command& draw, DepthFormat format, int sub_pixel_bits)
    : frame_(frame),
      draw_(draw),
      format_(format),
      sub_pixels_(1 << sub_pixel_bits),
      depth_clamp_(draw.has(Flag::kDepthClamp)),
      polygon_offset_(draw.has(Flag::kPolygonOffset) && format != DepthFormat::kNone) {
  const double near = draw.depth_range.x;
  const double far = draw.depth_range.y;
  const bool symmetric = draw.has(Flag::kNdcZMinusOneToOne);
  z_scale_ = symmetric ? (far - near) / 2 : far - near;
  z_bias_ = symmetric ? (far + near) / 2 : near;
  // Depth bias may leave the depth range of the viewport, but not [0, 1].
  z_least_ = polygon_offset_ && !depth_clamp_ ? 0 : std::min(near, far);
  z_most_ = polygon_offset_ && !depth_clamp_ ? 1 : std::max(near, far);

  const double x_half = draw.viewport.z / 2.0;
  const double y_half = draw.viewport.w / 2.0;
  const double x_centre = draw.viewport.x + x_half;
  const double y_centre = draw.viewport.y + y_half;
  if (!depth_clamp_) {
    planes_[plane_count_++] = symmetric ? Clip(0, 0, 1, 1) : Clip(0, 0, 1, 0);
    planes_[plane_count_++] = Clip(0, 0, -1, 1);
  }
  // -G <= x / w * x_half + x_centre <= G, multiplied by w; together they also demand w >= 0
  planes_[plane_count_++] = Clip(x_half, 0, 0, kGuardBand + x_centre);
  planes_[plane_count_++] = Clip(-x_half, 0, 0, kGuardBand - x_centre);
  planes_[plane_count_++] = Clip(0, y_half, 0, kGuardBand + y_centre);
  planes_[plane_count_++] = Clip(0, -y_half, 0, kGuardBand - y_centre);
}

FrontEnd::Window FrontEnd::to_window(const Clip& v) const {
  return {draw_.viewport.x + (v.x / v.w + 1) * draw_.viewport.z / 2,
          draw_.viewport.y + (v.y / v.w + 1) * draw_.viewport.w / 2, v.z / v.w * z_scale_ + z_bias_};
}

ScreenVertex FrontEnd::snap(const Window& v) const {
  ScreenVertex out{.x = static_cast<std::int32_t>(std::lrint(v.x * sub_pixels_)),
                   .y = static_cast<std::int32_t>(std::lrint(v.y * sub_pixels_)),
                   .z = 0};
  if (format_ != DepthFormat::kNone) {
    out.z = vertex_depth_code(format_, std::clamp(v.z, z_least_, z_most_));
  }
  return out;
}

void FrontEnd::process(std::uint32_t index, std::vector<ScreenTriangle>& out,
                       FrontEndCounters& counters) const {
  ++counters.triangles;
  Polygon<Clip> polygon;
  for (std::uint32_t i = 0; i < 3; ++i) {
    const std::size_t at = std::size_t{draw_.first_index} + std::size_t{index} * 3 + i;
    const glm::vec4& v = frame_.vertices[std::size_t{draw_.first_vertex} + frame_.indices[at]];
    if (!finite(v)) {
      ++counters.non_finite;
      return;
    }
    polygon.push(v);
  }
  bool cut = false;
  for (std::size_t p = 0; p < plane_count_ && polygon.size != 0; ++p) {
    const auto distance = [&](const Clip& v) { return glm::dot(planes_[p], v); };
    if (distance(polygon.v[0]) < 0 || std::any_of(polygon.v.begin() + 1, polygon.v.begin() + polygon.size,
                                                  [&](const Clip& v) { return distance(v) < 0; })) {
      polygon = clip(polygon, distance);
      cut = true;
    }
  }
  if (polygon.size < 3) {
    ++counters.clipped_away;
    return;
  }
  counters.clipped += cut ? 1 : 0;

  Polygon<Window> window;
  for (std::size_t i = 0; i < polygon.size; ++i) {
    if (!(polygon.v[i].w > 0)) {
      ++counters.degenerate;
      return;
    }
    Window v = to_window(polygon.v[i]);
    // A cut lies on the guard band up to rounding, which for vertices many orders of magnitude apart can be
    // pixels.
    v.x = std::clamp(v.x, -kGuardBand, kGuardBand);
    v.y = std::clamp(v.y, -kGuardBand, kGuardBand);
    window.push(v);
  }
  if (polygon_offset_) {
    const double offset = offset_of(window);
    for (std::size_t i = 0; i < window.size; ++i) {
      window.v[i].z += offset;
    }
  }
  if ((depth_clamp_ || polygon_offset_) && format_ != DepthFormat::kNone) {
    emit_within_depth_range(window, index, out, counters);
  } else {
    emit_fan(window, index, out, counters);
  }
}

double FrontEnd::offset_of(const Polygon<Window>& polygon) const {
  // The plane of the largest triangle of the fan: cutting can leave others next to nothing.
  double area2 = 0;
  double slope = 0;
  for (std::size_t i = 1; i + 1 < polygon.size; ++i) {
    const Window u = polygon.v[i] - polygon.v[0];
    const Window v = polygon.v[i + 1] - polygon.v[0];
    const double area = u.x * v.y - u.y * v.x;
    if (std::abs(area) > std::abs(area2)) {
      area2 = area;
      slope = std::max(std::abs((u.z * v.y - v.z * u.y) / area), std::abs((v.z * u.x - u.z * v.x) / area));
    }
  }
  double unit = 0;
  if (format_ == DepthFormat::kFloat32) {
    double z_max = 0;
    for (std::size_t i = 0; i < polygon.size; ++i) {
      z_max = std::max(z_max, std::abs(polygon.v[i].z));
    }
    unit = z_max > 0 ? std::ldexp(1.0, std::ilogb(z_max) - 23) : 0;
  } else {
    unit = 1.0 / max_unorm_code(format_);  // a code; 2^-n is less and would leave some depths on theirs
  }
  const double offset = slope * draw_.offset_factor + unit * draw_.offset_units;
  const double clamp = draw_.offset_clamp;
  return clamp > 0 ? std::min(offset, clamp) : clamp < 0 ? std::max(offset, clamp) : offset;
}

/// Depth clamp acts on fragments: a triangle that leaves the range bends where it does. Its parts beyond are
/// cut off and laid flat onto the limit, which gives every fragment the clamped depth of the original plane.
void FrontEnd::emit_within_depth_range(const Polygon<Window>& polygon, std::uint32_t index,
                                       std::vector<ScreenTriangle>& out, FrontEndCounters& counters) const {
  const auto below = [&](const Window& v) { return z_least_ - v.z; };
  const auto above = [&](const Window& v) { return v.z - z_most_; };
  const auto beyond = [&](const Window& v) { return v.z < z_least_ || v.z > z_most_; };
  if (std::none_of(polygon.v.begin(), polygon.v.begin() + polygon.size, beyond)) {
    emit_fan(polygon, index, out, counters);
    return;
  }
  ++counters.depth_split;
  const Polygon<Window> under_most = clip(polygon, [&](const Window& v) { return -above(v); });
  emit_fan(clip(under_most, [&](const Window& v) { return -below(v); }), index, out, counters);
  emit_fan(clip(polygon, below), index, out, counters);  // snap() lays both flat
  emit_fan(clip(polygon, above), index, out, counters);
}

void FrontEnd::emit_fan(const Polygon<Window>& polygon, std::uint32_t index, std::vector<ScreenTriangle>& out,
                        FrontEndCounters& counters) const {
  for (std::size_t i = 1; i + 1 < polygon.size; ++i) {
    out.push_back({{snap(polygon.v[0]), snap(polygon.v[i]), snap(polygon.v[i + 1])}, index});
    ++counters.emitted;
  }
}

}  // namespace halfspace
