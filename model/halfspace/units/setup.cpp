#include "halfspace/units/setup.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "halfspace/units/hi_z_plane.hpp"

namespace halfspace {
namespace {

std::int64_t twice_signed_area(const std::array<ScreenVertex, 3>& v) {
  const std::int64_t abx = v[1].x - v[0].x;
  const std::int64_t aby = v[1].y - v[0].y;
  const std::int64_t acx = v[2].x - v[0].x;
  const std::int64_t acy = v[2].y - v[0].y;
  return abx * acy - acx * aby;
}

/// Starts the cycle at the topmost, then leftmost vertex, so that equal triangles give equal equations.
void rotate_to_first(std::array<ScreenVertex, 3>& v) {
  const auto above = [](const ScreenVertex& l, const ScreenVertex& r) {
    return std::tie(l.y, l.x) < std::tie(r.y, r.x);
  };
  std::rotate(v.begin(), std::min_element(v.begin(), v.end(), above), v.end());
}

}  // namespace

PixelRect sample_bounds(const std::array<ScreenVertex, 3>& v, int sub_pixel_bits, const SampleBox& samples) {
  const auto [x_min, x_max] = std::minmax({v[0].x, v[1].x, v[2].x});
  const auto [y_min, y_max] = std::minmax({v[0].y, v[1].y, v[2].y});
  const std::int32_t to_ceil = (1 << sub_pixel_bits) - 1;
  const auto way = [sub_pixel_bits](int sixteenths) { return sample_way(sixteenths, sub_pixel_bits); };
  // the samples of pixel p are at p * 2^s + way: first = ceil((min - most way) / 2^s), last = floor((max -
  // least way) / 2^s)
  return {.x_first = (x_min - way(samples.x_most) + to_ceil) >> sub_pixel_bits,
          .y_first = (y_min - way(samples.y_most) + to_ceil) >> sub_pixel_bits,
          .x_last = (x_max - way(samples.x_least)) >> sub_pixel_bits,
          .y_last = (y_max - way(samples.y_least)) >> sub_pixel_bits};
}

SetupVerdict setup(const ScreenTriangle& in, const SetupState& state, SetupTriangle& out) {
  std::array<ScreenVertex, 3> v = in.v;
  std::int64_t area2 = twice_signed_area(v);
  if (area2 == 0) {
    return SetupVerdict::kZeroArea;
  }
  const bool front = (area2 > 0) == state.front_positive_area;
  if (front ? state.cull_front : state.cull_back) {
    return SetupVerdict::kCulled;
  }
  const PixelRect box = sample_bounds(v, state.sub_pixel_bits, state.samples);
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
  rotate_to_first(v);

  const std::int64_t centre = std::int64_t{1} << (state.sub_pixel_bits - 1);
  for (std::size_t i = 0; i < 3; ++i) {
    const ScreenVertex& from = v[(i + 1) % 3];
    const ScreenVertex& to = v[(i + 2) % 3];
    Edge& edge = out.edge[i];
    edge.a = from.y - to.y;
    edge.b = to.x - from.x;
    const bool owns = owns_its_samples(edge.a, edge.b, state.fill_rule);
    edge.c = edge.a * (centre - from.x) + edge.b * (centre - from.y) - (owns ? 0 : 1);
    out.depth.bias[i] = owns ? 0 : 1;
  }
  out.triangle = in.triangle;
  out.front = front;
  if (state.depth_format != DepthFormat::kNone) {
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
