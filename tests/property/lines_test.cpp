// Lines and points of whole draws: coverage by the definitions, pixel by pixel, and depth by exact rationals.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "../line_frames.hpp"
#include "../result_difference.hpp"
#include "halfspace/core/functional.hpp"
#include "halfspace/fast/fast_core.hpp"
#include "halfspace/machine/in_order.hpp"
#include "halfspace/reference/exact_depth.hpp"
#include "halfspace/reference/exact_line.hpp"
#include "halfspace/scene/validate.hpp"
#include "halfspace/units/line_rectangle.hpp"
#include "halfspace/units/line_setup.hpp"

namespace halfspace::testing::line_tests {
namespace {

using reference::PixelPlace;

constexpr int kSide = 32;

__extension__ using Wide = __int128;

/// A point in 1/256 pixel.
struct Place {
  std::int64_t x = 0;
  std::int64_t y = 0;
};

Place any_place(Random& random, std::int64_t grid) {
  return {random.between(-4 * 256, (kSide + 4) * 256) / grid * grid,
          random.between(-4 * 256, (kSide + 4) * 256) / grid * grid};
}

glm::dvec3 window(const Place& p, double z = 0.5) {
  return {static_cast<double>(p.x) / 256, static_cast<double>(p.y) / 256, z};
}

/// How often each pixel of a draw alone is covered.
template <class Change>
FrameResult run_draw(const std::vector<glm::dvec3>& vertices, const Change& change,
                     DepthFormat format = DepthFormat::kUnorm24) {
  FrameBuilder builder(kSide, format);
  Command& draw = builder.draw(vertices);
  draw.depth_func = DepthFunc::kAlways;
  change(draw);
  validate(builder.frame);
  return run_functional(builder.frame, {}, {.count_pixels = true});
}

/// The side of the line through p and q on which a sample lies, samples on it being moved by (e, e^2): to the
/// right and down, as the top-left rule has it.
int side_of(const Place& p, const Place& q, const Place& sample) {
  const std::int64_t value = (q.x - p.x) * (sample.y - p.y) - (q.y - p.y) * (sample.x - p.x);
  const std::int64_t moved = value != 0 ? value : q.y != p.y ? p.y - q.y : q.x - p.x;
  return moved > 0 ? 1 : moved < 0 ? -1 : 0;
}

bool in_parallelogram(const std::array<Place, 4>& corner, const Place& sample) {
  int sum = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    sum += side_of(corner[i], corner[(i + 1) % 4], sample);
  }
  return std::abs(sum) == 4;
}

/// Whether `offset` is width d / (2 length) rounded to the nearest, from the inequality that says so:
/// (2 |offset| - 1) length <= width |d| < (2 |offset| + 1) length.
bool is_rounded(std::int64_t offset, std::int64_t width, std::int64_t d, Wide square_of_length) {
  const Wide n = Wide{width} * std::abs(d);
  const Wide k = 2 * std::abs(offset);
  return (offset == 0 || (offset > 0) == (d > 0)) &&
         (k == 0 || (k - 1) * (k - 1) * square_of_length <= n * n) &&
         n * n < (k + 1) * (k + 1) * square_of_length;
}

}  // namespace

TEST_CASE("lines: corners of rectangles are the nearest points of the grid", "[property]") {
  CAPTURE(seed());
  Random random(seed());
  for (std::uint64_t i = 0; i < samples(200000); ++i) {
    const std::int64_t reach = std::int64_t{1} << random.between(1, 23);
    const auto any = [&] { return static_cast<std::int32_t>(random.between(-reach, reach)); };
    const LinePoint a{any(), any()};
    const LinePoint b{any(), any()};
    if (a == b) {
      continue;
    }
    const std::int64_t width = random.between(1, kMaxLineWidth * 256);
    const LinePoint side = rectangle_offset(a, b, width);
    const std::int64_t dx = std::int64_t{b.x} - a.x;
    const std::int64_t dy = std::int64_t{b.y} - a.y;
    const Wide square = Wide{dx} * dx + Wide{dy} * dy;
    REQUIRE(is_rounded(side.x, width, -dy, square));
    REQUIRE(is_rounded(side.y, width, dx, square));
  }
}

