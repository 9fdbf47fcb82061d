// interpolator against exact rational arithmetic.
#include "halfspace/units/interpolator.hpp"

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <bit>
#include <catch2/catch.hpp>
#include <cstdint>

#include "halfspace/units/packing.hpp"
#include "random.hpp"

using namespace halfspace;
using halfspace::testing::Random;
using halfspace::testing::samples;
using halfspace::testing::seed;

namespace {

using Three = std::array<std::int64_t, 3>;
using Floats = std::array<std::uint32_t, 3>;
using Values = std::array<std::int32_t, 3>;

constexpr std::uint32_t kFloatOne = 0x3F800000;

/// A number of any magnitude up to 2^bits - 1.
std::int64_t any_size(Random& random, int bits) {
  return random.between(0, (std::int64_t{1} << random.between(0, bits)) - 1);
}

/// Edge values of a covered pixel: a sliver, a vertex, an edge, or anything; the sum is in EdgeBits.
Three covered_edges(Random& random) {
  Three e{};
  do {
    for (std::int64_t& each : e) {
      each = random.between(0, 4) == 0 ? 0 : any_size(random, 48);
    }
  } while (e[0] + e[1] + e[2] == 0);
  return e;
}

/// 1/w of three vertices: all alike, near each other, or of any positive normal magnitude.
Floats any_q(Random& random) {
  const auto mantissa = [&] { return static_cast<std::uint32_t>(random.between(0, 0x7FFFFF)); };
  const std::int64_t spread = random.between(0, 3);
  Floats q{kFloatOne, kFloatOne, kFloatOne};
  for (std::uint32_t& each : q) {
    const auto field = static_cast<std::uint32_t>(spread == 1   ? 127
                                                  : spread == 2 ? random.between(120, 134)
                                                                : random.between(1, 254));
    each = spread == 0 ? kFloatOne : field << 23 | mantissa();
  }
  return q;
}

std::int32_t any_value(Random& random) {
  const std::int64_t magnitude = any_size(random, 31);
  return static_cast<std::int32_t>(random.between(0, 1) == 0 ? magnitude : -magnitude - 1);
}

mpz_class big(std::int64_t value) { return mpz_class(static_cast<long>(value)); }

/// E q as a whole number: the float's mantissa moved up by its exponent field.
mpz_class numerator(std::int64_t e, std::uint32_t q) {
  mpz_class product = big(e) * big((q & 0x7FFFFF) | 0x800000);
  mpz_mul_2exp(product.get_mpz_t(), product.get_mpz_t(), q >> 23);
  return product;
}

/// The exact attribute: the sum of the numerators times the values, by their sum.
struct Exact {
  mpq_class value;
  mpq_class magnification;  ///< sum of magnitudes by magnitude of the sum: 1 at covered pixels
};

Exact exact(const Three& e, const Floats& q, const Values& v) {
  mpz_class sum = 0;
  mpz_class weighted = 0;
  mpz_class magnitudes = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const mpz_class t = numerator(e[i], q[i]);
    sum += t;
    weighted += t * v[i];
    magnitudes += abs(t);
  }
  if (sum == 0) {
    return {0, -1};
  }
  Exact result{mpq_class(weighted, sum), mpq_class(magnitudes, sum)};
  result.value.canonicalize();
  result.magnification.canonicalize();
  return result;
}

/// |v1 - v0| + |v2 - v0|
mpq_class rises(const Values& v) { return abs(mpq_class(v[1]) - v[0]) + abs(mpq_class(v[2]) - v[0]); }

mpq_class last_place(int bits) { return mpq_class(1, 1u << bits); }

}  // namespace

TEST_CASE("interpolator: within its bound of the exact attribute at covered pixels", "[property]") {
  CAPTURE(seed());
  Random random(seed());
  const std::uint64_t count = samples(200'000);
  mpq_class worst = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    const int bits = 2 * static_cast<int>(random.between(4, 12));
    const Three e = covered_edges(random);
    const Floats q = any_q(random);
    const Values v{any_value(random), any_value(random), any_value(random)};
    const VertexWeights weights = perspective_weights(e, q, bits);
    const std::int32_t value = interpolate(v, weights, true, bits);
    const mpq_class off = abs(exact(e, q, v).value - value);
    const mpq_class error = off - mpq_class(1, 2);
    if (error > 0) {
      worst = std::max(worst, mpq_class(error / (last_place(bits) * rises(v))));
    }
    if (error > 3 * last_place(bits) * rises(v) || value < std::ranges::min(v) ||
        value > std::ranges::max(v)) {
      CAPTURE(bits, e, q, v, value, off.get_d(), worst.get_d());
      REQUIRE(error <= 3 * last_place(bits) * rises(v));
      REQUIRE(value >= std::ranges::min(v));
      REQUIRE(value <= std::ranges::max(v));
    }
  }
  UNSCOPED_INFO("worst error beyond half a unit, in 2^-bits of the rises: " << worst.get_d());
  CHECK(worst > 1);  // the bound is of the size of what happens
}

TEST_CASE("interpolator: helper pixels are as near as what cancels there lets them", "[property]") {
  CAPTURE(seed());
  Random random(seed() + 1);
  const std::uint64_t count = samples(200'000);
  std::uint64_t judged = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    const int bits = 2 * static_cast<int>(random.between(4, 12));
    Three e = covered_edges(random);
    e[static_cast<std::size_t>(random.between(0, 2))] *= -1;
    const Floats q = any_q(random);
    const Values v{any_value(random), any_value(random), any_value(random)};
    const Exact right = exact(e, q, v);
    const mpq_class& k = right.magnification;
    if (e[0] + e[1] + e[2] <= 0 || k < 0 || k > 4 || abs(right.value) > 0x7FFFFFFF) {
      continue;
    }
    ++judged;
    const std::int32_t value = interpolate(v, perspective_weights(e, q, bits), false, bits);
    const mpq_class limit = 4 * last_place(bits) * k * (1 + k) * rises(v) + mpq_class(1, 2);
    if (abs(right.value - value) > limit) {
      CAPTURE(bits, e, q, v, value, right.value.get_d(), k.get_d());
      REQUIRE(abs(right.value - value) <= limit);
    }
  }
  CHECK(judged > count / 10);
}

