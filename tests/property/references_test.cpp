// The reference rasterizers against the definition in rational numbers, and against each other.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "../triangles.hpp"
#include "halfspace/reference/barycentric.hpp"
#include "halfspace/reference/clipped_triangle.hpp"
#include "halfspace/reference/exact.hpp"
#include "halfspace/reference/float_epsilon.hpp"
#include "halfspace/reference/incremental.hpp"
#include "halfspace/reference/methods.hpp"
#include "halfspace/reference/rational_coverage.hpp"
#include "halfspace/reference/scanline.hpp"
#include "random.hpp"

namespace halfspace::testing {
namespace {

namespace ref = reference;

struct NamedCoverage {
  const char* name;
  ref::CoverageMethod cover;
};

constexpr std::array<NamedCoverage, 4> kExactMethods = {{{"exact", ref::cover_exactly},
                                                         {"barycentric", ref::cover_barycentrically},
                                                         {"scanline", ref::cover_by_scanlines},
                                                         {"incremental", ref::cover_by_increments}}};

/// How often each pixel of a target of size x size is covered.
using Times = std::vector<int>;

void add_times(ref::CoverageMethod cover, const ref::GridTriangle& t, int size, ref::TieRule rule,
               int sub_pixel_bits, Times& times) {
  if (ref::twice_area(t[0], t[1], t[2]) == 0) return;  // pieces have area
  std::vector<ref::Fragment> fragments;
  ref::Piece piece;
  piece.grid = t;
  piece.subpixel_bits = sub_pixel_bits;
  piece.rule = rule;
  piece.bounds = ref::intersect(ref::bounding_box(t, sub_pixel_bits), {0, 0, size, size});
  cover(piece, fragments);
  for (const ref::Fragment& f : fragments) ++times.at(static_cast<std::size_t>(f.y * size + f.x));
}

Times times_covered(ref::CoverageMethod cover, const std::vector<ref::GridTriangle>& mesh, int size,
                    ref::TieRule rule, int sub_pixel_bits = 8) {
  Times times(static_cast<std::size_t>(size) * static_cast<std::size_t>(size), 0);
  for (const ref::GridTriangle& t : mesh) add_times(cover, t, size, rule, sub_pixel_bits, times);
  return times;
}

Times rational_times(const ref::GridTriangle& t, int size, ref::TieRule rule, int sub_pixel_bits) {
  const ref::RationalTriangle r = {ref::rational_point(t[0], sub_pixel_bits),
                                   ref::rational_point(t[1], sub_pixel_bits),
                                   ref::rational_point(t[2], sub_pixel_bits)};
  Times times;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const ref::RationalPoint sample = {mpq_class(2 * x + 1, 2), mpq_class(2 * y + 1, 2)};
      times.push_back(ref::rational_covers(r, sample, rule) ? 1 : 0);
    }
  }
  return times;
}

void check_all(const ref::GridTriangle& t, int size, int sub_pixel_bits) {
  for (const auto& [rule, rule_name] : ref::kTieRules) {
    const Times expected = rational_times(t, size, rule, sub_pixel_bits);
    for (const auto& [name, cover] : kExactMethods) {
      CAPTURE(rule_name, name, sub_pixel_bits, t[0].x, t[0].y, t[1].x, t[1].y, t[2].x, t[2].y);
      REQUIRE(times_covered(cover, {t}, size, rule, sub_pixel_bits) == expected);
    }
  }
}

/// A square of cells x cells squares of `cell` pixels, whose inner corners move by up to `jitter` units of
/// 1/256 pixel, less than a quarter of a cell, and which are cut in two by either diagonal. Without gap or
/// overlap.
std::vector<ref::GridTriangle> jittered_mesh(Random& random, int cells, int cell, int jitter) {
  std::vector<ref::GridPoint> corner;
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) {
      const bool inner = i > 0 && i < cells && j > 0 && j < cells;
      const int reach = inner ? jitter : 0;
      corner.push_back(
          {256 * cell * i + random.between(-reach, reach), 256 * cell * j + random.between(-reach, reach)});
    }
  }
  std::vector<ref::GridTriangle> mesh;
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      const auto at = [&](int x, int y) {
        return corner[static_cast<std::size_t>((j + y) * (cells + 1) + i + x)];
      };
      const bool rising = random.between(0, 1) == 1;
      mesh.push_back(rising ? ref::GridTriangle{at(0, 0), at(1, 0), at(0, 1)}
                            : ref::GridTriangle{at(0, 0), at(1, 0), at(1, 1)});
      mesh.push_back(rising ? ref::GridTriangle{at(1, 0), at(0, 1), at(1, 1)}
                            : ref::GridTriangle{at(0, 0), at(1, 1), at(0, 1)});
    }
  }
  return mesh;
}