TEST_CASE("lines: a rectangular line covers the samples in its rectangle, each once", "[property]") {
  CAPTURE(seed());
  Random random(seed() + 1);
  for (std::uint64_t run = 0; run < samples(200000) / 100; ++run) {
    const std::int64_t grid = pick(random, {1, 64, 128, 256});
    const Place a = any_place(random, grid);
    const Place b = any_place(random, grid);
    const auto width = static_cast<float>(random.between(1, 8 * 256)) / 256;
    const FrameResult result = run_draw({window(a), window(b)}, [&](Command& draw) {
      draw.primitive = Primitive::kLines;
      draw.line_width = width;
    });
    LinePoint side;
    if (a.x != b.x || a.y != b.y) {
      side = rectangle_offset({static_cast<std::int32_t>(a.x), static_cast<std::int32_t>(a.y)},
                              {static_cast<std::int32_t>(b.x), static_cast<std::int32_t>(b.y)},
                              std::lrint(width * 256));
    }
    const std::array<Place, 4> corner{{{a.x + side.x, a.y + side.y},
                                       {b.x + side.x, b.y + side.y},
                                       {b.x - side.x, b.y - side.y},
                                       {a.x - side.x, a.y - side.y}}};
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const int expected = in_parallelogram(corner, {x * 256 + 128, y * 256 + 128}) ? 1 : 0;
        if (result.surfaces[0].fragments.at(x, y) != expected) {
          FAIL_CHECK("(" << a.x << ", " << a.y << ") to (" << b.x << ", " << b.y << "), width " << width
                         << ": (" << x << ", " << y << ") is covered "
                         << result.surfaces[0].fragments.at(x, y) << " times");
        }
      }
    }
  }
}

TEST_CASE("lines: a point covers the samples in its square, by every fill rule", "[property]") {
  CAPTURE(seed());
  Random random(seed() + 2);
  for (std::uint64_t run = 0; run < samples(200000) / 100; ++run) {
    const Place at = any_place(random, pick(random, {1, 64, 128}));
    const std::int64_t size = random.between(1, 10 * 256) / pick(random, {1, 128}) * pick(random, {1, 128});
    if (size == 0) {
      continue;
    }
    const bool bottom = random.between(0, 1) == 0;
    const FrameResult result = run_draw({window(at)}, [&](Command& draw) {
      draw.primitive = Primitive::kPoints;
      draw.point_size = std::min(static_cast<float>(size) / 256, static_cast<float>(kMaxPointSize));
      draw.flags |= bottom ? bits({Flag::kBottomLeftRule}) : 0;
    });
    const auto in_side = [&](std::int64_t centre, std::int64_t middle, bool upper) {
      const std::int64_t off = 2 * (centre - middle);  // -size <= off < size, or -size < off <= size
      return upper ? off > -size && off <= size : off >= -size && off < size;
    };
    const bool in_volume = at.x >= 0 && at.x <= kSide * 256 && at.y >= 0 && at.y <= kSide * 256;
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const bool covered =
            in_volume && in_side(x * 256 + 128, at.x, false) && in_side(y * 256 + 128, at.y, bottom);
        if (result.surfaces[0].fragments.at(x, y) != (covered ? 1 : 0)) {
          FAIL_CHECK("(" << at.x << ", " << at.y << "), size " << size << ": (" << x << ", " << y << ")");
        }
      }
    }
  }
}

