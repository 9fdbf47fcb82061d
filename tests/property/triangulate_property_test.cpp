// Triangles of random polygons: exactly the polygon's area, and what is inside covered exactly once. Area,
// seams and winding numbers are integers computed here; coverage is the textbook's, and the functional
// machine's.
#include <gmpxx.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "../frames.hpp"
#include "../seamless.hpp"
#include "halfspace/core/functional.hpp"
#include "halfspace/scene/triangulate.hpp"
#include "polygons.hpp"

using namespace halfspace::testing;
namespace reference = halfspace::reference;
using reference::GridTriangle;
using reference::TieRule;

namespace {

/// A polygon as triangulate() takes it: the corners lie on a plane in space, and may share positions.
struct PolygonInSpace {
  Ring points;  ///< of each position, in the plane
  std::vector<glm::dvec3> positions;
  std::vector<std::uint32_t> polygon;
};

/// The plane is put into space by integers, and then scaled, by which no coordinate is rounded: flat corners
/// stay flat.
PolygonInSpace put_into_space(Random& random, const Ring& ring) {
  PolygonInSpace result;
  // Small numbers, or such that most coordinates have all of 53 bits.
  const std::int64_t reach = one_in(random, 2) ? 3 : std::int64_t{1} << 42;
  glm::dvec3 u{0}, v{0}, origin{0};
  const auto random_step = [&] { return static_cast<double>(random.between(-reach, reach)); };
  const auto minor = [&](int i, int j) {  // of integers of 42 bits, exact
    return static_cast<Int128>(u[i]) * static_cast<Int128>(v[j]) -
           static_cast<Int128>(u[j]) * static_cast<Int128>(v[i]);
  };
  do {
    for (int axis = 0; axis < 3; ++axis) {
      u[axis] = random_step();
      v[axis] = random_step();
      origin[axis] = random_step();
    }
  } while (minor(0, 1) == 0 || minor(1, 2) == 0 || minor(2, 0) == 0);
  const int scale = one_in(random, 4) ? static_cast<int>(random.between(-1060, 960)) : 0;
  const bool share = one_in(random, 2);
  std::map<std::pair<std::int64_t, std::int64_t>, std::uint32_t> known;
  for (const GridPoint& p : ring) {
    const auto next = static_cast<std::uint32_t>(result.positions.size());
    const auto [place, is_new] = known.try_emplace({p.x, p.y}, next);
    if (share && !is_new) {
      result.polygon.push_back(place->second);
      continue;
    }
    const glm::dvec3 position = origin + static_cast<double>(p.x) * u + static_cast<double>(p.y) * v;
    result.points.push_back(p);
    result.positions.emplace_back(std::ldexp(position.x, scale), std::ldexp(position.y, scale),
                                  std::ldexp(position.z, scale));
    result.polygon.push_back(next);
  }
  return result;
}

/// How often the ring winds around the centre of each pixel, row by row. A centre on the boundary counts as
/// what lies beside it: first to the right or left of it, then below or above, as the rule has it.
std::vector<int> winding_numbers(const Ring& ring, TieRule rule = TieRule::kTopLeft) {
  std::vector<int> result(kPolygonPixels * kPolygonPixels, 0);
  const auto at = [&](std::int64_t x, std::int64_t y) -> int& {
    return result[static_cast<std::size_t>(y * kPolygonPixels + x)];
  };
  for (std::size_t i = 0; i < ring.size(); ++i) {
    GridPoint a = ring[i], b = ring[(i + 1) % ring.size()];
    const int sign = a.y < b.y ? -1 : 1;
    if (a.y > b.y) std::swap(a, b);
    for (std::int64_t row = 0; row < kPolygonPixels; ++row) {
      const std::int64_t y = reference::pixel_centre(0, row, kPolygonBits).y;
      if (owns_top(rule) ? y < a.y || y >= b.y : y <= a.y || y > b.y) continue;
      for (std::int64_t column = 0; column < kPolygonPixels; ++column) {
        const std::int64_t x = reference::pixel_centre(column, row, kPolygonBits).x;
        const std::int64_t to_the_right = (x - a.x) * (b.y - a.y) - (b.x - a.x) * (y - a.y);
        if (to_the_right < 0 || (to_the_right == 0 && !owns_left(rule))) continue;
        at(column, row) += sign;
      }
    }
  }
  return result;
}

/// How many triangles cover the centre of each pixel, less those that do and wind the other way.
std::vector<int> coverage(const std::vector<GridTriangle>& triangles) {
  std::vector<int> result(kPolygonPixels * kPolygonPixels, 0);
  for (const GridTriangle& t : triangles) {
    const auto [left, right] = std::minmax({t[0].x, t[1].x, t[2].x});
    const auto [top, bottom] = std::minmax({t[0].y, t[1].y, t[2].y});
    const int sign = turn(t[0], t[1], t[2]);
    const auto pixel = [](std::int64_t at) {
      return std::clamp<std::int64_t>(at >> kPolygonBits, 0, kPolygonPixels - 1);
    };
    for (std::int64_t y = pixel(top); y <= pixel(bottom); ++y) {
      for (std::int64_t x = pixel(left); x <= pixel(right); ++x) {
        if (!covers(t, reference::pixel_centre(x, y, kPolygonBits), TieRule::kTopLeft)) continue;
        result[static_cast<std::size_t>(y * kPolygonPixels + x)] += sign;
      }
    }
  }
  return result;
}

struct Triangulation {
  std::vector<GridTriangle> triangles;
  bool seamless = false;
  Int128 area = 0;
  int backwards = 0;  ///< triangles that wind unlike the polygon
  int flat = 0;
};

Triangulation triangulated(const PolygonInSpace& in) {
  std::vector<std::uint32_t> corners;
  REQUIRE(halfspace::triangulate(in.polygon, in.positions, corners));
  REQUIRE(corners.size() == 3 * (in.polygon.size() - 2));
  Triangulation result;
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    const GridTriangle t = {in.points[corners[i]], in.points[corners[i + 1]], in.points[corners[i + 2]]};
    result.triangles.push_back(t);
    result.area += reference::twice_area(t[0], t[1], t[2]);
  }
  for (const GridTriangle& t : result.triangles) {
    const int way = turn(t[0], t[1], t[2]);
    result.flat += way == 0 ? 1 : 0;
    result.backwards += way != 0 && (way > 0) != (result.area > 0) ? 1 : 0;
  }
  result.seamless = is_seamless(in.polygon, corners);
  return result;
}