/// A draw of one triangle over a target of `size` pixels square.
struct OneTriangle {
  Command command;
  ref::Options options;
  int size = 0;

  explicit OneTriangle(int pixels) : size(pixels) {
    command.viewport = {0, 0, static_cast<float>(size), static_cast<float>(size)};
    command.flags = static_cast<std::uint32_t>(Flag::kDepthTest);
  }

  [[nodiscard]] Times times(std::string_view method, const ref::ClipTriangle& t, ref::TieRule rule) const {
    const ref::DrawState state = {command, options, ref::Storage::kFloat32, {0, 0, size, size}, rule};
    Times times(static_cast<std::size_t>(size) * static_cast<std::size_t>(size), 0);
    for (const auto& piece : ref::method_of(method).draw(t, state).pieces) {
      for (const ref::Fragment& f : piece) ++times.at(static_cast<std::size_t>(f.y * size + f.x));
    }
    return times;
  }
};

/// A corner in clip space that lies at a position of the grid, with the given w, a power of two: no step is
/// rounded on targets whose size is a power of two.
ref::Corner corner_at(const ref::GridPoint& p, int size, double w) {
  ref::Corner v;
  v.x = (static_cast<double>(p.x) / 128 / size - 1) * w;
  v.y = (static_cast<double>(p.y) / 128 / size - 1) * w;
  v.z = 0.5 * w;
  v.w = w;
  return v;
}

/// How far a sample is from the nearest of the lines through the edges, in pixels.
double nearest_edge(const ref::GridTriangle& t, int x, int y) {
  double nearest = 1e9;
  const ref::GridPoint p = ref::pixel_centre(x, y, 8);
  for (std::size_t i = 0; i < 3; ++i) {
    const ref::GridPoint& a = t[i];
    const ref::GridPoint& b = t[(i + 1) % 3];
    const double length = std::hypot(static_cast<double>(b.x - a.x), static_cast<double>(b.y - a.y));
    nearest = std::min(nearest, std::abs(static_cast<double>(ref::twice_area(a, b, p))) / length / 256);
  }
  return nearest;
}

}  // namespace

TEST_CASE("exact references cover what rational numbers say, by every rule", "[property][references]") {
  CAPTURE(seed());
  const std::uint64_t rounds = samples(1'200'000) / 3000;
  for (const int sub_pixel_bits : {8, 4}) {
    constexpr int kSize = 12;
    TriangleSource source(seed(), kSize, sub_pixel_bits);
    for (std::uint64_t round = 0; round < rounds / 2; ++round)
      check_all(grid(source.next()), kSize, sub_pixel_bits);
  }
}

