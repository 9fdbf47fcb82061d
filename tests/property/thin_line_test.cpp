// Thin lines: the pixels of the area that line_setup makes are those that the specifications name, one by
// one.
#include "halfspace/units/thin_line.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>
#include <vector>

#include "halfspace/reference/exact_line.hpp"
#include "random.hpp"

namespace halfspace::testing::thin_line_tests {
namespace {

using reference::PixelPlace;

std::int64_t value(const Edge& edge, std::int64_t x, std::int64_t y, int bits) {
  return edge.c + ((edge.a * x + edge.b * y) << bits);
}

bool covers(const ThinLine& line, const PixelPlace& p, int bits) {
  const std::int64_t column = line.x_major ? p.x : p.y;
  return column >= line.first && column <= line.last && value(line.edge[0], p.x, p.y, bits) >= 0 &&
         value(line.edge[1], p.x, p.y, bits) >= 0;
}

/// All pixels of a line, looked for around its rows, in the order in which it is drawn.
std::vector<PixelPlace> pixels_of(const ThinLine& line, int bits) {
  std::vector<PixelPlace> pixels;
  for (std::int64_t c = line.first; c <= line.last; ++c) {
    for (std::int64_t v = line.minor_first - 2; v <= line.minor_last + 2; ++v) {
      const PixelPlace p = line.x_major ? PixelPlace{c, v} : PixelPlace{v, c};
      if (covers(line, p, bits)) {
        CHECK((v >= line.minor_first && v <= line.minor_last));
        pixels.push_back(p);
      }
    }
  }
  if (!line.forward) {
    std::reverse(pixels.begin(), pixels.end());
  }
  return pixels;
}

reference::GridLine grid_line(const LinePoint& a, const LinePoint& b) { return {a.x, a.y, b.x, b.y}; }

bool judge(LineRule rule, const reference::GridLine& line, const PixelPlace& p, int bits) {
  return rule == LineRule::kBresenham ? reference::leaves_vulkan_diamond(line, p, bits)
                                      : reference::leaves_direct3d_diamond(line, p, bits);
}

/// Pixels of the box about both ends, and one more to each side, on which the judge and the unit differ.
int count_differences(LineRule rule, const LinePoint& a, const LinePoint& b, int bits) {
  const ThinLine line = thin_line(a, b, rule, 1, bits);
  const reference::GridLine judged = grid_line(a, b);
  int differences = 0;
  for (std::int64_t y = (std::min(a.y, b.y) >> bits) - 1; y <= (std::max(a.y, b.y) >> bits) + 1; ++y) {
    for (std::int64_t x = (std::min(a.x, b.x) >> bits) - 1; x <= (std::max(a.x, b.x) >> bits) + 1; ++x) {
      differences += covers(line, {x, y}, bits) != judge(rule, judged, {x, y}, bits) ? 1 : 0;
    }
  }
  return differences;
}

/// The same where the box has too many pixels: those of the line, and those beside them.
int count_differences_along(LineRule rule, const LinePoint& a, const LinePoint& b, int bits) {
  const ThinLine line = thin_line(a, b, rule, 1, bits);
  const reference::GridLine judged = grid_line(a, b);
  std::set<PixelPlace> near;
  for (const LinePoint& end : {a, b}) {
    for (int y = -2; y <= 2; ++y) {
      for (int x = -2; x <= 2; ++x) {
        near.insert({(end.x >> bits) + x, (end.y >> bits) + y});
      }
    }
  }
  for (const PixelPlace& p : pixels_of(line, bits)) {
    for (const PixelPlace& beside : {p, PixelPlace{p.x - 1, p.y}, PixelPlace{p.x + 1, p.y},
                                     PixelPlace{p.x, p.y - 1}, PixelPlace{p.x, p.y + 1}}) {
      near.insert(beside);
    }
  }
  return static_cast<int>(std::count_if(near.begin(), near.end(), [&](const PixelPlace& p) {
    return covers(line, p, bits) != judge(rule, judged, p, bits);
  }));
}

LinePoint random_point(Random& random, std::int64_t least, std::int64_t most, std::int64_t step) {
  return {static_cast<std::int32_t>(random.between(least / step, most / step) * step),
          static_cast<std::int32_t>(random.between(least / step, most / step) * step)};
}

constexpr std::array kDiamondRules{LineRule::kBresenham, LineRule::kDiamondExit};

}  // namespace

TEST_CASE(
    "thin lines: both diamond rules, on pairs of points of a grid of 1/16 pixel in a square of 4x4 pixels",
    "[property]") {
  // 64^4 = 16777216 pairs; HALFSPACE_SAMPLES of so many, or more, looks at all of them
  constexpr std::uint64_t kAll = std::uint64_t{1} << 24;
  const std::uint64_t wanted = std::min<std::uint64_t>(samples(60000), kAll);
  const std::uint64_t step = wanted == kAll ? 1 : (kAll / wanted) | 1;  // odd, so that all four digits vary
  for (const LineRule rule : kDiamondRules) {
    std::uint64_t differences = 0;
    for (std::uint64_t i = 0, n = 0; i < wanted; ++i, n = (n + step) % kAll) {
      const auto digit = [&](int at) { return static_cast<std::int32_t>(n >> (6 * at) & 63); };
      differences +=
          static_cast<std::uint64_t>(count_differences(rule, {digit(0), digit(1)}, {digit(2), digit(3)}, 4));
    }
    INFO(kLineRuleName[static_cast<std::size_t>(rule)]);
    CHECK(differences == 0);
    if (wanted == kAll) {
      WARN(kLineRuleName[static_cast<std::size_t>(rule)] << ": " << wanted << " pairs of points, "
                                                         << differences << " differences");
    }
  }
}

TEST_CASE("thin lines: both diamond rules, on random segments of all lengths and octants", "[property]") {
  CAPTURE(seed());
  Random random(seed());
  const std::uint64_t count = samples(60000);
  for (const LineRule rule : kDiamondRules) {
    std::uint64_t differences = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
      const int bits = static_cast<int>(random.between(4, 8));
      const std::int64_t step = std::int64_t{1} << random.between(0, bits - 1);  // many on corners and edges
      const std::int64_t reach = (std::int64_t{1} << bits) << random.between(0, 4);
      const LinePoint a = random_point(random, -reach, reach, step);
      const LinePoint b = random_point(random, -reach, reach, step);
      differences += static_cast<std::uint64_t>(reach >> bits > 4 ? count_differences_along(rule, a, b, bits)
                                                                  : count_differences(rule, a, b, bits));
    }
    INFO(kLineRuleName[static_cast<std::size_t>(rule)]);
    CHECK(differences == 0);
  }
}

