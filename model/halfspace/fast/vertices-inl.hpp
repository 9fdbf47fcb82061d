// Without a guard that stops a second inclusion: once for each target of Highway.
#if defined(HALFSPACE_FAST_VERTICES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HALFSPACE_FAST_VERTICES_INL
#undef HALFSPACE_FAST_VERTICES_INL
#else
#define HALFSPACE_FAST_VERTICES_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstdint>

#include "halfspace/fast/front_end_task.hpp"
#include "halfspace/fast/vertex_chunk.hpp"
#include "halfspace/numerics/depth.hpp"

HWY_BEFORE_NAMESPACE();
namespace halfspace::fast::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// A vertex, or a triangle, a lane: 64-bit lanes, and vectors of as many 32-bit ones.
using Wide = hn::CappedTag<std::int64_t, 8>;
using Real = hn::Rebind<double, Wide>;
using Narrow = hn::Rebind<std::int32_t, Wide>;
using Single = hn::Rebind<float, Wide>;
using WideLanes = hn::Vec<Wide>;
using RealVector = hn::Vec<Real>;
using NarrowVector = hn::Vec<Narrow>;
inline constexpr std::size_t kTriangles = hn::MaxLanes(Wide());
inline constexpr unsigned kAllTriangles = (1u << kTriangles) - 1;

/// For conversions to whole numbers: lanes that are no number, of which the result is not used, become 0.
/// Highway's emulation of vectors would convert them as C++ does, which is undefined.
HWY_INLINE RealVector number_or_zero(RealVector v) { return hn::IfThenElseZero(hn::Eq(v, v), v); }

template <class D, class Mask>
HWY_INLINE unsigned lane_bits(D tag, Mask mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(tag, mask, bytes);
  return bytes[0];
}

/// FrontEnd (scene/front_end.hpp) for vertices that are inside all planes.
class VertexTransform {
 public:
  explicit VertexTransform(const FrontEndTask& task) : task_(task) {}

  /// `count` vertices from `in`, which must have as many as fill vectors, into `out` from `at` on. Returns
  /// whether one is strange.
  bool run(const glm::vec4* in, std::size_t count, std::size_t at, VertexChunk& out) const {
    const Single single;
    auto strange = hn::FirstN(Real(), 0);
    for (std::size_t i = 0; i < count; i += kTriangles) {
      hn::Vec<Single> x;
      hn::Vec<Single> y;
      hn::Vec<Single> z;
      hn::Vec<Single> w;
      hn::LoadInterleaved4(single, &in[i].x, x, y, z, w);
      strange = hn::Or(strange, hn::And(some(count - i), vertices(x, y, z, w, at + i, out)));
    }
    return lane_bits(Real(), strange) != 0;
  }

 private:
  static HWY_INLINE hn::Mask<Real> some(std::size_t count) {
    return hn::FirstN(Real(), std::min(count, kTriangles));
  }

  HWY_INLINE hn::Mask<Real> vertices(hn::Vec<Single> xs, hn::Vec<Single> ys, hn::Vec<Single> zs,
                                     hn::Vec<Single> ws, std::size_t at, VertexChunk& out) const {
    const Single single;
    const Real real;
    const Narrow narrow;
    const RealVector zero = hn::Zero(real);
    // no number where one is infinite or no number itself
    const auto nothing =
        hn::Add(hn::Add(hn::Sub(xs, xs), hn::Sub(ys, ys)), hn::Add(hn::Sub(zs, zs), hn::Sub(ws, ws)));
    const RealVector x = hn::PromoteTo(real, xs);
    const RealVector y = hn::PromoteTo(real, ys);
    const RealVector z = hn::PromoteTo(real, zs);
    const RealVector w = hn::PromoteTo(real, ws);
    // Not of Eq: what Ne says of no number differs between targets.
    const auto not_finite = hn::Not(hn::Eq(hn::PromoteTo(real, nothing), zero));
    auto odd = hn::Not(hn::Gt(w, zero));
    // As FrontEnd has the planes, in its order and with its rounding.
    hn::Mask<Real> outside[6];
    std::size_t planes = 0;
    if (task_.clips_depth) {
      outside[planes++] = hn::Lt(task_.symmetric ? hn::Add(z, w) : z, zero);
      outside[planes++] = hn::Lt(hn::Sub(w, z), zero);
    }
    beyond(task_.x_half, x, w, task_.x_centre, outside + planes);
    beyond(task_.y_half, y, w, task_.y_centre, outside + planes + 2);
    planes += 4;
    const bool is_window = hn::AllTrue(single, hn::Eq(ws, hn::Set(single, 1.0F)));
    const auto over_w = [&](RealVector v) HWY_ATTR { return is_window ? v : hn::Div(v, w); };
    hn::Store(snapped(over_w(x), task_.viewport_x, task_.viewport_width), narrow, out.x.data() + at);
    hn::Store(snapped(over_w(y), task_.viewport_y, task_.viewport_height), narrow, out.y.data() + at);
    if (task_.has_depth) {
      RealVector depth =
          hn::Add(hn::Mul(over_w(z), hn::Set(real, task_.z_scale)), hn::Set(real, task_.z_bias));
      if (task_.clips_depth) {
        depth = hn::Min(hn::Max(depth, hn::Set(real, task_.z_least)), hn::Set(real, task_.z_most));
      }
      odd = hn::Or(odd, hn::Or(hn::Lt(depth, zero), hn::Gt(depth, hn::Set(real, 1.0))));
      hn::Store(vertex_depth(depth), narrow, out.z.data() + at);
    }
    auto strange = hn::Or(odd, not_finite);
    for (std::size_t i = 0; i < planes; ++i) {
      strange = hn::Or(strange, outside[i]);
    }
    std::int32_t* const flags = out.strange.data() + at;
    hn::Store(hn::Zero(narrow), narrow, flags);
    if (HWY_UNLIKELY(!hn::AllFalse(real, strange))) {
      add_flag(VertexChunk::kNotFinite, not_finite, flags);
      add_flag(VertexChunk::kOdd, odd, flags);
      for (std::size_t i = 0; i < planes; ++i) {
        add_flag(1 << i, outside[i], flags);
      }
    }
    return strange;
  }

