#include "halfspace/units/setup.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "halfspace/units/hi_z_plane.hpp"
#include "halfspace/units/line_setup.hpp"

namespace halfspace {
namespace {

/// Starts the cycle at the topmost, then leftmost vertex, so that equal triangles give equal equations.
void rotate_to_first(std::array<ScreenVertex, 3>& v) {
  const auto above = [](const ScreenVertex& l, const ScreenVertex& r) {
    return std::tie(l.y, l.x) < std::tie(r.y, r.x);
  };
  std::rotate(v.begin(), std::min_element(v.begin(), v.end(), above), v.end());
}

}  // namespace

std::int64_t twice_signed_area(const std::array<ScreenVertex, 3>& v) {
  const std::int64_t abx = v[1].x - v[0].x;
  const std::int64_t aby = v[1].y - v[0].y;
  const std::int64_t acx = v[2].x - v[0].x;
  const std::int64_t acy = v[2].y - v[0].y;
  return abx * acy - acx * aby;
}

Edge edge_opposite(const std::array<ScreenVertex, 3>& v, std::size_t i, int sub_pixel_bits) {
  const std::int64_t centre = std::int64_t{1} << (sub_pixel_bits - 1);
  const ScreenVertex& from = v[(i + 1) % 3];
  const ScreenVertex& to = v[(i + 2) % 3];
  Edge edge{.a = from.y - to.y, .b = to.x - from.x};
  edge.c = edge.a * (centre - from.x) + edge.b * (centre - from.y);
  return edge;
}

PixelRect sample_bounds(const std::array<ScreenVertex, 3>& v, int sub_pixel_bits, int reach,
                        const SampleBox& samples) {
  const auto [x_min, x_max] = std::minmax({v[0].x, v[1].x, v[2].x});
  const auto [y_min, y_max] = std::minmax({v[0].y, v[1].y, v[2].y});
  const std::int32_t to_ceil = (1 << sub_pixel_bits) - 1;
  const auto way = [sub_pixel_bits](int sixteenths) { return sample_way(sixteenths, sub_pixel_bits); };
  // the samples of pixel p are at p * 2^s + way: first = ceil((min - most way) / 2^s), last = floor((max -
  // least way) / 2^s)
  return {.x_first = (x_min - reach - way(samples.x_most) + to_ceil) >> sub_pixel_bits,
          .y_first = (y_min - reach - way(samples.y_most) + to_ceil) >> sub_pixel_bits,
          .x_last = (x_max + reach - way(samples.x_least)) >> sub_pixel_bits,
          .y_last = (y_max + reach - way(samples.y_least)) >> sub_pixel_bits};
}

SetupVerdict setup(const ScreenTriangle& in, const SetupState& state, SetupTriangle& out) {
  if (in.shape == ScreenShape::kThinLine) {
    return line_setup(in, state, out);
  }
  std::array<ScreenVertex, 3> v = in.v;
  std::int64_t area2 = twice_signed_area(v);
  const bool flat = area2 == 0;
  if (flat && state.conservative != Conservative::kOuter) {
    return SetupVerdict::kZeroArea;
  }
  const bool front = !flat && (area2 > 0) == state.front_positive_area;
  if (front ? state.cull_front : state.cull_back) {
    return SetupVerdict::kCulled;
  }
  const PixelRect box = sample_bounds(v, state.sub_pixel_bits, state.square_reach, state.samples);
  if (box.empty()) {
    return SetupVerdict::kNoSample;
  }
  out.bounds = intersect(box, intersect(state.bounds, in.within));
  if (out.bounds.empty()) {
    return SetupVerdict::kOutside;
  }

  if (area2 < 0) {
    std::swap(v[1], v[2]);
    area2 = -area2;
  }
  if (flat) {
    v[1].z = v[2].z = v[0].z;
    area2 = 1;  // of what has one depth it means nothing
  }
  rotate_to_first(v);

  for (std::size_t i = 0; i < 3; ++i) {
    Edge& edge = out.edge[i];
    edge = edge_opposite(v, i, state.sub_pixel_bits);
    const bool owns =
        state.conservative != Conservative::kOff || owns_its_samples(edge.a, edge.b, state.fill_rule);
    edge.c += to_square(edge.a, edge.b, state.square_reach) - (owns ? 0 : 1);
    out.depth.bias[i] = owns ? 0 : 1;
  }
  out.triangle = in.triangle;
  out.piece = in.piece;
  out.front = front;
  if (state.depth_format == DepthFormat::kNone) {
    out.depth.area2 = state.inner_coverage ? area2 : 0;
  } else {
    make_depth_equation(v, in.offset, out.edge, area2, state.depth_format, state.limits, state.interpolator,
                        out.depth);
  }
  const bool has_plane =
      state.depth_format != DepthFormat::kNone && state.interpolator == DepthInterpolator::kPlane;
  out.plane =
      state.hi_z && has_plane ? hi_z_plane(out.depth, state.depth_format, state.sub_pixel_bits) : HiZPlane{};
  return SetupVerdict::kDrawn;
}

}  // namespace halfspace