TEST_CASE("thin lines: long ones, beyond every screen", "[property]") {
  CAPTURE(seed());
  Random random(seed() + 1);
  for (std::uint64_t i = 0; i < samples(60000) / 400; ++i) {
    const LinePoint a = random_point(random, -65536, 65536, 1);
    const LinePoint b = random_point(random, -65536, 65536, 1);
    for (const LineRule rule : kDiamondRules) {
      REQUIRE(count_differences_along(rule, a, b, 8) == 0);
    }
  }
}

TEST_CASE("thin lines: midpoint and DDA are the algorithms of the textbooks, pixel by pixel and in order",
          "[property]") {
  CAPTURE(seed());
  Random random(seed() + 2);
  for (std::uint64_t i = 0; i < samples(60000) / 10; ++i) {
    const int bits = static_cast<int>(random.between(4, 8));
    const std::int64_t reach = (std::int64_t{1} << bits) << random.between(0, 7);
    const LinePoint a = random_point(random, -reach, reach, 1);
    const LinePoint b = random_point(random, -reach, reach, 1);
    const PixelPlace from{a.x >> bits, a.y >> bits};
    const PixelPlace to{b.x >> bits, b.y >> bits};
    REQUIRE(pixels_of(thin_line(a, b, LineRule::kMidpoint, 1, bits), bits) ==
            reference::midpoint_line(from, to));
    REQUIRE(pixels_of(thin_line(a, b, LineRule::kDda, 1, bits), bits) ==
            reference::dda_line(from, to, kDdaFraction));
  }
}

TEST_CASE("thin lines: between pixel centres the diamond of Vulkan is Bresenham's line, but for ties",
          "[property]") {
  // "When p_a and p_b lie on fragment centers, this characterization of fragments reduces to Bresenham's
  // algorithm"
  int ties = 0;
  for (int x = -12; x <= 12; ++x) {
    for (int y = -12; y <= 12; ++y) {
      const LinePoint a{128, 128};
      const LinePoint b{x * 256 + 128, y * 256 + 128};
      const auto diamond = pixels_of(thin_line(a, b, LineRule::kBresenham, 1, 8), 8);
      const auto midpoint = pixels_of(thin_line(a, b, LineRule::kMidpoint, 1, 8), 8);
      REQUIRE(diamond.size() == midpoint.size());
      const int run = std::max(std::abs(x), std::abs(y));
      const int rise = std::min(std::abs(x), std::abs(y));
      for (std::size_t i = 0; i < diamond.size(); ++i) {
        const bool is_tie = 2 * (static_cast<int>(i) * rise % run) == run;
        ties += is_tie ? 1 : 0;
        REQUIRE((is_tie || diamond[i] == midpoint[i]));
      }
    }
  }
  CHECK(ties > 0);
}