TEST_CASE("exact references cover adversarial triangles as rational numbers say", "[property][references]") {
  CAPTURE(seed());
  Random random(seed());
  constexpr int kSize = 6;
  const auto half_pixel = [&] { return 128 * random.between(-1, 2 * kSize + 1); };
  const auto any = [&] { return random.between(-256, 256 * (kSize + 1)); };
  const std::uint64_t rounds = samples(450'000) / 3000;
  for (std::uint64_t round = 0; round < rounds; ++round) {
    // Corners on samples and on pixel corners: edges run through samples, and some are level or upright.
    check_all({{{half_pixel(), half_pixel()}, {half_pixel(), half_pixel()}, {half_pixel(), half_pixel()}}},
              kSize, 8);
    // A needle: the third corner beside the line through the others.
    const ref::GridPoint a{any(), any()};
    const ref::GridPoint b{any(), any()};
    check_all({a, b, {(a.x + b.x) / 2 + random.between(-2, 2), (a.y + b.y) / 2 + random.between(-2, 2)}},
              kSize, 8);
    // Smaller than a pixel, around a sample.
    const ref::GridPoint centre =
        ref::pixel_centre(random.between(0, kSize - 1), random.between(0, kSize - 1), 8);
    const auto near = [&] {
      return ref::GridPoint{centre.x + random.between(-2, 2), centre.y + random.between(-2, 2)};
    };
    check_all({near(), near(), near()}, kSize, 8);
    // From one end of the guard band to the other, through the target.
    const std::int64_t far = 32767 * 256;
    check_all({{{-far, random.between(-far, far)}, {far, random.between(-far, far)}, {any(), any()}}}, kSize,
              8);
  }
}

TEST_CASE("exact references do not care for the order of vertices", "[property][references]") {
  CAPTURE(seed());
  TriangleSource source(seed(), 16, 8);
  for (int round = 0; round < 200; ++round) {
    const ref::GridTriangle t = grid(source.next());
    for (const auto& [rule, rule_name] : ref::kTieRules) {
      for (const auto& [name, cover] : kExactMethods) {
        const Times expected = times_covered(cover, {t}, 16, rule);
        std::array<std::size_t, 3> order = {0, 1, 2};
        while (std::next_permutation(order.begin(), order.end())) {
          CAPTURE(round, rule_name, name, order);
          REQUIRE(times_covered(cover, {{t[order[0]], t[order[1]], t[order[2]]}}, 16, rule) == expected);
        }
      }
    }
  }
}

TEST_CASE("exact references split an edge at a T-junction without a trace", "[property][references]") {
  CAPTURE(seed());
  Random random(seed());
  for (int round = 0; round < 200; ++round) {
    const auto any = [&] { return random.between(-512, 256 * 16); };
    const ref::GridPoint a{any(), any()};
    const ref::GridPoint half{random.between(-1024, 1024), random.between(-1024, 1024)};
    const ref::GridPoint middle{a.x + half.x, a.y + half.y};
    const ref::GridPoint b{middle.x + half.x, middle.y + half.y};
    const ref::GridPoint c{any(), any()};
    for (const auto& [rule, rule_name] : ref::kTieRules) {
      for (const auto& [name, cover] : kExactMethods) {
        CAPTURE(round, rule_name, name);
        REQUIRE(times_covered(cover, {{a, middle, c}, {middle, b, c}}, 16, rule) ==
                times_covered(cover, {{a, b, c}}, 16, rule));
      }
    }
  }
}

TEST_CASE("exact references cover each sample of a mesh once", "[property][references]") {
  CAPTURE(seed());
  Random random(seed());
  constexpr int kSize = 512;
  const std::vector<ref::GridTriangle> mesh = jittered_mesh(random, kSize / 8, 8, 500);
  for (const auto& [rule, rule_name] : ref::kTieRules) {
    for (const auto& [name, cover] : kExactMethods) {
      CAPTURE(rule_name, name);
      const Times times = times_covered(cover, mesh, kSize, rule);
      REQUIRE(std::all_of(times.begin(), times.end(), [](int n) { return n == 1; }));
    }
  }
}

TEST_CASE("float_epsilon leaves gaps in a mesh, and covers samples twice", "[property][references]") {
  CAPTURE(seed());
  Random random(seed());
  constexpr int kSize = 2048;  // its errors grow with the coordinates
  const std::vector<ref::GridTriangle> mesh = jittered_mesh(random, kSize / 8, 8, 500);
  for (const auto& [rule, rule_name] : ref::kTieRules) {
    const Times times = times_covered(ref::cover_with_epsilon, mesh, kSize, rule);
    const auto gaps = std::count(times.begin(), times.end(), 0);
    const auto doubles = std::count_if(times.begin(), times.end(), [](int n) { return n > 1; });
    CAPTURE(rule_name, gaps, doubles);
    CHECK(gaps > 0);
    CHECK(doubles > 0);
    CHECK(gaps + doubles < kSize * kSize / 1000);  // wrong, but no other picture
  }
}

TEST_CASE("homogeneous covers what exact does where no vertex is rounded, whatever w",
          "[property][references]") {
  CAPTURE(seed());
  constexpr int kSize = 16;
  const OneTriangle one(kSize);
  TriangleSource source(seed(), kSize, 8);
  for (int round = 0; round < 400; ++round) {
    const ref::GridTriangle t = grid(source.next());
    ref::ClipTriangle corners;
    for (std::size_t i = 0; i < 3; ++i)
      corners[i] = corner_at(t[i], kSize, std::ldexp(1.0, source.integer(-2, 2)));
    for (const auto& [rule, rule_name] : ref::kTieRules) {
      CAPTURE(round, rule_name, t[0].x, t[0].y, t[1].x, t[1].y, t[2].x, t[2].y);
      REQUIRE(one.times("homogeneous", corners, rule) == times_covered(ref::cover_exactly, {t}, kSize, rule));
    }
  }
}

TEST_CASE("homogeneous draws triangles that reach behind the eye as rational numbers say",
          "[property][references]") {
  CAPTURE(seed());
  Random random(seed());
  constexpr int kSize = 8;
  const OneTriangle one(kSize);
  int behind = 0;
  int drawn = 0;
  for (int round = 0; round < 300; ++round) {
    ref::ClipTriangle t;
    std::array<std::array<mpq_class, 3>, 3> v;  // position in the window times w
    for (std::size_t i = 0; i < 3; ++i) {
      const auto coordinate = [&] {
        return std::ldexp(static_cast<double>(random.between(-2000, 2000)), -9);
      };
      t[i].x = coordinate();
      t[i].y = coordinate();
      t[i].z = coordinate();
      t[i].w = coordinate() + 1;
      v[i] = {(mpq_class(t[i].x) + t[i].w) * kSize / 2, (mpq_class(t[i].y) + t[i].w) * kSize / 2,
              mpq_class(t[i].w)};
    }
    behind += std::any_of(t.begin(), t.end(), [](const ref::Corner& c) { return c.w <= 0; }) ? 1 : 0;
    // By Cramer's rule (x, y, 1) = sum of weight[i] v[i] / determinant: covered where all weights have its
    // sign.
    const auto determinant_of = [](const auto& a, const auto& b, const auto& c) -> mpq_class {
      return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
             a[2] * (b[0] * c[1] - b[1] * c[0]);
    };
    const mpq_class determinant = determinant_of(v[0], v[1], v[2]);
    Times expected;
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const std::array<mpq_class, 3> p = {mpq_class(2 * x + 1, 2), mpq_class(2 * y + 1, 2), 1};
        const std::array<mpq_class, 3> weight = {determinant_of(p, v[1], v[2]) / determinant,
                                                 determinant_of(v[0], p, v[2]) / determinant,
                                                 determinant_of(v[0], v[1], p) / determinant};
        // z / w, which the depth range 0 to 1 bounds.
        const mpq_class z = weight[0] * t[0].z + weight[1] * t[1].z + weight[2] * t[2].z;
        const bool inside = weight[0] > 0 && weight[1] > 0 && weight[2] > 0 && z >= 0 && z <= 1;
        expected.push_back(inside ? 1 : 0);
      }
    }
    drawn += std::accumulate(expected.begin(), expected.end(), 0) > 0 ? 1 : 0;
    CAPTURE(round);
    REQUIRE(one.times("homogeneous", t, ref::TieRule::kTopLeft) == expected);
  }
  CHECK(behind > 50);
  CHECK(drawn > 50);
}

