#include "halfspace/scene/front_end.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "halfspace/numerics/error.hpp"

namespace halfspace {
namespace {

/// 16 integer bits would hold a pixel more. Half of a line's width has room beyond.
double guard_band(const Command& draw) {
  constexpr double kGuardBand = 32767;
  constexpr int kHalfWidth = kMaxLineWidth / 2;
  return draw.draws_lines() ? kGuardBand - kHalfWidth - 1 : kGuardBand;
}

bool finite(const glm::vec4& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}

/// 2^kVertexDepthRange times the power of two at or above the larger end of the depth range, but not below 1;
/// at most 2^127, the largest power of two that a float32 holds.
double far_depth(const DepthRange& range) {
  const double largest = std::max({1.0, std::abs(range.least), std::abs(range.most)});
  const int above = std::ilogb(largest) + (std::exp2(std::ilogb(largest)) < largest ? 1 : 0);
  return std::ldexp(1.0, std::min(kVertexDepthRange + above, 127));
}

}  // namespace

FrontEnd::FrontEnd(const Frame& frame, const Command& draw, DepthFormat format, int sub_pixel_bits)
    : FrontEnd(frame, draw, format, sub_pixel_bits,
               draw.has(Flag::kBottomLeftRule) ? FillRule::kBottomLeft : FillRule::kTopLeft) {}

FrontEnd::FrontEnd(const Frame& frame, const Command& draw, DepthFormat format, int sub_pixel_bits,
                   FillRule rule, int square_reach, bool centres)
    : frame_(frame),
      draw_(draw),
      format_(format),
      sub_pixel_bits_(sub_pixel_bits),
      square_reach_(square_reach),
      rule_(rule),
      centres_(centres),
      guard_band_(guard_band(draw)),
      sub_pixels_(1 << sub_pixel_bits),
      screen_({.x_last = static_cast<std::int32_t>(frame.targets[draw.target].width) - 1,
               .y_last = static_cast<std::int32_t>(frame.targets[draw.target].height) - 1}),
      depth_clamp_(draw.has(Flag::kDepthClamp)),
      polygon_offset_(draw.has(Flag::kPolygonOffset) && format != DepthFormat::kNone) {
  const double near = draw.depth_range.x;
  const double far = draw.depth_range.y;
  const bool symmetric = draw.has(Flag::kNdcZMinusOneToOne);
  z_scale_ = symmetric ? (far - near) / 2 : far - near;
  z_bias_ = symmetric ? (far + near) / 2 : near;
  z_least_ = std::min(near, far);
  z_most_ = std::max(near, far);
  far_ = far_depth({z_least_, z_most_});
  unrestricted_ = draw.is_unrestricted(format);
  if (depth_clamp_) {
    limits_ = {z_least_, z_most_};
  } else if (unrestricted_) {
    constexpr double kLargest = std::numeric_limits<float>::max();
    limits_ = {-kLargest, kLargest};
  }
  add_planes();
  count_stipple();
}

void FrontEnd::add_planes() {
  const bool symmetric = draw_.has(Flag::kNdcZMinusOneToOne);
  const double x_half = draw_.viewport.z / 2.0;
  const double y_half = draw_.viewport.w / 2.0;
  const double x_centre = draw_.viewport.x + x_half;
  const double y_centre = draw_.viewport.y + y_half;
  if (!depth_clamp_) {
    planes_[plane_count_++] = symmetric ? Clip(0, 0, 1, 1) : Clip(0, 0, 1, 0);
    planes_[plane_count_++] = Clip(0, 0, -1, 1);
  }
  // -G <= x / w * x_half + x_centre <= G, multiplied by w; together they also demand w >= 0
  planes_[plane_count_++] = Clip(x_half, 0, 0, guard_band_ + x_centre);
  planes_[plane_count_++] = Clip(-x_half, 0, 0, guard_band_ - x_centre);
  planes_[plane_count_++] = Clip(0, y_half, 0, guard_band_ + y_centre);
  planes_[plane_count_++] = Clip(0, -y_half, 0, guard_band_ - y_centre);
}

FrontEnd::Window FrontEnd::to_window(const Clip& v) const {
  return {draw_.viewport.x + (v.x / v.w + 1) * draw_.viewport.z / 2,
          draw_.viewport.y + (v.y / v.w + 1) * draw_.viewport.w / 2, v.z / v.w * z_scale_ + z_bias_};
}

bool FrontEnd::read(std::uint32_t at, Clip& vertex, FrontEndCounters& counters) const {
  const std::uint32_t index = frame_.indices[std::size_t{draw_.first_index} + at];
  const glm::vec4& v = frame_.vertices[std::size_t{draw_.first_vertex} + index];
  vertex = v;
  const bool is_finite = finite(v);
  counters.non_finite += is_finite ? 0 : 1;
  return is_finite;
}

template <class Vertex, class Position>
bool FrontEnd::clip_to_planes(Polygon<Vertex>& polygon, const Position& position) const {
  bool cut = false;
  for (std::size_t p = 0; p < plane_count_ && polygon.size != 0; ++p) {
    const auto distance = [&](const Vertex& v) { return glm::dot(planes_[p], position(v)); };
    if (distance(polygon.v[0]) < 0 || std::any_of(polygon.v.begin() + 1, polygon.v.begin() + polygon.size,
                                                  [&](const Vertex& v) { return distance(v) < 0; })) {
      polygon = clip(polygon, distance);
      cut = true;
    }
  }
  return cut;
}

Polygon<FrontEnd::Corner> FrontEnd::corners(std::uint32_t index) const {
  Polygon<Corner> polygon;
  FrontEndCounters uncounted;
  for (std::uint32_t i = 0; i < 3; ++i) {
    Clip v;
    if (!read(index * 3 + i, v, uncounted)) {
      return {};
    }
    Corner corner{.clip = v, .weights = {}};
    corner.weights[static_cast<int>(i)] = 1;
    polygon.push(corner);
  }
  clip_to_planes(polygon, [](const Corner& corner) -> const Clip& { return corner.clip; });
  return polygon;
}

void FrontEnd::process(std::uint32_t index, std::vector<ScreenTriangle>& out,
                       FrontEndCounters& counters) const {
  ++counters.triangles;
  switch (draw_.primitive) {
    case Primitive::kTriangles:
      return process_triangle(index, out, counters);
    case Primitive::kLines:
    case Primitive::kLineStrip:
      return process_line(index, out, counters);
    case Primitive::kPoints:
      return process_point(index, out, counters);
  }
}

void FrontEnd::process_triangle(std::uint32_t index, std::vector<ScreenTriangle>& out,
                                FrontEndCounters& counters) const {
  Polygon<Clip> polygon;
  for (std::uint32_t i = 0; i < 3; ++i) {
    Clip v;
    if (!read(index * 3 + i, v, counters)) {
      return;
    }
    polygon.push(v);
  }
  const bool cut = clip_to_planes(polygon, [](const Clip& v) -> const Clip& { return v; });
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
    v.x = std::clamp(v.x, -guard_band_, guard_band_);
    v.y = std::clamp(v.y, -guard_band_, guard_band_);
    window.push(v);
  }
  emit_fan(window, index, out, counters);
}

