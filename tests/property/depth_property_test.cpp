// Exact depth against planes whose values are known, and the rulers (ulps) against numbers made by hand.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <limits>

#include "halfspace/numerics/depth.hpp"
#include "halfspace/reference/depth_code.hpp"
#include "halfspace/reference/exact_depth.hpp"
#include "random.hpp"

namespace {

using halfspace::reference::exact_depth;
using halfspace::reference::float_value;
using halfspace::reference::GridPoint;
using halfspace::reference::GridTriangle;
using halfspace::reference::nearest_float;
using halfspace::reference::nearest_unorm;
using halfspace::reference::pixel_centre;
using halfspace::reference::Storage;
using halfspace::reference::twice_area;
using halfspace::reference::ulps_off_float;
using halfspace::reference::ulps_off_unorm;
using halfspace::reference::unorm_value;
using halfspace::testing::Random;
using halfspace::testing::seed;

GridPoint random_point(Random& random) {
  return {random.between(-8388607, 8388607), random.between(-8388607, 8388607)};
}

}  // namespace

TEST_CASE("The depth of a plane is the plane's formula", "[property][depth]") {
  CAPTURE(seed());
  Random random(seed());
  for (int round = 0; round < 1000; ++round) {
    const GridTriangle t = {random_point(random), random_point(random), random_point(random)};
    if (twice_area(t[0], t[1], t[2]) == 0) continue;
    const std::int64_t a = random.between(-99, 99), b = random.between(-99, 99),
                       c = random.between(-99999, 99999);
    const auto plane = [&](const GridPoint& p) { return mpq_class(a * p.x + b * p.y + c); };
    const GridPoint sample = random_point(random);  // inside or not
    CAPTURE(round);
    REQUIRE(exact_depth(t, {plane(t[0]), plane(t[1]), plane(t[2])}, sample) == plane(sample));
  }
}

TEST_CASE("Inside a triangle depth stays between its vertices", "[property][depth]") {
  CAPTURE(seed());
  Random random(seed());
  int inside = 0;
  for (int round = 0; round < 3000; ++round) {
    const GridTriangle t = {random_point(random), random_point(random), random_point(random)};
    const GridPoint sample = pixel_centre(random.between(-32767, 32766), random.between(-32767, 32766), 8);
    if (!covers(t, sample, halfspace::reference::TieRule::kTopLeft)) continue;
    ++inside;
    std::array<mpq_class, 3> z;
    for (mpq_class& value : z)
      value = unorm_value(static_cast<std::uint32_t>(random.between(0, 0xFFFFFF)), 24);
    const mpq_class depth = exact_depth(t, z, sample);
    CAPTURE(round);
    REQUIRE(depth >= std::min({z[0], z[1], z[2]}));
    REQUIRE(depth <= std::max({z[0], z[1], z[2]}));
  }
  REQUIRE(inside > 30);
}

TEST_CASE("A level triangle of float depth keeps it to the bit", "[property][depth]") {
  // Depths too small for a common scale of 128 bits are the reason for wide integers.
  const GridTriangle t = {GridPoint{-8388607, 0}, GridPoint{8388607, 1}, GridPoint{0, 8388607}};
  for (const float z : {0.0f, 1.0f, 0.1f, 1e-30f, std::numeric_limits<float>::denorm_min()}) {
    CAPTURE(z);
    REQUIRE(nearest_float(exact_depth(t, {float_value(z), float_value(z), float_value(z)},
                                      pixel_centre(3, 4, 8))) == z);
  }
}

TEST_CASE("A code is nearest to its own value and to nothing farther than half a step", "[property][depth]") {
  CAPTURE(seed());
  Random random(seed());
  for (const int bits : {16, 24, 32}) {
    const std::int64_t top = (std::int64_t{1} << bits) - 1;
    for (int round = 0; round < 1000; ++round) {
      const auto code = static_cast<std::uint32_t>(random.between(0, top - 1));
      const mpq_class value = unorm_value(code, bits);
      const mpq_class half = (unorm_value(code + 1, bits) - value) / 2;
      CAPTURE(bits, code);
      REQUIRE(nearest_unorm(value, bits) == code);
      REQUIRE(nearest_unorm(value + half * mpq_class(99, 100), bits) == code);
      REQUIRE(nearest_unorm(value + half * mpq_class(101, 100), bits) == code + 1);
      REQUIRE(nearest_unorm(value + half, bits) == (code % 2 == 0 ? code : code + 1));
    }
  }
}

TEST_CASE("The nearest float is what the processor rounds to", "[property][depth]") {
  CAPTURE(seed());
  Random random(seed());
  for (int round = 0; round < 5000; ++round) {
    const double value = std::ldexp(static_cast<double>(random.between(0, (std::int64_t{1} << 53) - 1)),
                                    -53 - static_cast<int>(random.between(0, 150)));
    CAPTURE(round, value);
    REQUIRE(nearest_float(mpq_class(value)) == static_cast<float>(value));
  }
}