TEST_CASE("lines: a strip of thin lines has the fragments of its lines by the specification, stippled too",
          "[property]") {
  CAPTURE(seed());
  Random random(seed() + 3);
  for (std::uint64_t run = 0; run < samples(200000) / 1000; ++run) {
    const LineRule rule = pick(random, {LineRule::kBresenham, LineRule::kDiamondExit});
    LineStipple stipple;
    if (random.between(0, 1) == 0) {
      stipple = {.factor = static_cast<std::uint16_t>(random.between(1, 4)),
                 .pattern = static_cast<std::uint16_t>(random.between(0, 0xFFFF))};
    }
    const auto count = random.between(2, 6);
    std::vector<Place> place;
    for (int i = 0; i < count; ++i) {
      place.push_back(any_place(random, pick(random, {1, 32, 128})));
    }
    std::vector<glm::dvec3> vertices;
    std::array<std::array<int, kSide>, kSide> expected{};
    std::uint64_t counter = 0;
    for (std::size_t i = 0; i + 1 < place.size(); ++i) {
      const Place& a = place[i];
      const Place& b = place[i + 1];
      vertices.push_back(window(a));
      vertices.push_back(window(b));
      // All fragments of the line, on the screen or not, in order of the major axis.
      std::vector<PixelPlace> fragments;
      for (std::int64_t y = -6; y < kSide + 6; ++y) {
        for (std::int64_t x = -6; x < kSide + 6; ++x) {
          const reference::GridLine line{a.x, a.y, b.x, b.y};
          if (rule == LineRule::kBresenham ? reference::leaves_vulkan_diamond(line, {x, y}, 8)
                                           : reference::leaves_direct3d_diamond(line, {x, y}, 8)) {
            fragments.push_back({x, y});
          }
        }
      }
      const bool x_major = std::abs(b.x - a.x) >= std::abs(b.y - a.y);
      const bool forward = x_major ? b.x > a.x : b.y > a.y;
      std::sort(fragments.begin(), fragments.end(), [&](const PixelPlace& l, const PixelPlace& r) {
        return ((x_major ? l.x : l.y) < (x_major ? r.x : r.y)) == forward && l != r;
      });
      for (const PixelPlace& p : fragments) {
        const bool drawn = (stipple.pattern >> (counter / stipple.factor % 16) & 1) != 0;
        ++counter;
        if (drawn && p.x >= 0 && p.x < kSide && p.y >= 0 && p.y < kSide) {
          ++expected[static_cast<std::size_t>(p.y)][static_cast<std::size_t>(p.x)];
        }
      }
    }
    FrameBuilder builder(kSide);
    Command& draw = builder.draw(vertices);
    draw.depth_func = DepthFunc::kAlways;
    draw.primitive = Primitive::kLineStrip;
    draw.line_rule = rule;
    draw.stipple = stipple;
    for (std::uint32_t i = 2; i < draw.index_count; i += 2) {
      builder.frame.indices[i] = builder.frame.indices[i - 1];
    }
    validate(builder.frame);
    const FrameResult result = run_functional(builder.frame, {}, {.count_pixels = true});
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        CAPTURE(x, y, run);
        REQUIRE(result.surfaces[0].fragments.at(x, y) ==
                expected[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)]);
      }
    }
  }
}

TEST_CASE("lines: depth of thin lines is that of the line at the column, within the bounds of triangles",
          "[property]") {
  CAPTURE(seed());
  Random random(seed() + 4);
  for (std::uint64_t run = 0; run < samples(200000) / 400; ++run) {
    const int bits = pick(random, {16, 24});
    const DepthFormat format = bits == 16 ? DepthFormat::kUnorm16 : DepthFormat::kUnorm24;
    const Place a = any_place(random, 1);
    const Place b = any_place(random, 1);
    const auto any_depth = [&] { return static_cast<float>(random.between(0, 1 << 24)) / (1 << 24); };
    const float z0 = any_depth();
    const float z1 = any_depth();
    const LineRule rule = static_cast<LineRule>(random.between(1, 4));
    const FrameResult result = run_draw(
        {window(a, z0), window(b, z1)},
        [&](Command& draw) {
          draw.primitive = Primitive::kLines;
          draw.line_rule = rule;
          draw.line_width = static_cast<float>(random.between(1, 3));
        },
        format);
    const bool x_major =
        thin_line({static_cast<std::int32_t>(a.x), static_cast<std::int32_t>(a.y)},
                  {static_cast<std::int32_t>(b.x), static_cast<std::int32_t>(b.y)}, rule, 1, 8)
            .x_major;
    const std::int64_t from = x_major ? a.x : a.y;
    const std::int64_t to = x_major ? b.x : b.y;
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        if (result.surfaces[0].fragments.at(x, y) == 0) {
          continue;
        }
        mpq_class way((x_major ? x : y) * 256 + 128 - from, to - from);
        way.canonicalize();
        way = way < 0 ? mpq_class(0) : way > 1 ? mpq_class(1) : way;
        const mpq_class exact =
            reference::float_value(z0) + way * (reference::float_value(z1) - reference::float_value(z0));
        CAPTURE(x, y, z0, z1, a.x, a.y, b.x, b.y);
        // 0.668 and 0.501 codes (docs/numerics.md), and half a unit of a vertex depth
        REQUIRE(reference::ulps_off_unorm(result.surfaces[0].codes.at(x, y), exact, bits) <=
                (bits == 24 ? mpq_class(672, 1000) : mpq_class(502, 1000)));
      }
    }
  }
}

