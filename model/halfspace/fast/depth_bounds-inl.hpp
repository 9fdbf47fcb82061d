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

/// The range of a triangle's codes in the tiles of a group, or in blocks.
struct CodeRange {
  alignas(64) std::int32_t low[kLanes];
  alignas(64) std::int32_t high[kLanes];
};

/// Tiles, a bit each, all of whose samples die, or pass, whatever they are.
struct Outcome {
  std::uint32_t killed = 0;
  std::uint32_t passed = 0;
};

/// Depths as codes of a triangle.
HWY_INLINE Vector codes_of(hn::Vec<FloatTag> depth, bool is_float, const Triangle& t) {
  const Tag tag;
  const FloatTag real;
  // Bits of floats that are not negative are codes; a conversion to integers needs numbers that they hold.
  constexpr float kLargest = 0x1p30F;
  const auto above = hn::Max(depth, hn::Zero(real));
  const Vector codes =
      is_float ? hn::BitCast(tag, above) : hn::ConvertTo(tag, hn::Min(above, hn::Set(real, kLargest)));
  return hn::Min(hn::Max(codes, set(t.plane.low)), set(t.plane.high));
}

/// `x` and `y`: pixel of the group's first sample. The triangle has depth.
HWY_INLINE void code_range(const Triangle& t, int x, int y, bool is_float, CodeRange& out) {
  const Tag tag;
  const FloatTag real;
  if (t.kind != DepthKind::kShort && t.kind != DepthKind::kLong) {
    for (int i = 0; i < kLanes; i += kWidth) {
      hn::Store(set(t.plane.low), tag, out.low + i);
      hn::Store(set(t.plane.high), tag, out.high + i);
    }
    return;
  }
  const auto first = static_cast<float>(t.depth_at(x, y));
  const auto least = hn::Set(real, first + t.tile_least);
  const auto most = hn::Set(real, first + t.tile_most);
  for (int i = 0; i < kLanes; i += kWidth) {
    const auto tiles = hn::Load(real, t.tile_depth + i);
    hn::Store(codes_of(hn::Add(tiles, least), is_float, t), tag, out.low + i);
    hn::Store(codes_of(hn::Add(tiles, most), is_float, t), tag, out.high + i);
  }
}

/// The same in up to kWidth blocks, every `stride` pixels, the first at pixel (x, y).
HWY_INLINE void block_code_range(const Triangle& t, int x, int y, int stride, bool is_float, CodeRange& out) {
  const Tag tag;
  const FloatTag real;
  if (t.kind != DepthKind::kShort && t.kind != DepthKind::kLong) {
    hn::Store(set(t.plane.low), tag, out.low);
    hn::Store(set(t.plane.high), tag, out.high);
    return;
  }
  const auto first = static_cast<float>(t.depth_at(x, y));
  const auto step = hn::Set(real, static_cast<float>(t.gradient_x * stride));
  const auto blocks = hn::Mul(hn::ConvertTo(real, hn::Iota(tag, 0)), step);
  hn::Store(codes_of(hn::Add(blocks, hn::Set(real, first + t.block_least)), is_float, t), tag, out.low);
  hn::Store(codes_of(hn::Add(blocks, hn::Set(real, first + t.block_most)), is_float, t), tag, out.high);
}

/// kWidth tiles or blocks, given the bounds of their codes.
HWY_INLINE Outcome outcome(DepthFunc func, Vector low, Vector high, const std::int32_t* least,
                           const std::int32_t* most) {
  const Tag tag;
  const Vector z_min = hn::LoadU(tag, least);
  const Vector z_max = hn::LoadU(tag, most);
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
    const std::size_t first = at + static_cast<std::size_t>(i);
    const Outcome some = outcome(func, hn::Load(Tag(), range.low + i), hn::Load(Tag(), range.high + i),
                                 tiles.z_min.get() + first, tiles.z_max.get() + first);
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
