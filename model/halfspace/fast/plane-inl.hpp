// Without a guard that stops a second inclusion: once for each target of Highway.
#if defined(HALFSPACE_FAST_PLANE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HALFSPACE_FAST_PLANE_INL
#undef HALFSPACE_FAST_PLANE_INL
#else
#define HALFSPACE_FAST_PLANE_INL
#endif

#include <hwy/highway.h>

#include <array>
#include <bit>
#include <cstdint>

#include "halfspace/fast/lanes-inl.hpp"
#include "halfspace/fast/set_up.hpp"
#include "halfspace/fast/surface_tiles.hpp"
#include "halfspace/numerics/depth.hpp"
#include "halfspace/units/depth_plane.hpp"
#include "halfspace/units/float_parts.hpp"

HWY_BEFORE_NAMESPACE();
namespace halfspace::fast::HWY_NAMESPACE {
namespace {

/// What turns the plane of a triangle into the words of a tile: tile_plane (units/depth_plane.hpp), with the
/// part that is the same for all tiles done once. `Product` holds a word and a gradient's bits below it.
template <class Word, class Product>
struct PlaneWords {
  static constexpr Product kHalf = Product{1} << (kGradientFraction - 1);

  PlaneWords() = default;
  PlaneWords(const Plane& plane, Product gradient_x, Product gradient_y, int sub_pixel_bits) {
    const Product half_pixel = Product{1} << (sub_pixel_bits - 1);
    const auto from_vertex = [&](std::int32_t v) {
      return half_pixel - static_cast<Product>(std::int64_t{v});
    };
    base = (static_cast<Product>(plane.z) << kGradientFraction) + gradient_x * from_vertex(plane.x) +
           gradient_y * from_vertex(plane.y) + kHalf;
    dx = gradient_x << sub_pixel_bits;
    dy = gradient_y << sub_pixel_bits;
    step_x = static_cast<Word>((dx + kHalf) >> kGradientFraction);
    step_y = static_cast<Word>((dy + kHalf) >> kGradientFraction);
    add = static_cast<Word>(plane.add);
  }

  /// At pixel (x, y), the first of a tile, what is added included.
  [[nodiscard]] HWY_INLINE Word at(std::uint32_t x, std::uint32_t y) const {
    constexpr std::uint32_t kInSquare = kAnchorSize - 1;
    const Product anchor = base + dx * (x & ~kInSquare) + dy * (y & ~kInSquare);
    return static_cast<Word>(anchor >> kGradientFraction) + (x & kInSquare) * step_x +
           (y & kInSquare) * step_y + add;
  }

