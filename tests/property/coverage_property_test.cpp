// What exact coverage must satisfy, whatever the triangle: the formulas are those of plane geometry.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <utility>
#include <vector>

#include "halfspace/reference/exact_triangle.hpp"
#include "random.hpp"

namespace {

using halfspace::reference::covers;
using halfspace::reference::GridPoint;
using halfspace::reference::GridTriangle;
using halfspace::reference::Int128;
using halfspace::reference::pixel_centre;
using halfspace::reference::TieRule;
using halfspace::reference::twice_area;
using halfspace::testing::Random;
using halfspace::testing::seed;

constexpr int kBits = 8;
constexpr std::int64_t kOne = 1 << kBits;
constexpr std::array kRules = {TieRule::kTopLeft, TieRule::kBottomLeft, TieRule::kTopRight,
                               TieRule::kBottomRight, TieRule::kNormalSign};

/// The pixels of a size x size window that `t` covers, row by row.
std::vector<int> coverage(const GridTriangle& t, int size, TieRule rule, int bits = kBits) {
  std::vector<int> result;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) result.push_back(covers(t, pixel_centre(x, y, bits), rule) ? 1 : 0);
  }
  return result;
}

void add(std::vector<int>& sum, const std::vector<int>& other) {
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += other[i];
}

GridPoint random_point(Random& random, std::int64_t low, std::int64_t high) {
  return {random.between(low, high), random.between(low, high)};
}

GridTriangle random_triangle(Random& random, std::int64_t low, std::int64_t high) {
  return {random_point(random, low, high), random_point(random, low, high), random_point(random, low, high)};
}

std::int64_t area2(const GridTriangle& t) { return static_cast<std::int64_t>(twice_area(t[0], t[1], t[2])); }

}  // namespace

TEST_CASE("A rectangle split along either diagonal is covered exactly once", "[property][coverage]") {
  // Every rectangle with corners on the half-pixel grid of a 4x4 window, so that corners, edges and diagonals
  // pass through pixel centres. With y down, a rule of left edges owns [x0, x1), of right ones (x0, x1]; of
  // top ones [y0, y1), of bottom ones (y0, y1].
  constexpr int kSize = 4;
  const std::int64_t half = kOne / 2;
  for (const TieRule rule : kRules) {
    for (std::int64_t x0 = 0; x0 <= 8; ++x0) {
      for (std::int64_t x1 = x0 + 1; x1 <= 8; ++x1) {
        for (std::int64_t y0 = 0; y0 <= 8; ++y0) {
          for (std::int64_t y1 = y0 + 1; y1 <= 8; ++y1) {
            const GridPoint a{x0 * half, y0 * half}, b{x1 * half, y0 * half}, c{x1 * half, y1 * half},
                d{x0 * half, y1 * half};
            std::vector<int> one = coverage({a, b, c}, kSize, rule);
            add(one, coverage({a, c, d}, kSize, rule));
            std::vector<int> other = coverage({a, b, d}, kSize, rule);
            add(other, coverage({b, c, d}, kSize, rule));
            std::vector<int> expected;
            for (int py = 0; py < kSize; ++py) {
              for (int px = 0; px < kSize; ++px) {
                const std::int64_t x = 2 * px + 1, y = 2 * py + 1;  // the centre, in half pixels
                const bool row = owns_top(rule) ? y >= y0 && y < y1 : y > y0 && y <= y1;
                const bool column = owns_left(rule) ? x >= x0 && x < x1 : x > x0 && x <= x1;
                expected.push_back(row && column ? 1 : 0);
              }
            }
            CAPTURE(x0, x1, y0, y1);
            REQUIRE(one == expected);
            REQUIRE(other == expected);
          }
        }
      }
    }
  }
}

