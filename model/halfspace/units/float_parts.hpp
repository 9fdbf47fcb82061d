/// float32 taken apart and put together, and float32 as fixed-point words.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "halfspace/numerics/depth.hpp"

namespace halfspace {

/// A float32 as an integer of at most 24 bits times 2^exponent, and its sign.
struct FloatParts {
  std::uint32_t mantissa;
  int exponent;
  bool negative;
};

constexpr FloatParts float_parts(std::uint32_t bits) {
  const int field = static_cast<int>(bits >> 23 & 0xFF);
  const std::uint32_t fraction = bits & 0x7FFFFFu;
  const bool negative = bits >> 31 != 0;
  return field == 0 ? FloatParts{fraction, -149, negative}
                    : FloatParts{fraction | 0x800000u, field - 150, negative};
}

/// The bits of the float32 nearest to m * 2^exponent, halves upwards; 0x7FFFFFFF at most, which is above all
/// numbers.
constexpr std::uint32_t float_bits(std::uint64_t m, int exponent) {
  if (m == 0) {
    return 0;
  }
  const int width = std::bit_width(m);
  // cut to 24 bits, or to fewer where the float is subnormal: its last place is never below 2^-149
  const int cut = std::max(width - 24, -149 - exponent);
  if (cut > width) {
    return 0;
  }
  // one bit more than is kept, plus one, halved: m may fill all 64 bits, so nothing can be added to it
  const std::uint64_t rounded = cut <= 0 ? m << -cut : ((m >> (cut - 1)) + 1) >> 1;
  const int place = exponent + cut;
  // Adding the mantissa with its hidden bit to a field that is one too low carries correctly, also after
  // rounding up to the next power of two and for subnormals, whose hidden bit is absent.
  const std::uint64_t bits = (static_cast<std::uint64_t>(place + 149) << 23) + rounded;
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(bits, 0x7FFFFFFF));
}

/// Bits of a word behind its binary point.
inline constexpr int kLongWordFraction = 63;

/// A float32 below 2^exponent in units of 2^(exponent - 63), cut towards zero.
constexpr std::int64_t word_of_float(std::uint32_t bits, int exponent) {
  const FloatParts z = float_parts(bits);
  const int left = z.exponent + kLongWordFraction - exponent;
  const std::int64_t magnitude = left >= 0    ? std::int64_t{z.mantissa} << left
                                 : left > -24 ? z.mantissa >> -left
                                              : 0;
  return z.negative ? -magnitude : magnitude;
}

__extension__ using Int128 = __int128;

/// The code of the float32 nearest to such a word, or to the sum of two, halves away from zero.
constexpr std::uint32_t code_of_word(Int128 word, int exponent) {
  const std::uint32_t magnitude =
      float_bits(static_cast<std::uint64_t>(word < 0 ? -word : word), exponent - kLongWordFraction);
  return word < 0 ? 0u - magnitude : magnitude;
}

}  // namespace halfspace
