#include "halfspace/units/line_setup.hpp"

#include <utility>

#include "halfspace/units/hi_z_plane.hpp"

namespace halfspace {
namespace {

PixelRect box_of(const ThinLine& line) {
  return line.x_major ? PixelRect{.x_first = line.first,
                                  .y_first = line.minor_first,
                                  .x_last = line.last,
                                  .y_last = line.minor_last}
                      : PixelRect{.x_first = line.minor_first,
                                  .y_first = line.first,
                                  .x_last = line.minor_last,
                                  .y_last = line.last};
}

}  // namespace

std::array<ScreenVertex, 3> line_depth_triangle(const ScreenTriangle& line, bool x_major,
                                                int sub_pixel_bits) {
  const ScreenVertex& a = line.v[0];
  const ScreenVertex& b = line.v[1];
  ScreenVertex beside = a;
  std::int32_t& minor = x_major ? beside.y : beside.x;
  minor += minor < 0 ? 1 << sub_pixel_bits : -(1 << sub_pixel_bits);  // stays inside the guard band
  std::array<ScreenVertex, 3> v{a, b, beside};
  if (twice_signed_area(v) < 0) {
    std::swap(v[1], v[2]);
  }
  return v;
}

SetupVerdict line_setup(const ScreenTriangle& in, const SetupState& state, SetupTriangle& out) {
  const LinePoint a = line_start(in);
  const LinePoint b = line_end(in);
  if (a == b) {
    return SetupVerdict::kZeroArea;
  }
  const ThinLine line = thin_line(a, b, state.line_rule, state.line_width, state.sub_pixel_bits);
  if (line.empty()) {
    return SetupVerdict::kNoSample;
  }
  out.bounds = intersect(box_of(line), intersect(state.bounds, in.within));
  if (out.bounds.empty()) {
    return SetupVerdict::kOutside;
  }
  out.edge = {line.edge[0], line.edge[1], Edge{}};
  out.triangle = in.triangle;
  out.piece = in.piece;
  out.front = true;
  out.depth = {};
  out.plane = {};
  if (state.depth_format == DepthFormat::kNone || state.interpolator != DepthInterpolator::kPlane) {
    return SetupVerdict::kDrawn;
  }
  const std::array<ScreenVertex, 3> v = line_depth_triangle(in, line.x_major, state.sub_pixel_bits);
  std::array<Edge, 3> weights;
  for (std::size_t i = 0; i < 3; ++i) {
    weights[i] = edge_opposite(v, i, state.sub_pixel_bits);
  }
  make_depth_equation(v, in.offset, weights, twice_signed_area(v), state.depth_format, state.limits,
                      state.interpolator, out.depth);
  if (state.hi_z) {
    out.plane = hi_z_plane(out.depth, state.depth_format, state.sub_pixel_bits);
  }
  return SetupVerdict::kDrawn;
}

}  // namespace halfspace