TEST_CASE("clip_everything differs from exact only beside edges that snapping moved",
          "[property][references]") {
  CAPTURE(seed());
  constexpr int kSize = 16;
  const OneTriangle one(kSize);
  TriangleSource source(seed(), kSize, 8);
  for (int round = 0; round < 400; ++round) {
    const ref::GridTriangle t = grid(source.next());
    if (ref::twice_area(t[0], t[1], t[2]) == 0) continue;
    const ref::ClipTriangle corners = {corner_at(t[0], kSize, 1), corner_at(t[1], kSize, 1),
                                       corner_at(t[2], kSize, 1)};
    const bool whole = std::all_of(t.begin(), t.end(), [](const ref::GridPoint& p) {
      return p.x >= 0 && p.y >= 0 && p.x <= 256 * kSize && p.y <= 256 * kSize;
    });
    for (const auto& [rule, rule_name] : ref::kTieRules) {
      const Times clipped = one.times("clip_everything", corners, rule);
      const Times exactly = times_covered(ref::cover_exactly, {t}, kSize, rule);
      const auto may_differ = [&](std::size_t at) {
        // A cut moves by half a unit each way, and an edge between two cuts no farther.
        return !whole && nearest_edge(t, static_cast<int>(at) % kSize, static_cast<int>(at) / kSize) <=
                             std::sqrt(0.5) / 256;
      };
      std::size_t wrong = 0;
      for (std::size_t at = 0; at < clipped.size(); ++at) {
        wrong += clipped[at] != exactly[at] && !may_differ(at) ? 1 : 0;
      }
      CAPTURE(round, rule_name, whole);
      REQUIRE(wrong == 0);
    }
  }
}

}  // namespace halfspace::testing