TEST_CASE("A closed fan covers each sample inside exactly once", "[property][coverage]") {
  // A square of 7 pixels around a window of 5; the rim's points are a step apart that divides the side, so
  // that the corners are among them. The hub is every pixel centre and every pixel corner of the window.
  constexpr int kSize = 5;
  const std::int64_t low = -kOne, side = 7 * kOne;
  for (const std::int64_t step : {kOne / 2, kOne, side / 2, side}) {
    std::vector<GridPoint> rim;
    for (std::int64_t at = 0; at < side; at += step) rim.push_back({low + at, low});
    for (std::int64_t at = 0; at < side; at += step) rim.push_back({low + side, low + at});
    for (std::int64_t at = 0; at < side; at += step) rim.push_back({low + side - at, low + side});
    for (std::int64_t at = 0; at < side; at += step) rim.push_back({low, low + side - at});
    for (std::int64_t hub_y = 0; hub_y <= 2 * kSize; ++hub_y) {
      for (std::int64_t hub_x = 0; hub_x <= 2 * kSize; ++hub_x) {
        const GridPoint hub{hub_x * kOne / 2, hub_y * kOne / 2};
        for (const TieRule rule : kRules) {
          std::vector<int> sum(kSize * kSize, 0);
          for (std::size_t i = 0; i < rim.size(); ++i) {
            add(sum, coverage({hub, rim[i], rim[(i + 1) % rim.size()]}, kSize, rule));
          }
          CAPTURE(step, hub_x, hub_y);
          REQUIRE(sum == std::vector<int>(kSize * kSize, 1));
        }
      }
    }
  }
}

TEST_CASE("A triangle split at a point is covered by its three parts exactly once", "[property][coverage]") {
  CAPTURE(seed());
  Random random(seed());
  constexpr int kSize = 8;
  for (int round = 0; round < 2000; ++round) {
    // Half the rounds on the half-pixel grid, where ties are frequent.
    const std::int64_t unit = round % 2 == 0 ? kOne / 2 : 1;
    const std::int64_t range = kSize * kOne / unit;
    GridTriangle t = random_triangle(random, -range, 2 * range);
    for (GridPoint& p : t) p = {p.x * unit, p.y * unit};
    if (area2(t) == 0) continue;
    // Any point will do that lies inside: keep those whose three parts wind like the whole.
    GridPoint p = random_point(random, -range, 2 * range);
    p = {p.x * unit, p.y * unit};
    const bool positive = area2(t) > 0;
    const std::array<GridTriangle, 3> parts = {GridTriangle{p, t[0], t[1]}, GridTriangle{p, t[1], t[2]},
                                               GridTriangle{p, t[2], t[0]}};
    bool inside = true;
    for (const GridTriangle& part : parts)
      inside = inside && area2(part) != 0 && (area2(part) > 0) == positive;
    if (!inside) continue;
    for (const TieRule rule : kRules) {
      std::vector<int> sum(kSize * kSize, 0);
      for (const GridTriangle& part : parts) add(sum, coverage(part, kSize, rule));
      CAPTURE(round);
      REQUIRE(sum == coverage(t, kSize, rule));
    }
  }
}

TEST_CASE("A jittered mesh has no gaps and no double covers", "[property][coverage]") {
  CAPTURE(seed());
  Random random(seed());
  constexpr int kCells = 6;
  for (int bits = 4; bits <= 8; ++bits) {
    for (int round = 0; round < 60; ++round) {
      // Cells of 2 pixels; inner vertices move by less than a quarter of a cell, which keeps every triangle's
      // winding. In every third round they move in half pixels only, so that they hit pixel centres.
      const std::int64_t one = std::int64_t{1} << bits;
      const std::int64_t unit = round % 3 == 0 ? one / 2 : 1;
      const std::int64_t reach = round % 3 == 0 ? 1 : one / 2 - 1;
      std::vector<GridPoint> grid;
      for (int j = 0; j <= kCells; ++j) {
        for (int i = 0; i <= kCells; ++i) {
          const bool inner = i > 0 && i < kCells && j > 0 && j < kCells;
          const std::int64_t dx = inner ? unit * random.between(-reach, reach) : 0;
          const std::int64_t dy = inner ? unit * random.between(-reach, reach) : 0;
          grid.push_back({2 * one * i + dx, 2 * one * j + dy});
        }
      }
      const auto vertex = [&](int i, int j) { return grid.at(static_cast<unsigned>(j * (kCells + 1) + i)); };
      for (const TieRule rule : kRules) {
        std::vector<int> sum(4 * kCells * kCells, 0);
        for (int j = 0; j < kCells; ++j) {
          for (int i = 0; i < kCells; ++i) {
            const GridPoint a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1),
                            d = vertex(i, j + 1);
            const bool rising = (i + j + round) % 2 == 0;
            add(sum,
                coverage(rising ? GridTriangle{a, b, d} : GridTriangle{a, b, c}, 2 * kCells, rule, bits));
            add(sum,
                coverage(rising ? GridTriangle{b, c, d} : GridTriangle{a, c, d}, 2 * kCells, rule, bits));
          }
        }
        CAPTURE(bits, round);
        REQUIRE(sum == std::vector<int>(4 * kCells * kCells, 1));
      }
    }
  }
}

