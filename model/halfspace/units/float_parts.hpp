/// float32 taken apart and put together: depth is never negative here, so there are no signs.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace halfspace {

/// A non-negative float32 as an integer of at most 24 bits times 2^exponent.
struct FloatParts {
  std::uint32_t mantissa;
  int exponent;
};

constexpr FloatParts float_parts(std::uint32_t bits) {
  const int field = static_cast<int>(bits >> 23);
  const std::uint32_t fraction = bits & 0x7FFFFFu;
  return field == 0 ? FloatParts{fraction, -149} : FloatParts{fraction | 0x800000u, field - 150};
}

/// The bits of the float32 nearest to m * 2^exponent, halves upwards. The value is at most about 1.
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
  return static_cast<std::uint32_t>((static_cast<std::uint64_t>(place + 149) << 23) + rounded);
}

}  // namespace halfspace