TEST_CASE("The ruler of unorm depth", "[property][depth]") {
  const mpq_class exact = unorm_value(1000, 24);
  CHECK(ulps_off_unorm(1000, exact, 24) == 0);
  CHECK(ulps_off_unorm(1001, exact, 24) == 1);
  CHECK(ulps_off_unorm(990, exact, 24) == 10);
  CHECK(ulps_off_unorm(0, mpq_class(1), 16) == 65535);
  CHECK(ulps_off_unorm(32768, mpq_class(1, 2), 16) == mpq_class(1, 2));
}

TEST_CASE("The ruler of float depth", "[property][depth]") {
  for (const float z : {0.25f, 0.3f, 0.999f, 1e-20f, 1e-40f}) {
    CAPTURE(z);
    CHECK(ulps_off_float(z, float_value(z)) == 0);
    CHECK(ulps_off_float(std::nextafter(z, 1.0f), float_value(z)) == 1);
  }
  CHECK(ulps_off_float(std::nextafter(0.25f, 0.0f), mpq_class(1, 4)) ==
        mpq_class(1, 2));  // finer below a power of 2
  CHECK(ulps_off_float(std::numeric_limits<float>::denorm_min(), mpq_class(0)) == 1);
  CHECK(ulps_off_float(0.0f, mpq_class(1)) == (1 << 23));
}

TEST_CASE("Storing rounds to the nearest code, clamps, and keeps the order", "[property][depth]") {
  using halfspace::reference::decode_depth;
  using halfspace::reference::encode_depth;
  CAPTURE(seed());
  Random random(seed());
  for (const Storage storage : {Storage::kUnorm16, Storage::kUnorm24, Storage::kFloat32}) {
    CHECK(encode_depth(-0.0, storage) == encode_depth(0.0, storage));
    const int bits = halfspace::reference::unorm_bits(storage);
    if (bits != 0) {
      CHECK(encode_depth(-3, storage) == encode_depth(0, storage));
      CHECK(encode_depth(7, storage) == encode_depth(1, storage));
      CHECK(encode_depth(std::numeric_limits<double>::quiet_NaN(), storage) == encode_depth(0, storage));
    }
    CHECK(decode_depth(encode_depth(1, storage), storage) == 1.0f);
    for (int round = 0; round < 2000; ++round) {
      const double low = std::ldexp(static_cast<double>(random.between(0, (std::int64_t{1} << 53) - 1)), -53);
      const double high =
          std::ldexp(static_cast<double>(random.between(0, (std::int64_t{1} << 53) - 1)), -53);
      CAPTURE(round, low, high);
      REQUIRE((encode_depth(std::min(low, high), storage) <= encode_depth(std::max(low, high), storage)));
      if (bits != 0) {
        // One rounding in double before the one to an integer: exact but for ties, which the tolerance
        // allows.
        REQUIRE(ulps_off_unorm(encode_depth(low, storage), mpq_class(low), bits) <=
                mpq_class(500001, 1000000));
      } else {
        REQUIRE(decode_depth(encode_depth(low, storage), storage) == nearest_float(mpq_class(low)));
      }
    }
  }
}

TEST_CASE("Codes of float32 depths of any size and sign are in the order of depth", "[property][depth]") {
  using halfspace::reference::decode_depth;
  using halfspace::reference::depth_test;
  using halfspace::reference::encode_depth;
  constexpr std::uint32_t kLess = 1;
  const auto code = [](float z) { return encode_depth(z, Storage::kFloat32); };
  Random random(seed());
  const auto any_float = [&] {
    const double mantissa = static_cast<double>(random.between(-(1 << 24) + 1, (1 << 24) - 1));
    return static_cast<float>(std::ldexp(mantissa, static_cast<int>(random.between(-149, 104))));
  };
  for (int round = 0; round < 20000; ++round) {
    const float a = any_float();
    const float b = round % 4 == 0 ? std::nextafter(a, any_float()) : any_float();
    CAPTURE(seed(), a, b);
    REQUIRE(depth_test(kLess, code(a), code(b)) == (a < b));
    REQUIRE(decode_depth(code(a), Storage::kFloat32) == a);
    REQUIRE(halfspace::depth_passes(halfspace::DepthFunc::kLess, code(a), code(b)) == (a < b));
    REQUIRE(halfspace::code_of_depth(halfspace::DepthFormat::kFloat32, a) == code(a));
    REQUIRE(halfspace::depth_of_code(halfspace::DepthFormat::kFloat32, code(a)) == a);
  }
}