TEST_CASE("The order of the vertices does not change coverage", "[property][coverage]") {
  CAPTURE(seed());
  Random random(seed());
  for (int round = 0; round < 500; ++round) {
    const GridTriangle t = random_triangle(random, -kOne, 9 * kOne);
    for (const TieRule rule : kRules) {
      const std::vector<int> expected = coverage(t, 8, rule);
      std::array<std::size_t, 3> order = {0, 1, 2};
      do {
        CAPTURE(round, order[0], order[1], order[2]);
        REQUIRE(coverage({t[order[0]], t[order[1]], t[order[2]]}, 8, rule) == expected);
      } while (std::next_permutation(order.begin(), order.end()));
    }
  }
}

TEST_CASE("Moving a triangle by whole pixels moves its coverage", "[property][coverage]") {
  CAPTURE(seed());
  Random random(seed());
  for (int round = 0; round < 500; ++round) {
    const GridTriangle t = random_triangle(random, -kOne, 9 * kOne);
    const std::int64_t dx = random.between(-30000, 30000);
    const std::int64_t dy = random.between(-30000, 30000);
    GridTriangle moved = t;
    for (GridPoint& p : moved) p = {p.x + dx * kOne, p.y + dy * kOne};
    for (const TieRule rule : kRules) {
      for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 8; ++x) {
          CAPTURE(round, dx, dy, x, y);
          REQUIRE(covers(t, pixel_centre(x, y, kBits), rule) ==
                  covers(moved, pixel_centre(x + dx, y + dy, kBits), rule));
        }
      }
    }
  }
}

TEST_CASE("Mirrored upside down, top-left becomes bottom-left", "[property][coverage]") {
  CAPTURE(seed());
  Random random(seed());
  constexpr int kSize = 8;
  for (int round = 0; round < 1000; ++round) {
    GridTriangle t = random_triangle(random, -2, 2 * kSize + 2);
    for (GridPoint& p : t) p = {p.x * kOne / 2, p.y * kOne / 2};
    GridTriangle mirrored = t;
    for (GridPoint& p : mirrored) p.y = kSize * kOne - p.y;
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        CAPTURE(round, x, y);
        REQUIRE(covers(t, pixel_centre(x, y, kBits), TieRule::kTopLeft) ==
                covers(mirrored, pixel_centre(x, kSize - 1 - y, kBits), TieRule::kBottomLeft));
      }
    }
  }
}

TEST_CASE("A parallelogram of lattice vectors covers as many samples as its area", "[property][coverage]") {
  // A half-open parallelogram with corners at pixel centres holds exactly |det| lattice points, wherever it
  // lies.
  CAPTURE(seed());
  Random random(seed());
  constexpr int kSize = 32;
  for (int round = 0; round < 400; ++round) {
    const auto at = [](std::int64_t x, std::int64_t y) { return pixel_centre(x, y, kBits); };
    const std::int64_t ux = random.between(-7, 7), uy = random.between(-7, 7);
    const std::int64_t vx = random.between(-7, 7), vy = random.between(-7, 7);
    const std::int64_t determinant = ux * vy - uy * vx;
    if (determinant == 0) continue;
    const GridPoint a = at(16, 16), b = at(16 + ux, 16 + uy), c = at(16 + ux + vx, 16 + uy + vy),
                    d = at(16 + vx, 16 + vy);
    for (const TieRule rule : kRules) {
      std::vector<int> sum = coverage({a, b, c}, kSize, rule);
      add(sum, coverage({a, c, d}, kSize, rule));
      CAPTURE(round, ux, uy, vx, vy);
      REQUIRE(std::accumulate(sum.begin(), sum.end(), 0) == std::abs(determinant));
      REQUIRE(std::none_of(sum.begin(), sum.end(), [](int n) { return n > 1; }));
    }
  }
}