  static void add_flag(std::int32_t flag, hn::Mask<Real> lanes, std::int32_t* flags) {
    for (unsigned left = lane_bits(Real(), lanes); left != 0; left &= left - 1) {
      flags[std::countr_zero(left)] |= flag;
    }
  }

  /// As vertex_depth_code.
  HWY_INLINE NarrowVector vertex_depth(RealVector depth) const {
    if (task_.is_float) {
      const Single single;
      return hn::BitCast(Narrow(), hn::Add(hn::DemoteTo(single, depth), hn::Zero(single)));
    }
    return nearest(hn::Mul(depth, hn::Set(Real(), task_.depth_one)));
  }

  /// The nearest whole number, halves to even.
  static HWY_INLINE NarrowVector nearest(RealVector v) {
    return hn::DemoteTo(Narrow(), hn::Round(number_or_zero(v)));
  }

  /// Outside the two planes of the guard band.
  static HWY_INLINE void beyond(double half, RealVector at, RealVector w, double centre,
                                hn::Mask<Real>* outside) {
    const Real real;
    const RealVector zero = hn::Zero(real);
    const RealVector scaled = hn::Mul(hn::Set(real, half), at);
    const RealVector above = hn::Add(scaled, hn::Mul(hn::Set(real, FrontEndTask::kGuardBand + centre), w));
    const RealVector below = hn::Sub(hn::Mul(hn::Set(real, FrontEndTask::kGuardBand - centre), w), scaled);
    outside[0] = hn::Lt(above, zero);
    outside[1] = hn::Lt(below, zero);
  }

  /// Window coordinates on the grid of sub-pixels.
  HWY_INLINE NarrowVector snapped(RealVector ndc, double begin, double extent) const {
    const Real real;
    const RealVector band = hn::Set(real, FrontEndTask::kGuardBand);
    const RealVector scaled =
        hn::Mul(hn::Mul(hn::Add(ndc, hn::Set(real, 1.0)), hn::Set(real, extent)), hn::Set(real, 0.5));
    const RealVector window = hn::Min(hn::Max(hn::Add(hn::Set(real, begin), scaled), hn::Neg(band)), band);
    return nearest(hn::Mul(window, hn::Set(real, task_.sub_pixels)));
  }

  const FrontEndTask& task_;
};

struct IndexSpan {
  std::uint32_t lowest;
  std::uint32_t highest;
  bool in_order;  ///< each is one more than that before
};

inline IndexSpan index_span(const std::uint32_t* index, std::size_t count) {
  const hn::ScalableTag<std::uint32_t> tag;
  const std::size_t lanes = hn::Lanes(tag);
  auto lowest = hn::Set(tag, index[0]);
  auto highest = lowest;
  auto jumps = hn::Zero(tag);
  auto next = hn::Add(lowest, hn::Iota(tag, 0));
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) {
    const auto some = hn::LoadU(tag, index + i);
    lowest = hn::Min(lowest, some);
    highest = hn::Max(highest, some);
    jumps = hn::Or(jumps, hn::Xor(some, next));
    next = hn::Add(next, hn::Set(tag, static_cast<std::uint32_t>(lanes)));
  }
  IndexSpan span{.lowest = hn::GetLane(hn::MinOfLanes(tag, lowest)),
                 .highest = hn::GetLane(hn::MaxOfLanes(tag, highest)),
                 .in_order = hn::AllTrue(tag, hn::Eq(jumps, hn::Zero(tag)))};
  for (; i < count; ++i) {
    span.lowest = std::min(span.lowest, index[i]);
    span.highest = std::max(span.highest, index[i]);
    span.in_order &= index[i] == index[0] + i;
  }
  return span;
}

/// Fills `chunk` with the vertices of the triangles from `first` on, before `end`.
inline void make_chunk(const FrontEndTask& task, std::uint32_t first, std::uint32_t end, VertexChunk& chunk) {
  chunk.first = first;
  chunk.end = std::min(end, first + VertexChunk::kMostTriangles);
  const std::uint32_t* const index = task.indices + std::size_t{first} * 3;
  const std::size_t count = std::size_t{chunk.end - first} * 3;
  const IndexSpan span = index_span(index, count);
  const std::size_t range = std::size_t{span.highest} - span.lowest + 1;
  chunk.in_order = span.in_order || range > count;
  chunk.lowest = span.lowest;
  const VertexTransform transform(task);
  const std::size_t used = chunk.in_order ? count : range;
  const glm::vec4* from = task.vertices + span.lowest;
  if (!span.in_order && chunk.in_order) {
    for (std::size_t i = 0; i < count; ++i) {
      chunk.copied[i] = task.vertices[index[i]];
    }
    from = chunk.copied.data();
  }
  // The last vector reads past the last vertex: from a copy.
  const std::size_t full = used / kTriangles * kTriangles;
  chunk.some_strange = transform.run(from, full, 0, chunk);
  if (full != used) {
    std::array<glm::vec4, kTriangles> rest{};
    std::copy(from + full, from + used, rest.begin());
    chunk.some_strange |= transform.run(rest.data(), used - full, full, chunk);
  }
}

}  // namespace
}  // namespace halfspace::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
