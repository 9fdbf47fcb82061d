// Lines, points and triangles that others published, with what they expect of them: tests/published/.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <vector>

#include "../published/direct3d_rules.hpp"
#include "../published/khronos_lines.hpp"
#include "halfspace/core/functional.hpp"
#include "halfspace/reference/exact_line.hpp"
#include "halfspace/scene/frame_builder.hpp"
#include "halfspace/scene/validate.hpp"

namespace halfspace::testing::published_tests {
namespace {

using published::ClipPoint;
using published::kKhronosSide;
using reference::PixelPlace;

using Pixels = std::map<PixelPlace, int>;  ///< how often each is covered

/// The fragments of a draw, `change`d, of vertices in clip space.
template <class Change>
Pixels draw(const std::vector<ClipPoint>& vertices, const Change& change) {
  FrameBuilder builder(kKhronosSide);
  Command& command = builder.draw(std::vector<glm::dvec3>(vertices.size(), glm::dvec3(0, 0, 0)));
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    builder.frame.vertices[i] = {vertices[i].x, vertices[i].y, 0, 1};
  }
  command.depth_func = DepthFunc::kAlways;
  change(command);
  validate(builder.frame);
  const FrameResult result = run_functional(builder.frame, {}, {.count_pixels = true});
  Pixels pixels;
  const Surface& surface = result.surfaces.at(0);
  for (int y = 0; y < kKhronosSide; ++y) {
    for (int x = 0; x < kKhronosSide; ++x) {
      if (const int times = surface.fragments.at(x, y); times != 0) {
        pixels[{x, y}] = times;
      }
    }
  }
  return pixels;
}

/// In 1/256 pixel, as positions are snapped.
std::int64_t snapped(float clip) {
  return std::llrint((static_cast<double>(clip) + 1) / 2 * kKhronosSide * 256);
}

reference::GridLine grid_line(const ClipPoint& a, const ClipPoint& b) {
  return {snapped(a.x), snapped(a.y), snapped(b.x), snapped(b.y)};
}

/// By the definition, on the target.
template <class Leaves>
std::set<PixelPlace> diamonds_left(const reference::GridLine& line, const Leaves& leaves) {
  std::set<PixelPlace> pixels;
  for (int y = 0; y < kKhronosSide; ++y) {
    for (int x = 0; x < kKhronosSide; ++x) {
      if (leaves(line, PixelPlace{x, y}, 8)) {
        pixels.insert({x, y});
      }
    }
  }
  return pixels;
}

/// What Khronos asks of the fragments of a line of width 1.
void check_by_khronos(const Pixels& drawn, const std::set<PixelPlace>& ideal, bool x_major) {
  std::set<std::int64_t> columns;
  for (const auto& [pixel, times] : drawn) {
    CHECK(times == 1);
    CHECK(columns.insert(x_major ? pixel.x : pixel.y).second);
    CHECK(std::any_of(ideal.begin(), ideal.end(), [&pixel = pixel](const PixelPlace& p) {
      return std::abs(p.x - pixel.x) <= 1 && std::abs(p.y - pixel.y) <= 1;
    }));
  }
  CHECK(std::abs(static_cast<std::int64_t>(drawn.size()) - static_cast<std::int64_t>(ideal.size())) <= 1);
}

std::set<PixelPlace> places(const Pixels& pixels) {
  std::set<PixelPlace> all;
  for (const auto& [pixel, times] : pixels) {
    all.insert(pixel);
  }
  return all;
}

void check_line(const ClipPoint& a, const ClipPoint& b) {
  CAPTURE(a.x, a.y, b.x, b.y);
  const reference::GridLine line = grid_line(a, b);
  const bool x_major = std::abs(line.bx - line.ax) >= std::abs(line.by - line.ay);
  const auto with = [](LineRule rule) {
    return [rule](Command& command) {
      command.primitive = Primitive::kLines;
      command.line_rule = rule;
    };
  };
  const auto vulkan = diamonds_left(line, reference::leaves_vulkan_diamond);
  REQUIRE_FALSE(vulkan.empty());
  const Pixels bresenham = draw({a, b}, with(LineRule::kBresenham));
  CHECK(places(bresenham) == vulkan);
  CHECK(places(draw({a, b}, with(LineRule::kDiamondExit))) ==
        diamonds_left(line, reference::leaves_direct3d_diamond));
  for (const LineRule rule :
       {LineRule::kBresenham, LineRule::kDiamondExit, LineRule::kMidpoint, LineRule::kDda}) {
    INFO(kLineRuleName[static_cast<std::size_t>(rule)]);
    check_by_khronos(draw({a, b}, with(rule)), vulkan, x_major);
  }
}

}  // namespace

TEST_CASE("published: Khronos's lines, by its rule and exactly", "[property]") {
  for (const std::vector<ClipPoint>& list : published::kKhronosLines) {
    for (std::size_t i = 0; i < list.size(); i += 2) {
      check_line(list[i], list[i + 1]);
    }
  }
  for (const std::vector<ClipPoint>& strip : published::kKhronosStrips) {
    for (std::size_t i = 0; i + 1 < strip.size(); ++i) {
      check_line(strip[i], strip[i + 1]);
    }
  }
}

