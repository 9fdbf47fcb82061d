// Supersampling and multisampling are two ways to the same samples: a frame of K x K as many pixels, on a
// grid as much coarser, has at its centres what the frame itself has at K x K samples a pixel.
#include "halfspace/scene/magnify.hpp"

#include <bit>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <string>
#include <vector>

#include "../timing/random_machine.hpp"
#include "halfspace/core/functional.hpp"
#include "halfspace/core/run_core.hpp"
#include "halfspace/numerics/error.hpp"
#include "random.hpp"

using namespace halfspace;
using namespace halfspace::testing;

namespace {

constexpr int kUnmagnified = 32;

/// Triangles with every kind of state that is by the pixel: scissor, part of a viewport, polygon offset.
Frame stateful_frame(Random& random) {
  FrameBuilder builder(kUnmagnified, DepthFormat::kUnorm24);
  builder.clear(0.75F).scissor = {.x = 3, .y = 1, .width = 20, .height = 25};
  builder.draw(random_triangles(random, kUnmagnified, 12)).depth_func = DepthFunc::kLess;
  Command& cut = builder.draw(random_triangles(random, kUnmagnified, 12));
  cut.scissor = {.x = 5, .y = 2, .width = 17, .height = 23};
  Command& moved = builder.draw(random_triangles(random, kUnmagnified, 12));
  moved.viewport = {4, 8, 16, 16};
  moved.flags |= bits({Flag::kPolygonOffset});
  moved.offset_factor = 2;
  moved.offset_units = 3;
  return builder.frame;
}

/// "x,y;...": the centres of K x K squares, row by row.
std::string square_pattern(int times) {
  std::string text;
  for (int y = 0; y < times; ++y) {
    for (int x = 0; x < times; ++x) {
      text += (text.empty() ? "" : ";") + std::to_string((2 * x + 1) * 8 / times) + "," +
              std::to_string((2 * y + 1) * 8 / times);
    }
  }
  return text;
}

}  // namespace

TEST_CASE("magnify: supersampling draws what as many samples a pixel do", "[property]") {
  const std::uint64_t first = seed();
  for (std::uint64_t n = 0; n < 30; ++n) {
    for (const int times : {2, 4}) {
      CAPTURE(first + n, times);
      Random random(first + n);
      const Frame frame = stateful_frame(random);
      Frame large = frame;
      magnify(large, times);
      CHECK(large.magnified == times);
      Config fine;
      set_config(fine, "raster.samples", std::to_string(times * times));
      set_config(fine, "raster.sample_positions", square_pattern(times));
      Config coarse;
      coarse.raster.sub_pixel_bits = 8 - std::countr_zero(static_cast<unsigned>(times));
      const FrameResult multi = run_functional(frame, fine, {.keep_visible = true});
      const FrameResult super = run_functional(large, coarse, {.keep_visible = true});
      int owned_otherwise = 0;
      for (int y = 0; y < kUnmagnified * times; ++y) {
        for (int x = 0; x < kUnmagnified * times; ++x) {
          const int sample = y % times * times + x % times;
          const Surface& a = multi.surfaces[0];
          const Surface& b = super.surfaces[0];
          REQUIRE(a.fragments.at(x / times, y / times, sample) == b.fragments.at(x, y));
          // Both planes are within a unit of the exact depth, the offset adds one.
          REQUIRE(std::abs(static_cast<std::int64_t>(a.codes.at(x / times, y / times, sample)) -
                           static_cast<std::int64_t>(b.codes.at(x, y))) <= 4);
          owned_otherwise += a.visible.at(x / times, y / times, sample) != b.visible.at(x, y) ? 1 : 0;
        }
      }
      CHECK(owned_otherwise < kUnmagnified * times);  // where two triangles cross
    }
  }
}

TEST_CASE("magnify: lines, stipples and points grow with the frame") {
  FrameBuilder builder(kUnmagnified);
  Command& lines = builder.draw({{1, 1, 0.5}, {9, 1, 0.5}, {1, 9, 0.5}});
  lines.polygon_mode = PolygonMode::kLine;
  lines.line_width = 1.5F;
  lines.stipple = {.factor = 3, .pattern = 0x0F0F};
  lines.point_size = 5;
  Frame large = builder.frame;
  magnify(large, 8);
  CHECK(large.commands.back().line_width == 12);
  CHECK(large.commands.back().stipple.factor == 24);
  CHECK(large.commands.back().point_size == 40);
  CHECK(large.targets[0].width == kUnmagnified * 8);
}

TEST_CASE("magnify: what would not be legal is refused by name") {
  FrameBuilder builder(kUnmagnified);
  Command& lines = builder.draw({{1, 1, 0.5}, {9, 1, 0.5}, {1, 9, 0.5}});
  lines.polygon_mode = PolygonMode::kLine;
  lines.line_width = 10;
  Frame wide = builder.frame;
  CHECK_THROWS_WITH(magnify(wide, 8),
                    "built: command 1.line_width is 80 when 8 times as large; legal: at most 64");
  Frame dashed = builder.frame;
  dashed.commands.back().line_width = 1;
  dashed.commands.back().stipple = {.factor = 100, .pattern = 1};
  CHECK_THROWS_WITH(magnify(dashed, 4), Catch::Contains("stipple.factor is 400"));
  Frame points = builder.frame;
  points.commands.back().polygon_mode = PolygonMode::kPoint;
  points.commands.back().point_size = 1000;
  CHECK_THROWS_WITH(magnify(points, 4), Catch::Contains("point_size is 4000"));
  Frame target = builder.frame;
  target.targets[0].height = 2000;
  CHECK_THROWS_WITH(magnify(target, 16), Catch::Contains("a side of target 0 is 32000") &&
                                             Catch::Contains("legal: at most 16384"));
  Frame far = builder.frame;
  far.commands.back().line_width = 1;
  far.commands.back().scissor = {.x = -2000000000, .y = 2000000000, .width = 2000000000, .height = 1};
  magnify(far, 2);  // saturates: such a scissor is nowhere near the target
  CHECK(far.commands.back().scissor.x == -2147483647 - 1);
  CHECK(far.commands.back().scissor.y == 2147483647);
}
