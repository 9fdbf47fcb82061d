// Without a guard that stops a second inclusion: once for each target of Highway.
#if defined(HALFSPACE_FAST_DEPTH_BOUNDS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HALFSPACE_FAST_DEPTH_BOUNDS_INL
#undef HALFSPACE_FAST_DEPTH_BOUNDS_INL
#else
#define HALFSPACE_FAST_DEPTH_BOUNDS_INL
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#include "halfspace/fast/raster.hpp"
#include "halfspace/fast/triangle-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace halfspace::fast::HWY_NAMESPACE {
namespace {

/// The range of a triangle's codes in the tiles of a group.
struct CodeRange {
  alignas(64) std::int32_t low[kLanes];
  alignas(64) std::int32_t high[kLanes];
};

/// Tiles, a bit each, all of whose samples die, or pass, whatever they are.
struct Outcome {
  std::uint32_t killed = 0;
  std::uint32_t passed = 0;
};

/// `x` and `y`: pixel of the group's first sample. The triangle has depth.
HWY_INLINE void code_range(const Triangle& t, int x, int y, bool is_float, CodeRange& out) {
  const Tag tag;
  const FloatTag real;
  const Vector low_end = set(t.plane.low);
  const Vector high_end = set(t.plane.high);
  if (t.kind != DepthKind::kShort && t.kind != DepthKind::kLong) {
    for (int i = 0; i < kLanes; i += kWidth) {
      hn::Store(low_end, tag, out.low + i);
      hn::Store(high_end, tag, out.high + i);
    }
    return;
  }
  const auto first = static_cast<float>(t.depth_origin + t.gradient_x * x + t.gradient_y * y);
  const auto least = hn::Set(real, first + t.tile_least);
  const auto most = hn::Set(real, first + t.tile_most);
  const auto codes = [&](hn::Vec<FloatTag> depth) HWY_ATTR {
    // Bits of floats that are not negative are codes; a conversion to integers needs numbers that they hold.
    constexpr float kLargest = 0x1p30F;
    const auto above = hn::Max(depth, hn::Zero(real));
    return is_float ? hn::BitCast(tag, above) : hn::ConvertTo(tag, hn::Min(above, hn::Set(real, kLargest)));
  };
  for (int i = 0; i < kLanes; i += kWidth) {
    const auto tiles = hn::Load(real, t.tile_depth + i);
    hn::Store(hn::Min(hn::Max(codes(hn::Add(tiles, least)), low_end), high_end), tag, out.low + i);
    hn::Store(hn::Min(hn::Max(codes(hn::Add(tiles, most)), low_end), high_end), tag, out.high + i);
  }
}

/// kWidth tiles, the first of which is `at`.
HWY_INLINE Outcome outcome(DepthFunc func, Vector low, Vector high, const SurfaceTiles& tiles,
                           std::size_t at) {
  const Tag tag;
  const Vector z_min = hn::LoadU(tag, tiles.z_min.get() + at);
  const Vector z_max = hn::LoadU(tag, tiles.z_max.get() + at);
  constexpr std::uint32_t kAllLanes = (1u << kWidth) - 1;
  switch (func) {
    case DepthFunc::kNever:
      return {.killed = kAllLanes, .passed = 0};
    case DepthFunc::kLess:
      return {.killed = bits_of(at_most(z_max, low)), .passed = bits_of(hn::Lt(high, z_min))};
    case DepthFunc::kLequal:
      return {.killed = bits_of(hn::Gt(low, z_max)), .passed = bits_of(at_most(high, z_min))};
    case DepthFunc::kGreater:
      return {.killed = bits_of(at_most(high, z_min)), .passed = bits_of(hn::Gt(low, z_max))};
    case DepthFunc::kGequal:
      return {.killed = bits_of(hn::Lt(high, z_min)), .passed = bits_of(at_most(z_max, low))};
    case DepthFunc::kEqual:
      return {.killed = bits_of(hn::Or(hn::Lt(high, z_min), hn::Gt(low, z_max))), .passed = 0};
    case DepthFunc::kNotEqual:
      return {.killed = 0, .passed = bits_of(hn::Or(hn::Lt(high, z_min), hn::Gt(low, z_max)))};
    case DepthFunc::kAlways:
      return {.killed = 0, .passed = kAllLanes};
  }
  return {};
}

/// A group of tiles.
HWY_INLINE Outcome outcome(DepthFunc func, const CodeRange& range, const SurfaceTiles& tiles,
                           std::size_t at) {
  Outcome all;
  for (int i = 0; i < kLanes; i += kWidth) {
    const Outcome some = outcome(func, hn::Load(Tag(), range.low + i), hn::Load(Tag(), range.high + i), tiles,
                                 at + static_cast<std::size_t>(i));
    all.killed |= some.killed << i;
    all.passed |= some.passed << i;
  }
  return all;
}

/// Tests that can only become harder to pass, and whose killed tiles stay killed, while a draw goes on.
constexpr bool is_ordered(DepthFunc func) {
  return func == DepthFunc::kLess || func == DepthFunc::kLequal || func == DepthFunc::kGreater ||
         func == DepthFunc::kGequal;
}

}  // namespace
}  // namespace halfspace::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