TEST_CASE("thin lines: one fragment a column, and the width is that many", "[property]") {
  CAPTURE(seed());
  Random random(seed() + 3);
  for (std::uint64_t i = 0; i < samples(60000) / 20; ++i) {
    const int bits = static_cast<int>(random.between(4, 8));
    const std::int64_t reach = std::int64_t{40} << bits;
    const LinePoint a = random_point(random, -reach, reach, 1 << random.between(0, bits - 1));
    const LinePoint b = random_point(random, -reach, reach, 1 << random.between(0, bits - 1));
    const auto rule = static_cast<LineRule>(random.between(1, 4));
    const int width = static_cast<int>(random.between(1, 5));
    const ThinLine line = thin_line(a, b, rule, width, bits);
    REQUIRE(pixels_of(line, bits).size() == static_cast<std::size_t>(line.length() * width));
    if (rule == LineRule::kBresenham || rule == LineRule::kDiamondExit) {
      // "the segment with endpoints (x0, y0 - (w - 1)/2) and (x1, y1 - (w - 1)/2) is rasterized"; its
      // fragment is the lowest of a column
      const auto half = static_cast<std::int32_t>((width - 1) << (bits - 1));
      const auto moved = [&](const LinePoint& p) {
        return line.x_major ? LinePoint{p.x, p.y - half} : LinePoint{p.x - half, p.y};
      };
      std::vector<PixelPlace> wide;
      for (const PixelPlace& p : pixels_of(thin_line(moved(a), moved(b), rule, 1, bits), bits)) {
        for (int k = 0; k < width; ++k) {
          wide.push_back(line.x_major ? PixelPlace{p.x, p.y + k} : PixelPlace{p.x + k, p.y});
        }
      }
      auto pixels = pixels_of(line, bits);
      std::sort(pixels.begin(), pixels.end());
      std::sort(wide.begin(), wide.end());
      REQUIRE(pixels == wide);
    }
  }
}

TEST_CASE("thin lines: a line cut in two on its way has the same pixels, none twice", "[property]") {
  CAPTURE(seed());
  Random random(seed() + 4);
  for (std::uint64_t i = 0; i < samples(60000) / 20; ++i) {
    // the middle is on the line and on the grid
    const LinePoint a = random_point(random, -4096, 4096, 1);
    const LinePoint way = random_point(random, -700, 700, 1);
    const auto first = static_cast<std::int32_t>(random.between(1, 4));
    const auto second = static_cast<std::int32_t>(random.between(1, 4));
    const LinePoint middle{a.x + way.x * first, a.y + way.y * first};
    const LinePoint b{middle.x + way.x * second, middle.y + way.y * second};
    for (const LineRule rule : kDiamondRules) {
      std::vector<PixelPlace> joined = pixels_of(thin_line(a, middle, rule, 1, 8), 8);
      const auto rest = pixels_of(thin_line(middle, b, rule, 1, 8), 8);
      joined.insert(joined.end(), rest.begin(), rest.end());
      REQUIRE(joined == pixels_of(thin_line(a, b, rule, 1, 8), 8));
    }
  }
}

TEST_CASE("thin lines: Direct3D's examples of the diamond") {
  // corners and edges of the diamond of pixel (1, 1), whose centre is (1.5, 1.5), in 1/16 pixel
  const auto covered = [](LinePoint a, LinePoint b) {
    return covers(thin_line(a, b, LineRule::kDiamondExit, 1, 4), {1, 1}, 4);
  };
  CHECK(covered({24, 24}, {40, 24}));        // from the centre out
  CHECK_FALSE(covered({8, 24}, {24, 24}));   // ends inside
  CHECK(covered({0, 32}, {48, 32}));         // through the bottom corner
  CHECK_FALSE(covered({0, 16}, {48, 16}));   // through the top corner
  CHECK_FALSE(covered({32, 24}, {48, 24}));  // starts in the right corner, x-major
  CHECK(covered({32, 24}, {32, 48}));        // the same, y-major
  CHECK_FALSE(covered({16, 24}, {16, 48}));  // starts in the left corner
  CHECK(covered({28, 28}, {48, 28}));        // starts on the lower right edge
  CHECK_FALSE(covered({0, 20}, {28, 28}));   // ends on it
  CHECK_FALSE(covered({28, 20}, {48, 16}));  // starts on the upper right edge
  CHECK(thin_line({24, 24}, {24, 24}, LineRule::kDiamondExit, 1, 4).empty());
}

}  // namespace halfspace::testing::thin_line_tests