void FrontEnd::emit_fan(const Polygon<Window>& polygon, std::uint32_t index, std::vector<ScreenTriangle>& out,
                        FrontEndCounters& counters) const {
  const double unit = polygon_offset_ ? offset_unit(polygon) : 0;
  if (draw_.polygon_mode != PolygonMode::kFill) {
    return emit_outline(polygon, unit, index, out, counters);
  }
  for (std::size_t i = 1; i + 1 < polygon.size; ++i) {
    const std::size_t first = out.size();
    emit({polygon.v[0], polygon.v[i], polygon.v[i + 1]}, unit, index, out, counters);
    for (std::size_t n = first; n < out.size(); ++n) {
      out[n].piece = static_cast<std::uint8_t>(i - 1);
    }
  }
}

void FrontEnd::emit(const std::array<Window, 3>& corner, double offset_unit, std::uint32_t index,
                    std::vector<ScreenTriangle>& out, FrontEndCounters& counters) const {
  ScreenTriangle triangle{.v = {}, .triangle = index};
  for (std::size_t i = 0; i < 3; ++i) {
    triangle.v[i].x = static_cast<std::int32_t>(std::lrint(corner[i].x * sub_pixels_));
    triangle.v[i].y = static_cast<std::int32_t>(std::lrint(corner[i].y * sub_pixels_));
  }
  std::array<double, 3> z{corner[0].z, corner[1].z, corner[2].z};
  if (!depth_clamp_) {
    for (double& depth : z) {
      depth = std::clamp(depth, z_least_, z_most_);  // clipped to it, up to rounding
    }
  }
  emit_snapped(triangle, z, polygon_offset_ ? offset_of(triangle, z, offset_unit) : 0, out, counters);
}

