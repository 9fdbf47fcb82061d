#include "halfspace/units/depth_barycentric.hpp"

#include <array>
#include <bit>

#include "halfspace/units/float_parts.hpp"

namespace halfspace {
namespace {

/// A non-negative number m * 2^exponent whose m has its top bit at bit 31, or is 0. Lower bits are cut off.
struct Normalised {
  std::uint64_t m = 0;
  int exponent = 0;
};

Normalised normalise(std::uint64_t value, int exponent) {
  if (value == 0) {
    return {};
  }
  const int shift = 32 - std::bit_width(value);
  return {shift >= 0 ? value << shift : value >> -shift, exponent - shift};
}

}  // namespace

void set_reciprocal(DepthEquation& eq) {
  eq.shift = static_cast<std::int8_t>(std::bit_width(static_cast<std::uint64_t>(eq.area2)) - 32);
  constexpr std::uint64_t kOne = (std::uint64_t{1} << 63) - 1;
  const std::uint64_t scaled = scale_weight(eq, eq.area2);  // 2^31 to 2^32 - 1, since area2 > 0
  eq.reciprocal = static_cast<std::uint32_t>(kOne / std::max<std::uint64_t>(scaled, 1));
}

std::uint32_t barycentric_float(const DepthEquation& eq, std::int64_t e1, std::int64_t e2) {
  const std::array<std::int64_t, 3> e{eq.area2 - e1 - e2, e1, e2};
  std::array<std::uint64_t, 3> product{};
  std::array<bool, 3> negative{};
  std::array<int, 3> exponent{};
  int top = -1000;  // below every exponent that can occur
  for (std::size_t i = 0; i < 3; ++i) {
    const Normalised w = normalise(static_cast<std::uint64_t>(e[i]), 0);
    const FloatParts z = float_parts(static_cast<std::uint32_t>(eq.z[i]));
    product[i] = w.m * z.mantissa;
    negative[i] = z.negative;
    exponent[i] = w.exponent + z.exponent;
    if (product[i] != 0) {
      top = std::max(top, exponent[i]);
    }
  }
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const int shift = top - exponent[i];
    const auto term = static_cast<std::int64_t>(product[i] != 0 && shift < 64 ? product[i] >> shift : 0);
    sum += negative[i] ? -term : term;
  }
  // sum * 2^top / 2A, where 1 / 2A is reciprocal * 2^-63 * 2^-shift
  const Normalised s = normalise(static_cast<std::uint64_t>(sum < 0 ? -sum : sum), top);
  const std::uint64_t depth = s.m * eq.reciprocal;
  const int place = s.exponent - 63 - eq.shift;
  if (eq.offset == 0) {
    return sum < 0 ? 0u - float_bits(depth, place) : float_bits(depth, place);
  }
  const int cut = eq.exponent - kLongWordFraction - place;  // to a word; not negative, as depth < 2^exponent
  const auto word = static_cast<std::int64_t>(depth != 0 && cut < 64 ? depth >> cut : 0);  // 0 has no place
  return code_of_word(Int128{sum < 0 ? -word : word} + eq.offset, eq.exponent);
}

}  // namespace halfspace
