#include "halfspace/units/interpolator.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <limits>

namespace halfspace {
namespace {

constexpr int kFloatMantissa = 24;
constexpr int kGuardBits = 3;  // of a product, below as many as a mantissa has

/// E q without its sign: m 2^exponent.
struct Product {
  std::uint64_t m = 0;
  int exponent = 0;
  bool negative = false;
};

Product product_of(std::int64_t e, std::uint32_t q, int bits) {
  const auto magnitude = static_cast<std::uint64_t>(e < 0 ? -e : e);
  const int shift = std::bit_width(magnitude) - bits;
  const std::uint64_t edge = shift >= 0 ? magnitude >> shift : magnitude << -shift;
  const std::uint64_t one_over_w = ((q & 0x7FFFFF) | 0x800000) >> (kFloatMantissa - bits);
  return {.m = edge * one_over_w >> (bits - kGuardBits),
          .exponent = shift + static_cast<int>(q >> 23 & 0xFF),
          .negative = e < 0};
}

/// On the scale of the product with the largest exponent.
std::int64_t aligned(const Product& product, int top) {
  const int shift = top - product.exponent;
  const auto term = static_cast<std::int64_t>(product.m != 0 && shift < 64 ? product.m >> shift : 0);
  return product.negative ? -term : term;
}

}  // namespace

VertexWeights perspective_weights(const std::array<std::int64_t, 3>& e, const std::array<std::uint32_t, 3>& q,
                                  int bits) {
  std::array<Product, 3> product;
  int top = std::numeric_limits<int>::min();
  for (std::size_t i = 0; i < 3; ++i) {
    product[i] = product_of(e[i], q[i], bits);
    top = product[i].m != 0 ? std::max(top, product[i].exponent) : top;
  }
  const std::int64_t term1 = aligned(product[1], top);
  const std::int64_t term2 = aligned(product[2], top);
  const std::int64_t sum = aligned(product[0], top) + term1 + term2;
  if (sum <= 0) {
    return {};
  }
  const int divisor_bits = bits + kGuardBits + 1;
  const auto positive = static_cast<std::uint64_t>(sum);
  const int shift = std::bit_width(positive) - divisor_bits;
  const std::uint64_t divisor = shift >= 0 ? positive >> shift : positive << -shift;
  const std::uint64_t reciprocal = ((std::uint64_t{1} << (2 * divisor_bits - 1)) - 1) / divisor;
  const int cut = 2 * divisor_bits - 1 + shift - bits;
  const auto weight = [&](std::int64_t term) {
    const std::uint64_t value = static_cast<std::uint64_t>(term < 0 ? -term : term) * reciprocal >> cut;
    const auto kept =
        static_cast<std::int64_t>(std::min(value, (std::uint64_t{1} << (bits + kWeightWhole)) - 1));
    return term < 0 ? -kept : kept;
  };
  return {.w1 = weight(term1), .w2 = weight(term2)};
}

std::int32_t interpolate(const std::array<std::int32_t, 3>& v, const VertexWeights& weights, bool covered,
                         int bits) {
  const std::int64_t rise1 = std::int64_t{v[1]} - v[0];
  const std::int64_t rise2 = std::int64_t{v[2]} - v[0];
  const std::int64_t half = std::int64_t{1} << (bits - 1);
  const std::int64_t value =
      ((std::int64_t{v[0]} << bits) + weights.w1 * rise1 + weights.w2 * rise2 + half) >> bits;
  const auto [least, most] =
      covered ? std::minmax({v[0], v[1], v[2]})
              : std::pair(std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::max());
  return static_cast<std::int32_t>(std::clamp<std::int64_t>(value, least, most));
}

ShadedQuad interpolator(const AttributeQuad& quad, int sub_pixel_bits, int bits) {
  ShadedQuad shaded{.value = {}, .mask = quad.mask};
  for (std::size_t pixel = 0; pixel < 4; ++pixel) {
    const auto x = static_cast<std::int64_t>(pixel % 2);
    const auto y = static_cast<std::int64_t>(pixel / 2);
    std::array<std::int64_t, 3> e{quad.area2, 0, 0};
    for (std::size_t i = 0; i < 2; ++i) {
      e[i + 1] = quad.e[i] + ((x * quad.a[i] + y * quad.b[i]) << sub_pixel_bits);
      e[0] -= e[i + 1];
    }
    const VertexWeights weights = perspective_weights(e, quad.q, bits);
    const bool covered = (quad.mask >> pixel & 1) != 0;
    for (std::size_t c = 0; c < kComponents; ++c) {
      const std::array<std::int32_t, 3> v{quad.value[c], quad.value[kComponents + c],
                                          quad.value[2 * kComponents + c]};
      shaded.value[kComponents * pixel + c] = interpolate(v, weights, covered, bits);
    }
  }
  return shaded;
}

}  // namespace halfspace