TEST_CASE("interpolator: the extremes of edges and of 1/w", "[property]") {
  const std::int64_t most = (std::int64_t{1} << (Widths{}.EdgeBits - 3)) - 1;
  const std::uint32_t least_q = 0x00800000;
  const std::uint32_t most_q = 0x7F7FFFFF;
  for (int bits = 8; bits <= 24; bits += 2) {
    for (const Three& e :
         {Three{most, 0, 0}, Three{0, most, 0}, Three{0, 0, most}, Three{1, 0, 0}, Three{0, 1, 0},
          Three{0, 0, 1}, Three{most, most, most}, Three{1, 1, 1}, Three{1, most, most}, Three{most, 1, 1}}) {
      for (const Floats& q : {Floats{kFloatOne, kFloatOne, kFloatOne}, Floats{least_q, most_q, most_q},
                              Floats{most_q, least_q, least_q}, Floats{least_q, least_q, least_q},
                              Floats{most_q, most_q, most_q}}) {
        for (const Values& v : {Values{0, INT32_MAX, INT32_MIN}, Values{INT32_MIN, INT32_MAX, INT32_MAX},
                                Values{INT32_MAX, INT32_MIN, 0}, Values{7, 7, 7}}) {
          const std::int32_t value = interpolate(v, perspective_weights(e, q, bits), true, bits);
          const mpq_class off = abs(exact(e, q, v).value - value);
          CAPTURE(bits, e, q, v, value);
          CHECK(off <= 3 * last_place(bits) * rises(v) + mpq_class(1, 2));
        }
      }
    }
  }
}

TEST_CASE("interpolator: a vertex gives its value, equal values stay, and so does what no number reaches") {
  for (const int bits : {8, 16, 24}) {
    const Values v{100, 228, -28};  // rises below 2^(8 - 1)
    CHECK(interpolate(v, perspective_weights({500, 0, 0}, {kFloatOne, kFloatOne, kFloatOne}, bits), true,
                      bits) == 100);
    CHECK(interpolate({0, 100, -100},
                      perspective_weights({0, 500, 0}, {kFloatOne, kFloatOne, kFloatOne}, bits), true,
                      bits) == 100);
    CHECK(interpolate({0, 100, -100},
                      perspective_weights({0, 0, 500}, {kFloatOne, kFloatOne, kFloatOne}, bits), true,
                      bits) == -100);
    // Halfway along an edge, with w of 1 and 3: 1/w is 1 and 1/3, and so the weights 3/4 and 1/4.
    const std::uint32_t third = std::bit_cast<std::uint32_t>(1.0F / 3);
    CHECK(interpolate({0, 400, 0}, perspective_weights({500, 500, 0}, {kFloatOne, third, kFloatOne}, bits),
                      true, bits) == Approx(100).margin(400.0 * 3 / (1 << bits) + 0.5));
    // Behind the horizon of the plane.
    const VertexWeights none =
        perspective_weights({-500, 400, 101}, {0x40000000, kFloatOne, kFloatOne}, bits);
    CHECK(none.w1 == 0);
    CHECK(none.w2 == 0);
    // Far outside: the weight saturates.
    const VertexWeights far = perspective_weights({-990, 1'000, 0}, {kFloatOne, kFloatOne, kFloatOne}, bits);
    CHECK(far.w1 == (std::int64_t{1} << (bits + kWeightWhole)) - 1);
    CHECK(interpolate({0, INT32_MAX, 0}, far, false, bits) == INT32_MAX);
    CHECK(interpolate({0, INT32_MIN, 0}, far, false, bits) == INT32_MIN);
  }
}

TEST_CASE("interpolator: the pixels of a quad, in the order of its mask") {
  // E1 = 256 (x - 2), E2 = 256 (y - 2) from the quad's first pixel on, 2A = 256 * 16: in steps of 1/16.
  AttributeQuad quad{.mask = 0b1001,
                     .e = {2 << 8, 4 << 8},
                     .a = {1, 0},
                     .b = {0, 1},
                     .area2 = 16 << 8,
                     .q = {kFloatOne, kFloatOne, kFloatOne},
                     .value = {}};
  for (std::size_t c = 0; c < 4; ++c) {
    quad.value[4 + c] = static_cast<std::int32_t>(1600 * (c + 1));  // at vertex 1
    quad.value[8 + c] = static_cast<std::int32_t>(160 * (c + 1));   // at vertex 2
  }
  const ShadedQuad shaded = interpolator(quad, 8, 24);
  CHECK(shaded.mask == 0b1001);
  for (std::size_t pixel = 0; pixel < 4; ++pixel) {
    for (std::size_t c = 0; c < 4; ++c) {
      const auto x = static_cast<std::int32_t>(2 + pixel % 2);
      const auto y = static_cast<std::int32_t>(4 + pixel / 2);
      CHECK(shaded.value[4 * pixel + c] == static_cast<std::int32_t>(c + 1) * (100 * x + 10 * y));
    }
  }
  CHECK(fits_widths(quad, Widths{}));
  CHECK(fits_widths(shaded, Widths{}));
}