Ring tree_of_faces(Random& random) {
  const PlaneMap map = PlaneMap::random(random);
  TreeOfFaces tree(random, map);
  Ring ring = tree.boundary();
  REQUIRE(twice_ring_area(ring) == tree.twice_area());
  return ring;
}

/// A ring that does not touch itself.
Ring simple_polygon(Random& random) {
  switch (random.between(0, 3)) {
    case 0:
      while (true) {
        const auto ring = untangled(random, 4 + below(random, 24), kHalfPixel << random.between(0, 2));
        if (ring) return *ring;
      }
    case 1:
      return star(random, below(random, 40));
    case 2:
      return spiral(8 + 2 * below(random, 30), kPolygonSide);
    default:
      return comb(random, 1 + below(random, 8), kHalfPixel, kPolygonSide);
  }
}

/// A weakly simple ring, either way round.
Ring weakly_simple_polygon(Random& random) {
  while (true) {
    const std::int64_t kind = random.between(0, 7);
    Ring ring = kind < 4   ? tree_of_faces(random)
                : kind < 5 ? rounded_disc(random, 3 + below(random, 90))
                           : simple_polygon(random);
    if (random.between(0, 3) > 0) ring = with_other_corners(random, ring);
    if (one_in(random, 2)) std::reverse(ring.begin(), ring.end());
    if (ring.size() >= 3) return ring;
  }
}

constexpr std::uint64_t kPolygonSamples = kPolygonPixels * kPolygonPixels;

constexpr std::array<std::pair<halfspace::FillRuleKey, TieRule>, 4> kMachineRules = {
    {{halfspace::FillRuleKey::kTopLeft, TieRule::kTopLeft},
     {halfspace::FillRuleKey::kBottomLeft, TieRule::kBottomLeft},
     {halfspace::FillRuleKey::kTopRight, TieRule::kTopRight},
     {halfspace::FillRuleKey::kBottomRight, TieRule::kBottomRight}}};

}  // namespace

