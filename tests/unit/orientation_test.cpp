// Signs of orientations and sums against rational arithmetic.
#include "halfspace/numerics/orientation.hpp"

#include <gmpxx.h>

#include <catch2/catch.hpp>

#include "../property/random.hpp"

using namespace halfspace;
using halfspace::testing::Random;
using halfspace::testing::samples;
using halfspace::testing::seed;

namespace {

int exact_orientation(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
  const mpq_class ax(a.x), ay(a.y), bx(b.x), by(b.y), cx(c.x), cy(c.y);
  return sgn(mpq_class((ax - cx) * (by - cy) - (ay - cy) * (bx - cx)));
}

/// A double of `bits` bits, times a power of two.
double random_double(Random& random, int bits, int least_log2, int most_log2) {
  const std::int64_t reach = std::int64_t{1} << bits;
  return std::ldexp(static_cast<double>(random.between(-reach, reach)),
                    static_cast<int>(random.between(least_log2, most_log2)));
}

}  // namespace

TEST_CASE("orientation is exact for points close to a line, near and far from the origin") {
  CAPTURE(seed());
  Random random(seed());
  int flat = 0;
  int turned = 0;
  for (std::uint64_t round = 0; round < samples(200'000) / 10; ++round) {
    const int bits = round % 2 == 0 ? 3 : 52;
    const int shift = round % 3 == 0 ? 0 : 60;
    const auto random_point = [&] {
      return glm::dvec2(random_double(random, bits, 0, shift), random_double(random, bits, 0, shift));
    };
    const glm::dvec2 a = random_point();
    const glm::dvec2 b = random_point();
    // a + t (b - a), rounded, and moved by some units in the last place
    const double t = static_cast<double>(random.between(-4, 8)) / 4;
    glm::dvec2 c = a + t * (b - a);
    for (auto moves = random.between(0, 2); moves > 0; --moves) {
      double& coordinate = random.between(0, 1) == 0 ? c.x : c.y;
      coordinate = std::nextafter(coordinate, random.between(0, 1) == 0 ? -1e300 : 1e300);
    }
    const double scale = std::ldexp(1.0, static_cast<int>(random.between(-480, 380)));
    const int expected = exact_orientation(a, b, c);
    CAPTURE(a.x, a.y, b.x, b.y, c.x, c.y, scale);
    REQUIRE(orientation(a, b, c) == expected);
    if (c.x == 0 || c.y == 0 || std::abs(c.x) < 1 || std::abs(c.y) < 1) continue;
    REQUIRE(orientation(a * scale, b * scale, c * scale) == expected);
    (expected == 0 ? flat : turned) += 1;
  }
  CHECK(flat > 0);
  CHECK(turned > 0);
}

TEST_CASE("a sum of products is exact whatever cancels out") {
  CAPTURE(seed());
  Random random(seed());
  for (std::uint64_t round = 0; round < samples(200'000) / 20; ++round) {
    ExactSum<kMostParts> sum;
    mpq_class exact;
    const int reach = round % 2 == 0 ? 30 : 400;
    std::vector<std::pair<double, double>> products;
    for (int i = 0; i < 10; ++i) {
      products.emplace_back(random_double(random, 52, -reach, reach),
                            random_double(random, 52, -reach, reach));
      // Some are taken back, all but their last bits.
      if (i % 2 == 1)
        products.emplace_back(-products.back().first, std::nextafter(products.back().second, 0));
    }
    for (const auto& [a, b] : products) {
      sum.add_product(a, b);
      exact += mpq_class(a) * mpq_class(b);
      REQUIRE(sum.sign() == sgn(exact));
    }
    for (const auto& [a, b] : products) sum.add_product(-a, b);
    REQUIRE(sum.sign() == 0);
  }
}

TEST_CASE("of points on a line, one between others is neither of them") {
  CHECK(strictly_between({0, 0}, {1, 2}, {2, 4}));
  CHECK(strictly_between({2, 4}, {1, 2}, {0, 0}));
  CHECK(strictly_between({0, 5}, {0, 4}, {0, 3}));
  CHECK_FALSE(strictly_between({0, 0}, {0, 0}, {2, 4}));
  CHECK_FALSE(strictly_between({0, 0}, {2, 4}, {2, 4}));
  CHECK_FALSE(strictly_between({0, 0}, {2, 4}, {1, 2}));
  CHECK_FALSE(strictly_between({0, 5}, {0, 3}, {0, 4}));
}