void FrontEnd::emit_snapped(ScreenTriangle triangle, std::array<double, 3> z, double offset,
                            std::vector<ScreenTriangle>& out, FrontEndCounters& counters) const {
  if (format_ != DepthFormat::kNone) {
    const SampleGrid grid{
        .sub_pixel_bits = sub_pixel_bits_, .square_reach = square_reach_, .screen = screen_};
    if (is_far(offset) || std::ranges::any_of(z, [this](double depth) { return is_far(depth); })) {
      for (double& depth : z) {
        depth += offset;
      }
      offset = 0;
    }
    const std::size_t before = out.size();
    if (std::ranges::any_of(z, [this](double depth) { return is_far(depth); })) {
      if (!centres_) {
        throw InputError(
            fmt::format("triangle {} of a draw of {} indices from {} has a vertex too far outside the depth "
                        "range for a plane; "
                        "legal for such draws: raster.samples = 1, at the pixel centre",
                        triangle.triangle, draw_.index_count, draw_.first_index));
      }
      emit_far(triangle, z, limits_, format_, grid, out);
      counters.emitted += out.size() - before;
      ++counters.far_depth;
      return;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      triangle.v[i].z = vertex_depth_code(format_, z[i]);
    }
    triangle.offset = vertex_depth_code(format_, offset);
    if (format_ == DepthFormat::kFloat32) {
      for (double& depth : z) {
        depth = static_cast<float>(depth);
      }
      if (square_reach_ == 0 && centres_ &&
          may_be_tiny(z, limits_)) {  // else no plane of centres is interpolated
        counters.tiny_depth += emit_tiny(triangle, z, grid, out) ? 1 : 0;
        counters.emitted += out.size() - before;
        return;
      }
    }
  }
  out.push_back(triangle);
  ++counters.emitted;
}

/// r of the specification: what one unit of polygon offset is.
double FrontEnd::offset_unit(const Polygon<Window>& polygon) const {
  if (format_ != DepthFormat::kFloat32) {
    return 1.0 / max_unorm_code(format_);  // a code; 2^-n is less and would leave some depths on theirs
  }
  double z_max = 0;
  for (std::size_t i = 0; i < polygon.size; ++i) {
    z_max = std::max(z_max, std::abs(polygon.v[i].z));
  }
  return z_max > 0 ? std::ldexp(1.0, std::ilogb(z_max) - 23) : 0;
}

/// The slope is that of the snapped triangle, as its depth is: on needles they differ many times.
double FrontEnd::offset_of(const ScreenTriangle& snapped, const std::array<double, 3>& z,
                           double offset_unit) const {
  const auto x = [&](std::size_t i) { return (snapped.v[i].x - snapped.v[0].x) / sub_pixels_; };
  const auto y = [&](std::size_t i) { return (snapped.v[i].y - snapped.v[0].y) / sub_pixels_; };
  const double area = x(1) * y(2) - x(2) * y(1);
  const double rise1 = z[1] - z[0];
  const double rise2 = z[2] - z[0];
  const double slope =
      area == 0 ? 0
                : std::max(std::abs(rise1 * y(2) - rise2 * y(1)), std::abs(rise2 * x(1) - rise1 * x(2))) /
                      std::abs(area);
  double offset = slope * draw_.offset_factor + offset_unit * draw_.offset_units;
  const double clamp = draw_.offset_clamp;
  offset = clamp > 0 ? std::min(offset, clamp) : clamp < 0 ? std::max(offset, clamp) : offset;
  // Nothing more changes a fragment: with this much all are clamped. Of far vertices a double may not hold
  // it.
  const DepthRange ends = unrestricted_ ? limits_ : DepthRange{.least = 0, .most = 1};
  const auto [z_min, z_max] = std::minmax({z[0], z[1], z[2]});
  return -z_min >= far_ || z_max >= far_ ? offset
                                         : std::clamp(offset, ends.least - 1 - z_max, ends.most + 1 - z_min);
}

}  // namespace halfspace