TEST_CASE("triangulate: weakly simple polygons are covered exactly once", "[property]") {
  CAPTURE(seed());
  Random random(seed());
  int touching = 0;  // polygons with two corners in one place
  for (std::uint64_t round = 0; round < samples(20'000 * kPolygonSamples) / kPolygonSamples; ++round) {
    const Ring ring = weakly_simple_polygon(random);
    const Triangulation result = triangulated(put_into_space(random, ring));
    CAPTURE(round, ring.size());
    REQUIRE(result.area == twice_ring_area(ring));
    REQUIRE(result.seamless);
    REQUIRE(result.backwards == 0);
    const std::vector<int> expected = winding_numbers(ring);
    REQUIRE(coverage(result.triangles) == expected);
    const int inside = result.area < 0 ? -1 : 1;
    REQUIRE(std::all_of(expected.begin(), expected.end(), [&](int n) { return n == 0 || n == inside; }));
    std::set<std::pair<std::int64_t, std::int64_t>> places;
    for (const GridPoint& p : ring) places.emplace(p.x, p.y);
    touching += places.size() < ring.size() ? 1 : 0;
  }
  CHECK(touching > 0);
}

TEST_CASE("triangulate: a simple polygon that is not convex gets no flat triangle", "[property]") {
  CAPTURE(seed());
  Random random(seed());
  for (std::uint64_t round = 0; round < samples(4'000 * kPolygonSamples) / kPolygonSamples; ++round) {
    const Ring ring = simple_polygon(random);
    const Triangulation result = triangulated(put_into_space(random, ring));
    bool convex = true;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const int way = turn(ring[i], ring[(i + 1) % ring.size()], ring[(i + 2) % ring.size()]);
      convex = convex && (result.area > 0 ? way >= 0 : way <= 0);
    }
    CAPTURE(round, ring.size());
    REQUIRE(result.area == twice_ring_area(ring));
    REQUIRE(result.backwards == 0);
    if (!convex) REQUIRE(result.flat == 0);
  }
}

TEST_CASE("triangulate: polygons that cross themselves are covered as often as they wind", "[property]") {
  CAPTURE(seed());
  Random random(seed());
  for (std::uint64_t round = 0; round < samples(4'000 * kPolygonSamples) / kPolygonSamples; ++round) {
    Ring ring;
    for (std::size_t left = 4 + below(random, 30); left > 0; --left) {
      ring.push_back({kHalfPixel * random.between(0, 32), kHalfPixel * random.between(0, 32)});
    }
    const Triangulation result = triangulated(put_into_space(random, ring));
    CAPTURE(round, ring.size());
    REQUIRE(result.area == twice_ring_area(ring));
    REQUIRE(result.seamless);
    REQUIRE(coverage(result.triangles) == winding_numbers(ring));
  }
}

TEST_CASE("triangulate: the machine draws each pixel of a weakly simple polygon once", "[property]") {
  CAPTURE(seed());
  Random random(seed());
  constexpr int kSize = 256;
  constexpr int kAcross = kSize / kPolygonPixels;
  for (std::uint64_t left = samples(4 * kSize * kSize) / (kSize * kSize); left > 0; --left) {
    std::vector<glm::dvec3> window;
    std::vector<Ring> rings;
    for (int i = 0; i < kAcross * kAcross; ++i) {
      rings.push_back(weakly_simple_polygon(random));
      const GridPoint at{(i % kAcross) * kPolygonSide, (i / kAcross) * kPolygonSide};
      for (const GridTriangle& t : triangulated(put_into_space(random, rings.back())).triangles) {
        for (const GridPoint& p : t) {
          window.emplace_back(static_cast<double>(at.x + p.x) / (1 << kPolygonBits),
                              static_cast<double>(at.y + p.y) / (1 << kPolygonBits), 0.5);
        }
      }
    }
    FrameBuilder builder(kSize);
    builder.draw(window);
    for (std::size_t rule = 0; rule < kMachineRules.size(); ++rule) {
      halfspace::Config config;
      config.setup.fill_rule = kMachineRules[rule].first;
      const halfspace::FrameResult result = run_functional(builder.frame, config);
      for (int i = 0; i < kAcross * kAcross; ++i) {
        std::vector<int> fragments;
        fragments.reserve(kPolygonSamples);
        for (int pixel = 0; pixel < static_cast<int>(kPolygonSamples); ++pixel) {
          fragments.push_back(
              result.surfaces.at(0).fragments.at((i % kAcross) * kPolygonPixels + pixel % kPolygonPixels,
                                                 (i / kAcross) * kPolygonPixels + pixel / kPolygonPixels));
        }
        std::vector<int> expected =
            winding_numbers(rings[static_cast<std::size_t>(i)], kMachineRules[rule].second);
        for (int& n : expected) n = std::abs(n);
        CAPTURE(rule, i);
        REQUIRE(fragments == expected);
      }
    }
  }
}

namespace {

PolygonInSpace in_plane(const Ring& ring) {
  PolygonInSpace result;
  for (const GridPoint& p : ring) {
    result.polygon.push_back(static_cast<std::uint32_t>(result.positions.size()));
    result.points.push_back(p);
    result.positions.emplace_back(static_cast<double>(p.x), static_cast<double>(p.y), 0);
  }
  return result;
}

void check_large_polygons(std::size_t corners) {
  CAPTURE(seed(), corners);
  Random random(seed());
  constexpr std::int64_t kReach = std::int64_t{1} << 28;
  std::vector<Ring> rings{spiral(corners, kReach), comb(random, corners / 2 - 1, kHalfPixel, kReach)};
  rings.push_back(rings.back());
  for (GridPoint& p : rings.back()) p = {3 * p.x + p.y, 2 * p.y - p.x};  // slanting teeth
  Ring star;
  for (std::size_t i = 0; i < corners; ++i) {
    const double angle = 6.283185307179586 * static_cast<double>(i) / static_cast<double>(corners);
    const double radius = kReach / (i % 2 == 0 ? 1.0 : 2.0 + static_cast<double>(random.between(0, 8)));
    star.push_back({std::llround(radius * std::cos(angle)), std::llround(radius * std::sin(angle))});
  }
  rings.push_back(star);
  const auto cells = static_cast<std::size_t>(std::sqrt(static_cast<double>(corners)) / 2);
  for (std::size_t known = rings.size(); rings.size() < known + 4;) {
    const PlaneMap map = PlaneMap::random(random, cells);
    const Ring ring = with_other_corners(random, TreeOfFaces(random, map).boundary());
    if (ring.size() > corners / 4 && ring.size() <= corners) rings.push_back(ring);
  }
  for (const Ring& ring : rings) {
    const Triangulation result = triangulated(in_plane(ring));
    CAPTURE(ring.size());
    CHECK(result.area == twice_ring_area(ring));
    CHECK(result.seamless);
    CHECK(result.backwards == 0);
  }
}

}  // namespace

TEST_CASE("triangulate: polygons of 5,000 corners", "[property]") { check_large_polygons(5000); }

TEST_CASE("triangulate: polygons of as many corners as are legal", "[property][exhaustive]") {
  check_large_polygons(halfspace::kMaxConcaveCorners);
}

TEST_CASE("triangulate: discs that rounding made not quite convex", "[property]") {
  CAPTURE(seed());
  Random random(seed());
  const auto turn_of = [](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const auto exact = [](double x) { return mpq_class(x); };
    return mpq_class((exact(b.x) - exact(a.x)) * (exact(c.y) - exact(a.y)) -
                     (exact(c.x) - exact(a.x)) * (exact(b.y) - exact(a.y)));
  };
  int dented = 0;
  for (std::uint64_t round = 0; round < samples(1'000'000) / 5000; ++round) {
    const std::size_t corners = 4 + below(random, round % 20 == 0 ? 5000 : 100);
    const double radius =
        std::ldexp(static_cast<double>(random.between(1, 1000)), static_cast<int>(random.between(-50, 0)));
    const double x = static_cast<double>(random.between(0, 1000)),
                 y = static_cast<double>(random.between(0, 1000)) / 3;
    PolygonInSpace disc;
    for (std::size_t i = 0; i < corners; ++i) {
      const double angle = 6.283185307179586 * static_cast<double>(i) / static_cast<double>(corners);
      disc.polygon.push_back(static_cast<std::uint32_t>(i));
      disc.positions.emplace_back(x + radius * std::cos(angle), y + radius * std::sin(angle), 1);
    }
    std::vector<std::uint32_t> triangles;
    REQUIRE(halfspace::triangulate(disc.polygon, disc.positions, triangles));
    REQUIRE(triangles.size() == 3 * (corners - 2));
    const std::vector<glm::dvec3>& at = disc.positions;
    mpq_class of_triangles, of_disc;
    bool forwards = true, convex = true;
    for (std::size_t i = 0; i < triangles.size(); i += 3) {
      const mpq_class area = turn_of(at[triangles[i]], at[triangles[i + 1]], at[triangles[i + 2]]);
      forwards = forwards && area >= 0;
      of_triangles += area;
    }
    for (std::size_t i = 0; i < corners; ++i) {
      of_disc += turn_of(at[0], at[i], at[(i + 1) % corners]);
      convex = convex && turn_of(at[i], at[(i + 1) % corners], at[(i + 2) % corners]) >= 0;
    }
    CAPTURE(round, corners, radius, x, y);
    REQUIRE(of_triangles == of_disc);
    REQUIRE(forwards);
    REQUIRE(is_seamless(disc.polygon, triangles));
    dented += convex ? 0 : 1;
  }
  CHECK(dented > 0);
}