TEST_CASE("published: Khronos's lines of several widths have so many fragments in a column", "[property]") {
  for (const std::vector<ClipPoint>& list : published::kKhronosLines) {
    for (std::size_t i = 0; i < list.size(); i += 2) {
      const reference::GridLine line = grid_line(list[i], list[i + 1]);
      const bool x_major = std::abs(line.bx - line.ax) >= std::abs(line.by - line.ay);
      for (const int width : {2, 5}) {
        std::map<std::int64_t, int> in_column;
        std::set<std::int64_t> cut;  // columns that leave the target
        for (const auto& [pixel, times] : draw({list[i], list[i + 1]}, [&](Command& command) {
               command.primitive = Primitive::kLines;
               command.line_rule = LineRule::kBresenham;
               command.line_width = static_cast<float>(width);
             })) {
          const std::int64_t column = x_major ? pixel.x : pixel.y;
          const std::int64_t row = x_major ? pixel.y : pixel.x;
          in_column[column] += times;
          if (row == 0 || row == kKhronosSide - 1) {
            cut.insert(column);
          }
        }
        CHECK_FALSE(in_column.empty());
        for (const auto& [column, count] : in_column) {
          CAPTURE(i, width, column);
          CHECK((count == width || (cut.contains(column) && count < width)));
        }
      }
    }
  }
}

TEST_CASE("published: Khronos's points have the fragments whose centres are in their squares", "[property]") {
  for (const std::vector<ClipPoint>& list : published::kKhronosPoints) {
    for (const int size : {1, 10}) {
      Pixels expected;
      for (const ClipPoint& point : list) {
        const bool is_clipped = std::abs(point.x) > 1 || std::abs(point.y) > 1;
        for (int y = 0; y < kKhronosSide && !is_clipped; ++y) {
          for (int x = 0; x < kKhronosSide; ++x) {
            // from the middle of the square to the centre, in 1/256 pixel; top and left sides are in
            const std::int64_t dx = x * 256 + 128 - snapped(point.x);
            const std::int64_t dy = y * 256 + 128 - snapped(point.y);
            const auto is_in = [&](std::int64_t d) { return d >= -size * 128 && d < size * 128; };
            if (is_in(dx) && is_in(dy)) {
              ++expected[{x, y}];
            }
          }
        }
      }
      const Pixels drawn = draw(list, [&](Command& command) {
        command.primitive = Primitive::kPoints;
        command.point_size = static_cast<float>(size);
      });
      CHECK(drawn == expected);
    }
  }
}

TEST_CASE("published: a point in the middle is as wide and high as its size, rounded", "[property]") {
  for (const float size : {1.0F, 2.0F, 7.6F, 8.3F, 31.0F, 200.0F}) {
    const Pixels drawn = draw({published::kKhronosMiddle}, [&](Command& command) {
      command.primitive = Primitive::kPoints;
      command.point_size = size;
    });
    std::set<std::int64_t> columns;
    std::set<std::int64_t> rows;
    for (const auto& [pixel, times] : drawn) {
      columns.insert(pixel.x);
      rows.insert(pixel.y);
    }
    CAPTURE(size);
    CHECK(static_cast<long>(columns.size()) == std::lround(size));
    CHECK(columns.size() == rows.size());
    CHECK(drawn.size() == columns.size() * rows.size());
  }
}

namespace {

/// A triangle of Direct3D's documentation, whose pixels have their centres at whole coordinates.
Pixels direct3d_triangle(const std::array<std::array<double, 2>, 3>& corner) {
  std::vector<ClipPoint> clip;
  for (const auto& [x, y] : corner) {
    clip.push_back({static_cast<float>((x + 0.5) * 2 / kKhronosSide - 1),
                    static_cast<float>((y + 0.5) * 2 / kKhronosSide - 1)});
  }
  return draw(clip, [](Command& /*command*/) {});
}

}  // namespace

TEST_CASE("published: Direct3D's triangles and rectangles have the pixels that it counts") {
  for (const auto& [corner, pixels] : published::kDirect3DTriangles) {
    CHECK(static_cast<int>(direct3d_triangle(corner).size()) == pixels);
  }
  for (const auto& [from, to, first, last] : published::kDirect3DRectangles) {
    Pixels drawn = direct3d_triangle({{{from[0], from[1]}, {to[0], from[1]}, {to[0], to[1]}}});
    for (const auto& [pixel, times] :
         direct3d_triangle({{{from[0], to[1]}, {from[0], from[1]}, {to[0], to[1]}}})) {
      drawn[pixel] += times;
    }
    Pixels expected;
    for (int y = first[1]; y <= last[1]; ++y) {
      for (int x = first[0]; x <= last[0]; ++x) {
        expected[{x, y}] = 1;
      }
    }
    CHECK(drawn == expected);
  }
}

}  // namespace halfspace::testing::published_tests