TEST_CASE(
    "lines: depth of rectangular lines and points is that of their ends, within the bounds of triangles",
    "[property]") {
  CAPTURE(seed());
  Random random(seed() + 5);
  for (std::uint64_t run = 0; run < samples(200000) / 400; ++run) {
    const Place a = any_place(random, 1);
    const Place b = any_place(random, 1);
    const auto any_depth = [&] { return static_cast<float>(random.between(0, 1 << 24)) / (1 << 24); };
    const float z0 = any_depth();
    const float z1 = any_depth();
    const bool points = random.between(0, 2) == 0;
    const FrameResult result = points ? run_draw({window(a, z0)},
                                                 [](Command& draw) {
                                                   draw.primitive = Primitive::kPoints;
                                                   draw.point_size = 5;
                                                 })
                                      : run_draw({window(a, z0), window(b, z1)}, [](Command& draw) {
                                          draw.primitive = Primitive::kLines;
                                          draw.line_width = 4;
                                        });
    LinePoint side;
    if (!points && (a.x != b.x || a.y != b.y)) {
      side = rectangle_offset({static_cast<std::int32_t>(a.x), static_cast<std::int32_t>(a.y)},
                              {static_cast<std::int32_t>(b.x), static_cast<std::int32_t>(b.y)}, 1024);
    }
    const reference::GridTriangle plane{
        {{a.x + side.x, a.y + side.y}, {b.x + side.x, b.y + side.y}, {b.x - side.x, b.y - side.y}}};
    const std::array<mpq_class, 3> z{reference::float_value(z0), reference::float_value(z1),
                                     reference::float_value(z1)};
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        if (result.surfaces[0].fragments.at(x, y) == 0) {
          continue;
        }
        const mpq_class exact =
            points ? z[0] : reference::exact_depth(plane, z, {x * 256 + 128, y * 256 + 128});
        CAPTURE(x, y, z0, z1, a.x, a.y, b.x, b.y, points);
        REQUIRE(reference::ulps_off_unorm(result.surfaces[0].codes.at(x, y), exact, 24) <=
                mpq_class(672, 1000));
      }
    }
  }
}

TEST_CASE("lines: the fast core draws what the units draw", "[property]") {
  Random random(seed() + 6);
  for (std::uint64_t run = 0; run < samples(200000) / 200; ++run) {
    CAPTURE(seed(), run);
    Config config = random_config(random);
    while (!fast::gap(config, {}, nullptr).empty()) {
      config = random_config(random);
    }
    const Frame frame = random_lines(random, takes_thin_lines(config));
    validate(frame);
    const Watch watch{.keep_visible = true,
                      .count_pixels = random.between(0, 1) == 0,
                      .threads = pick(random, {1, 1, 2, 3})};
    fast::FastCore core(config, watch);
    core.run(frame);
    REQUIRE(result_difference(core.take(), run_in_order(frame, config, watch, nullptr)) == "");
  }
}

TEST_CASE("lines: what thin lines cannot have is refused by name") {
  FrameBuilder builder(kSide);
  Command& draw = builder.draw({{1, 1, 0}, {20, 9, 0}});
  draw.primitive = Primitive::kLines;
  draw.line_rule = LineRule::kDiamondExit;
  Config config;
  config.depth.interpolator = DepthInterpolator::kBarycentric;
  CHECK_THROWS_WITH(
      run_functional(builder.frame, config, {}),
      "built: command 1 draws lines by the rule diamond_exit, and depth.interpolator is barycentric; "
      "legal with it: plane");
}

TEST_CASE("lines: polygon mode draws the sides of faces that are not culled, and their corners") {
  const std::vector<glm::dvec3> faces{{2, 2, 0.5},   {20, 2, 0.5},  {2, 20, 0.5},  // clockwise: positive
                                      {30, 30, 0.5}, {12, 30, 0.5}, {30, 12, 0.5}};
  const auto fragments = [&](PolygonMode mode, std::uint32_t flags) {
    const FrameResult result = run_draw(faces, [&](Command& draw) {
      draw.polygon_mode = mode;
      draw.line_rule = LineRule::kDiamondExit;
      draw.flags |= flags;
    });
    return result.counters.quad_generator.fragments;
  };
  // horizontal, vertical and diagonal sides of 18 pixels, each as many fragments as it has columns or rows
  CHECK(fragments(PolygonMode::kLine, 0) == 2 * 3 * 18);
  CHECK(fragments(PolygonMode::kLine, bits({Flag::kCullBack})) == 0 + 2 * 3 * 18);
  CHECK(fragments(PolygonMode::kLine, bits({Flag::kCullFront})) == 0);
  CHECK(fragments(PolygonMode::kPoint, 0) == 2 * 3);
}

}  // namespace halfspace::testing::line_tests
