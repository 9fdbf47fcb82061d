// Without a guard that stops a second inclusion: once for each target of Highway.
#if defined(HALFSPACE_FAST_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HALFSPACE_FAST_LANES_INL
#undef HALFSPACE_FAST_LANES_INL
#else
#define HALFSPACE_FAST_LANES_INL
#endif

#include <hwy/highway.h>

#include <cstdint>
#include <cstring>

#include "halfspace/fast/block_cache.hpp"

/// For lambdas in the innermost loops, which GCC calls where a function is used in more than one place.
#undef HALFSPACE_INLINED
#define HALFSPACE_INLINED __attribute__((always_inline))

HWY_BEFORE_NAMESPACE();
namespace halfspace::fast::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Vectors of 32-bit integers: a group of kLanes tiles, or the samples of a tile, take one or several.
using Tag = hn::CappedTag<std::int32_t, kLanes>;
using Vector = hn::Vec<Tag>;
using FloatTag = hn::RebindToFloat<Tag>;
inline constexpr int kWidth = static_cast<int>(hn::MaxLanes(Tag()));

HWY_INLINE Vector set(std::int32_t value) { return hn::Set(Tag(), value); }
HWY_INLINE Vector set(std::uint32_t value) { return hn::Set(Tag(), static_cast<std::int32_t>(value)); }

template <class Mask>
HWY_INLINE std::uint32_t bits_of(Mask mask) {
#if HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86
  return mask.raw;
#else
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(Tag(), mask, bytes);
  std::uint32_t bits = 0;
  std::memcpy(&bits, bytes, sizeof(bits));
  return bits;
#endif
}

/// The lowest bits, a lane each.
HWY_INLINE hn::Mask<Tag> mask_of(std::uint64_t bits) {
  return hn::LoadMaskBits(Tag(), reinterpret_cast<const std::uint8_t*>(&bits));
}

HWY_INLINE hn::Mask<Tag> at_most(Vector left, Vector right) { return hn::Not(hn::Gt(left, right)); }

/// Lanes whose sign bit is set.
HWY_INLINE std::uint32_t negative(Vector v) { return bits_of(hn::Lt(v, hn::Zero(Tag()))); }

/// Bits of a whole group, from those of its vectors.
template <class Part>
HWY_INLINE std::uint32_t group_bits(Part&& part) {
  std::uint32_t bits = 0;
  for (int i = 0; i < kLanes; i += kWidth) {
    bits |= part(i) << i;
  }
  return bits;
}

}  // namespace
}  // namespace halfspace::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