TEST_CASE("A lattice triangle covers what Pick's theorem says", "[property][coverage]") {
  // Pick: 2A = 2I + B - 2 with I points inside and B on the boundary. Of the boundary the triangle owns the
  // inner points of its left edges (all going up, clockwise on the screen) and of a top edge, and one vertex
  // if any: the one between two owning edges. (A vertex is on two edges and needs both.)
  CAPTURE(seed());
  Random random(seed());
  constexpr int kSize = 20;
  for (int round = 0; round < 2000; ++round) {
    GridTriangle pixel = random_triangle(random, 0, kSize - 1);
    if (area2(pixel) == 0) continue;
    if (area2(pixel) < 0) std::swap(pixel[1], pixel[2]);
    std::int64_t boundary = 0;
    std::int64_t owned = 0;
    std::array<bool, 3> owns{};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int64_t dx = pixel[(i + 1) % 3].x - pixel[i].x;
      const std::int64_t dy = pixel[(i + 1) % 3].y - pixel[i].y;
      const std::int64_t steps = std::gcd(dx, dy);  // lattice points on the edge, without its end
      owns[i] = dy < 0 || (dy == 0 && dx > 0);
      boundary += steps;
      if (owns[i]) owned += steps - 1;
    }
    for (std::size_t i = 0; i < 3; ++i) owned += owns[i] && owns[(i + 1) % 3] ? 1 : 0;
    const std::int64_t interior = (area2(pixel) - boundary + 2) / 2;

    GridTriangle t;
    for (std::size_t i = 0; i < 3; ++i) t[i] = pixel_centre(pixel[i].x, pixel[i].y, kBits);
    const std::vector<int> covered = coverage(t, kSize, TieRule::kTopLeft);
    CAPTURE(round, interior, owned);
    REQUIRE(std::accumulate(covered.begin(), covered.end(), std::int64_t{0}) == interior + owned);
  }
}

TEST_CASE("A large triangle covers about its area", "[property][coverage]") {
  // A row is cut by a convex shape in an interval, which holds its length in samples to within one; the sum
  // over the rows samples a function of x-width with one maximum, whose midpoint sum is within that maximum
  // of the integral.
  CAPTURE(seed());
  Random random(seed());
  constexpr int kSize = 200;
  for (int round = 0; round < 20; ++round) {
    const GridTriangle t = random_triangle(random, 0, kSize * kOne);
    const std::vector<int> covered = coverage(t, kSize, TieRule::kTopLeft);
    const double pixels = std::abs(static_cast<double>(area2(t))) / 2 / (kOne * kOne);
    CAPTURE(round, pixels);
    REQUIRE(std::abs(std::accumulate(covered.begin(), covered.end(), 0) - pixels) <= 2 * kSize);
  }
}

TEST_CASE("A triangle without area covers nothing", "[property][coverage]") {
  const GridPoint a = pixel_centre(1, 1, kBits), b = pixel_centre(4, 4, kBits), c = pixel_centre(2, 2, kBits);
  for (const TieRule rule : kRules) {
    REQUIRE(coverage({a, b, c}, 6, rule) == std::vector<int>(36, 0));
    REQUIRE(coverage({a, a, b}, 6, rule) == std::vector<int>(36, 0));
  }
}

TEST_CASE("Coverage stays exact at the corners of the 16.8 range", "[property][coverage]") {
  // The diagonal of the whole range, against the same with one end moved by 1/256 pixel: the sample on the
  // diagonal changes sides.
  const std::int64_t far = 32767 * kOne;
  const GridPoint corner{-far, -far}, opposite{far, far}, side{-far, far};
  const GridPoint sample = pixel_centre(12345, 12345, kBits);
  CHECK(twice_area(corner, opposite, sample) == 0);
  CHECK(covers({corner, opposite, side}, sample, TieRule::kTopLeft) !=
        covers({corner, opposite, {far, -far}}, sample, TieRule::kTopLeft));
  CHECK_FALSE(covers({corner, {far - 1, far}, side}, sample, TieRule::kTopLeft));
  CHECK(covers({corner, {far, far - 1}, side}, sample, TieRule::kTopLeft));
  static_assert(sizeof(Int128) == 16);
}
