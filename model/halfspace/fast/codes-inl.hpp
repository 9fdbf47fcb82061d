// Without a guard that stops a second inclusion: once for each target of Highway.
#if defined(HALFSPACE_FAST_CODES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HALFSPACE_FAST_CODES_INL
#undef HALFSPACE_FAST_CODES_INL
#else
#define HALFSPACE_FAST_CODES_INL
#endif

#include <hwy/highway.h>

#include <array>
#include <cstdint>

#include "halfspace/fast/plane-inl.hpp"
#include "halfspace/fast/raster.hpp"
#include "halfspace/fast/triangle-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace halfspace::fast::HWY_NAMESPACE {
namespace {

/// Calls visit(i, codes) for samples i to i + kWidth - 1 of a tile of a triangle that is flat, short or long.
template <int TileSize, class Visit>
HWY_INLINE void for_codes(const Triangle& t, int tile_x, int tile_y, int fraction, Visit&& visit) {
  constexpr int kSamples = TileSize * TileSize;
  const auto x = static_cast<std::uint32_t>(tile_x * TileSize);
  const auto y = static_cast<std::uint32_t>(tile_y * TileSize);
  const Vector low = set(t.plane.low);
  const Vector high = set(t.plane.high);
  if (t.kind == DepthKind::kShort) {
    const Vector first = hn::Add(set(t.short_words.at(x, y)), hn::Load(Tag(), t.depth_steps));
    for_samples<TileSize>(first, t.short_words.step_x, t.short_words.step_y,
                          [&](int i, Vector word) HWY_ATTR {
                            visit(i, hn::Min(hn::Max(hn::ShiftRightSame(word, fraction), low), high));
                          });
  } else if (t.kind == DepthKind::kFlat) {
    for (int i = 0; i < kSamples; i += kWidth) {
      visit(i, low);
    }
  } else {
    const WideTag wide;
    const WideVector origin = hn::Set(wide, static_cast<std::int64_t>(t.long_words.at(x, y)));
    const WideVector rebias = hn::Set(wide, t.rebias);
    const auto* const steps = reinterpret_cast<const std::int64_t*>(t.long_steps);
    for (int i = 0; i < kSamples; i += kWidth) {
      const auto codes = [&](int from) HWY_ATTR {
        return float_codes(hn::Add(origin, hn::LoadU(wide, steps + from)), rebias);
      };
      visit(i, hn::Min(hn::Max(narrow(codes(i), codes(kWidth > 1 ? i + kWideWidth : i)), low), high));
    }
  }
}

/// Makes the codes of a tile that is `plane`.
template <int TileSize>
HWY_NOINLINE void make_codes(const Plane& plane, const SurfaceTiles& tiles, DepthFormat format,
                             int sub_pixel_bits, int tile_x, int tile_y, std::uint32_t* codes) {
  if (plane.kind == DepthKind::kUnits) {
    codes_by_units<TileSize>(tiles.equation_of(plane), format, sub_pixel_bits, tile_x, tile_y, codes);
    return;
  }
  Triangle t;
  t.kind = plane.kind;
  t.plane = plane;
  if (plane.kind == DepthKind::kShort) {
    t.short_words = ShortWords(plane, plane.dx, plane.dy, sub_pixel_bits);
    hn::Store(first_samples<TileSize>(t.short_words.step_x, t.short_words.step_y), Tag(), t.depth_steps);
  } else if (plane.kind == DepthKind::kLong) {
    t.long_words = long_words(plane, sub_pixel_bits);
    long_steps<TileSize>(t.long_words, t.long_steps);
    t.rebias = float_rebias(plane.exponent);
  }
  for_codes<TileSize>(t, tile_x, tile_y, vertex_depth_fraction(format), [&](int i, Vector code) HWY_ATTR {
    hn::StoreU(code, Tag(), reinterpret_cast<std::int32_t*>(codes) + i);
  });
}

/// Samples that pass the test.
HWY_INLINE hn::Mask<Tag> compare(DepthFunc func, Vector code, Vector stored) {
  switch (func) {
    case DepthFunc::kLess:
      return hn::Lt(code, stored);
    case DepthFunc::kLequal:
      return at_most(code, stored);
    case DepthFunc::kGreater:
      return hn::Gt(code, stored);
    case DepthFunc::kGequal:
      return at_most(stored, code);
    case DepthFunc::kEqual:
      return hn::Eq(code, stored);
    case DepthFunc::kNotEqual:
      return hn::Ne(code, stored);
    default:
      return hn::FirstN(Tag(), kWidth);
  }
}

}  // namespace
}  // namespace halfspace::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
