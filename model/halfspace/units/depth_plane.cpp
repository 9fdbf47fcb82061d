#include "halfspace/units/depth_plane.hpp"

#include <tuple>

namespace halfspace {
namespace {

__extension__ using Int128 = __int128;

/// numerator * 2^kGradientFraction / area2, cut towards zero.
Modular gradient(Int128 numerator, std::int64_t area2) {
  return static_cast<Modular>(numerator * (Int128{1} << kGradientFraction) / area2);
}

/// The same of a numerator of at most 63 bits. Most quotients are small: a double is near them, and the
/// remainder, which wraps around as unsigned numbers do, says how near.
Modular gradient(std::int64_t numerator, std::int64_t area2) {
  const auto magnitude = static_cast<std::uint64_t>(numerator < 0 ? -numerator : numerator);
  const double estimate =
      static_cast<double>(magnitude) * (1 << kGradientFraction) / static_cast<double>(area2);
  if (estimate > 0x1p50) {  // may be off by more than 1
    return gradient(Int128{numerator}, area2);
  }
  auto quotient = static_cast<std::int64_t>(estimate);
  const std::uint64_t product = static_cast<std::uint64_t>(quotient) * static_cast<std::uint64_t>(area2);
  const auto rest = static_cast<std::int64_t>((magnitude << kGradientFraction) - product);
  quotient += rest < 0 ? -1 : rest >= area2 ? 1 : 0;
  return static_cast<Modular>(Int128{numerator < 0 ? -quotient : quotient});
}

/// A float32 as a word where 1 is 2^exponent; lower bits are cut off.
std::int64_t word_of_float(std::uint32_t bits, int exponent) {
  const FloatParts z = float_parts(bits);
  const int left = z.exponent + 63 - exponent;
  return left >= 0 ? std::int64_t{z.mantissa} << left : left > -24 ? z.mantissa >> -left : 0;
}

template <class Sum>
void set_plane(const std::array<std::int64_t, 3>& z, const std::array<Edge, 3>& edge, std::int64_t area2,
               PlaneEquation& out) {
  // z = z0 + ((z1 - z0) E1 + (z2 - z0) E2) / 2A, and a and b are the changes of E
  const auto dz1 = static_cast<Sum>(z[1] - z[0]);
  const auto dz2 = static_cast<Sum>(z[2] - z[0]);
  out.dx = gradient(dz1 * edge[1].a + dz2 * edge[2].a, area2);
  out.dy = gradient(dz1 * edge[1].b + dz2 * edge[2].b, area2);
  out.z = z[0];
  std::tie(out.low, out.high) = std::minmax({z[0], z[1], z[2]});
}

}  // namespace

PlaneEquation plane_equation(const std::array<ScreenVertex, 3>& v, const std::array<Edge, 3>& edge,
                             std::int64_t area2, DepthFormat format) {
  PlaneEquation plane{.x = v[0].x, .y = v[0].y};
  if (format != DepthFormat::kFloat32) {
    set_plane<std::int64_t>({v[0].z, v[1].z, v[2].z}, edge, area2, plane);
    return plane;
  }
  // The power of two above the largest: that of its exponent field, subnormal numbers as if it were 1.
  const std::uint32_t field = std::max(std::max({v[0].z, v[1].z, v[2].z}) >> 23, 1u);
  plane.exponent = static_cast<std::int16_t>(static_cast<int>(field) - 126);
  const auto word = [&](const ScreenVertex& vertex) { return word_of_float(vertex.z, plane.exponent); };
  set_plane<Int128>({word(v[0]), word(v[1]), word(v[2])}, edge, area2, plane);
  if (float_of_word(static_cast<std::uint64_t>(plane.low), plane) < std::min({v[0].z, v[1].z, v[2].z})) {
    ++plane.low;  // the word of the nearest vertex was cut
  }
  return plane;
}

}  // namespace halfspace