  Product base = 0;
  Product dx = 0;  ///< for a pixel
  Product dy = 0;
  Word step_x = 0;
  Word step_y = 0;
  Word add = 0;
};

using ShortWords = PlaneWords<ShortWord, std::uint64_t>;
using LongWords = PlaneWords<LongWord, Modular>;

/// A gradient of 128 bits.
inline Modular wide(std::int64_t high, std::uint64_t low) { return static_cast<Modular>(high) << 64 | low; }

inline LongWords long_words(const Plane& plane, int sub_pixel_bits) {
  return {plane, wide(plane.dx_high, plane.dx), wide(plane.dy_high, plane.dy), sub_pixel_bits};
}

/// From a tile's first sample to each of them.
template <int TileSize>
void long_steps(const LongWords& words, std::uint64_t* steps) {
  LongWord row = 0;
  for (int y = 0; y < TileSize; ++y, row += words.step_y) {
    LongWord at = row;
    for (int x = 0; x < TileSize; ++x, at += words.step_x) {
      steps[y * TileSize + x] = at;
    }
  }
}

/// Calls visit(i, v) for the samples i to i + kWidth - 1 of a tile, v = origin + x * step_x + y * step_y.
template <int TileSize, class Visit>
HWY_INLINE void for_samples(Vector origin, std::uint32_t step_x, std::uint32_t step_y, Visit&& visit) {
  constexpr int kSamples = TileSize * TileSize;
  if constexpr (kWidth >= TileSize) {
    const Vector down = set(step_y * (kWidth / TileSize));
    for (int i = 0; i < kSamples; i += kWidth) {
      visit(i, origin);
      origin = hn::Add(origin, down);
    }
  } else {
    const Vector right = set(step_x * kWidth);
    const Vector down = set(step_y - step_x * TileSize);
    for (int i = 0; i < kSamples; i += kWidth) {
      visit(i, origin);
      origin = hn::Add(origin, right);
      if ((i + kWidth) % TileSize == 0) {
        origin = hn::Add(origin, down);
      }
    }
  }
}

/// x * step_x + y * step_y of the first kWidth samples of a tile.
template <int TileSize>
HWY_INLINE Vector first_samples(std::uint32_t step_x, std::uint32_t step_y) {
  const Vector lane = hn::Iota(Tag(), 0);
  const Vector x = hn::And(lane, set(TileSize - 1));
  const Vector y = hn::ShiftRightSame(lane, std::countr_zero(static_cast<unsigned>(TileSize)));
  return hn::Add(hn::Mul(x, set(step_x)), hn::Mul(y, set(step_y)));
}

using WideTag = hn::Repartition<std::int64_t, Tag>;
using WideVector = hn::Vec<WideTag>;
inline constexpr int kWideWidth = static_cast<int>(hn::MaxLanes(WideTag()));

/// Products of small numbers.
HWY_INLINE WideVector times(WideVector l, WideVector r) {
#if HWY_TARGET == HWY_SCALAR
  return hn::Mul(l, r);
#else
  return hn::MulEven(hn::BitCast(Tag(), l), hn::BitCast(Tag(), r));
#endif
}

HWY_INLINE std::uint32_t wide_negative(WideVector v) {
  const auto mask = hn::Lt(v, hn::Zero(WideTag()));
#if HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86
  return mask.raw;
#else
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(WideTag(), mask, bytes);
  return bytes[0];
#endif
}

/// The float32 nearest to words, halves upwards, as bits in 64-bit lanes: code_of_word, of sums that are not
/// negative (units/float_parts.hpp). `rebias`: see float_rebias.
HWY_INLINE WideVector float_codes(WideVector word, WideVector rebias) {
  const WideTag tag;
  // A double is exact: of 54 and more bits those that a float32 cannot see go.
  const auto large = hn::Gt(word, hn::Set(tag, (std::int64_t{1} << 53) - 1));
  const WideVector seen = hn::AndNot(hn::IfThenElseZero(large, hn::Set(tag, std::int64_t{0x7FF})), word);
  const WideVector bits = hn::BitCast(tag, hn::ConvertTo(hn::RebindToFloat<WideTag>(), seen));
  constexpr int kCut = 52 - 23;
  const WideVector rounded = hn::Add(bits, hn::Add(rebias, hn::Set(tag, std::int64_t{1} << (kCut - 1))));
  return hn::IfThenElseZero(hn::Gt(word, hn::Zero(tag)), hn::ShiftRight<kCut>(rounded));
}

/// What makes the exponent field of a double that of the float 2^(exponent - 63) times as large.
constexpr std::int64_t float_rebias(int exponent) {
  constexpr int kDoubleBias = 1023;
  constexpr int kFloatBias = 127;
  return std::int64_t{kFloatBias - kDoubleBias + exponent - kLongWordFraction} * (std::int64_t{1} << 52);
}

/// 64-bit lanes that fit 32 bits.
HWY_INLINE Vector narrow(WideVector low, WideVector high) {
#if HWY_TARGET == HWY_SCALAR
  (void)high;
  return hn::Set(Tag(), static_cast<std::int32_t>(hn::GetLane(low)));
#else
  const Tag tag;
  return hn::ConcatEven(tag, hn::BitCast(tag, high), hn::BitCast(tag, low));
#endif
}

}  // namespace
}  // namespace halfspace::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
