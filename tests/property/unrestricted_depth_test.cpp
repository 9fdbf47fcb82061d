// Depth outside [0, 1] on float32 surfaces, as VK_EXT_depth_range_unrestricted and OpenGL's
// NV_depth_buffer_float define it: exact rational planes judge what is stored, and hi_z, late writes and
// tiles change nothing.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

#include "../result_difference.hpp"
#include "halfspace/core/functional.hpp"
#include "halfspace/machine/in_order.hpp"
#include "halfspace/reference/exact_depth.hpp"
#include "halfspace/reference/rasterizer.hpp"
#include "halfspace/scene/validate.hpp"
#include "halfspace/units/float_parts.hpp"
#include "hard_frames.hpp"

namespace halfspace::testing {
namespace {

constexpr float kLargestFloat = std::numeric_limits<float>::max();
constexpr int kTargetSide = 32;

/// A draw of one triangle that covers the target, with these depths before the depth range.
Frame whole_target(const std::array<double, 3>& z, const glm::vec2& range) {
  FrameBuilder builder(kTargetSide, DepthFormat::kFloat32);
  Command& draw = builder.draw({{0, 0, z[0]}, {2 * kTargetSide, 0, z[1]}, {0, 2 * kTargetSide, z[2]}});
  draw.depth_func = DepthFunc::kAlways;
  draw.depth_range = range;
  return builder.frame;
}

/// Every way to draw a frame without time.
std::vector<FrameResult> every_core(const Frame& frame) {
  validate(frame);
  std::vector<FrameResult> results;
  for (const DepthInterpolator interpolator : {DepthInterpolator::kPlane, DepthInterpolator::kBarycentric}) {
    for (const Core core : {Core::kFast, Core::kReadable}) {
      Config config;
      config.depth.interpolator = interpolator;
      results.push_back(run_functional(frame, config, {.core = core}));
    }
  }
  Config config;
  config.hi_z.enabled = true;
  config.z_cache.compression = true;
  config.tile_walker.tile_size = 16;
  results.push_back(run_functional(frame, config));
  return results;
}

/// All pixels of the surface hold `depth`.
bool holds(const FrameResult& result, float depth) {
  const Surface& surface = result.surfaces.at(0);
  bool same = true;
  for (int y = 0; y < surface.codes.height(); ++y) {
    for (int x = 0; x < surface.codes.width(); ++x) {
      same = same && depth_of_code(surface.format, surface.codes.at(x, y)) == depth;
    }
  }
  return same;
}

/// Units of the last place of a float32 at `exact` that `stored` is off, 2^-149 below the normal numbers.
double last_places_off(float stored, const mpq_class& exact) {
  const int exponent = exact == 0 ? -126 : std::max(std::ilogb(exact.get_d()), -126);
  const mpq_class ulp = reference::float_value(std::ldexp(1.0f, exponent - 23));
  return mpq_class(abs(reference::float_value(stored) - exact) / ulp).get_d();
}

}  // namespace

TEST_CASE("float32: a depth range of any size maps z to near + z (far - near)") {
  struct Case {
    double z;
    glm::vec2 range;
    float depth;
  };
  for (const Case& c :
       {Case{0.75, {-65536, 65536}, 32768}, Case{0.25, {-65536, 65536}, -32768},
        Case{0.5, {-65536, 65536}, 0}, Case{0.25, {65536, -65536}, 32768}, Case{0, {-2, 5}, -2},
        Case{1, {-2, 5}, 5}, Case{0.5, {7, 7}, 7}, Case{1, {0, kLargestFloat}, kLargestFloat},
        Case{0, {-kLargestFloat, kLargestFloat}, -kLargestFloat}, Case{0.5, {0, -0x1p-140f}, -0x1p-141f}}) {
    CAPTURE(c.z, c.depth);
    for (const FrameResult& result : every_core(whole_target({c.z, c.z, c.z}, c.range))) {
      CHECK(holds(result, c.depth));
    }
    const std::vector<reference::Surface> exact =
        reference::rasterize(whole_target({c.z, c.z, c.z}, c.range), {});
    CHECK(exact.at(0).depth == std::vector<float>(kTargetSide * kTargetSide, c.depth));
  }
}

TEST_CASE("float32: slanted triangles of unrestricted depth ranges are within a unit of the last place",
          "[property]") {
  Random random(seed());
  const auto depth = [&] { return static_cast<double>(random.between(0, 1 << 24)) / (1 << 24); };
  for (int n = 0; n < 60; ++n) {
    const auto end = [&] {
      const double sign = random.between(0, 1) == 0 ? 1 : -1;
      return static_cast<float>(std::ldexp(sign * (1 + depth()), static_cast<int>(random.between(-40, 100))));
    };
    const glm::vec2 range{end(), end()};
    const std::array<double, 3> z{depth(), depth(), depth()};
    CAPTURE(seed(), n, range.x, range.y, z[0], z[1], z[2]);
    const reference::GridTriangle grid{{{0, 0}, {2 * kTargetSide * 256, 0}, {0, 2 * kTargetSide * 256}}};
    std::array<mpq_class, 3> vertex;
    for (std::size_t i = 0; i < 3; ++i) {
      const double near = range.x;
      vertex[i] =
          reference::float_value(static_cast<float>(static_cast<float>(z[i]) * (range.y - near) + near));
    }
    const mpq_class largest =
        std::max({mpq_class(abs(vertex[0])), mpq_class(abs(vertex[1])), mpq_class(abs(vertex[2]))});
    for (const Core core : {Core::kFast, Core::kReadable}) {
      const FrameResult result = run_functional(whole_target(z, range), {}, {.core = core});
      for (int k = 0; k < 60; ++k) {
        const int x = static_cast<int>(random.between(0, kTargetSide - 1));
        const int y = static_cast<int>(random.between(0, kTargetSide - 1));
        const mpq_class exact = reference::exact_depth(grid, vertex, reference::pixel_centre(x, y, 8));
        const float stored = depth_of_code(DepthFormat::kFloat32, result.surfaces.at(0).codes.at(x, y));
        CAPTURE(x, y, stored, exact.get_d());
        REQUIRE(last_places_off(stored, exact) <= 0.6);  // docs/numerics.md: 0.59
      }
    }
    Config barycentric;
    barycentric.depth.interpolator = DepthInterpolator::kBarycentric;
    const FrameResult result = run_functional(whole_target(z, range), barycentric);
    for (int k = 0; k < 60; ++k) {
      const int x = static_cast<int>(random.between(0, kTargetSide - 1));
      const int y = static_cast<int>(random.between(0, kTargetSide - 1));
      const mpq_class exact = reference::exact_depth(grid, vertex, reference::pixel_centre(x, y, 8));
      const float stored = depth_of_code(DepthFormat::kFloat32, result.surfaces.at(0).codes.at(x, y));
      // Absolute where signs cancel: 1.51 2^-30 of the largest magnitude, and the rounding to a float.
      const mpq_class off = abs(reference::float_value(stored) - exact);
      REQUIRE(off <= largest * mpq_class(151, 100) / (1 << 30) + abs(exact) / (1 << 23));
    }
  }
}

TEST_CASE("float32: a sum beyond all numbers keeps its sign") {
  // 2^64 words of 2^(e - 63): 2^(e + 1).
  const Int128 sum = (Int128{1} << 64) - 1;
  for (const int exponent : {0, 100, 126, 127, 128, 129}) {
    CAPTURE(exponent);
    const std::int64_t above = code_order(code_of_word(sum, exponent));
    const std::int64_t below = code_order(code_of_word(-sum, exponent));
    CHECK(above == -below);
    const double value = std::ldexp(1.0, exponent + 1);
    CHECK((value > kLargestFloat
               ? above >= 0x7F800000
               : depth_of_code(DepthFormat::kFloat32, code_of_word(sum, exponent)) == value));
  }
}

TEST_CASE("float32: the depth test orders depths of any sign") {
  constexpr std::array kDepths{-kLargestFloat, -65536.0f, -1.0f, -0x1p-149f, 0.0f,
                               0x1p-149f,      0.5f,      1.0f,  2.0f,       kLargestFloat};
  for (const float stored : kDepths) {
    for (const float incoming : kDepths) {
      for (std::uint32_t func = 0; func < 8; ++func) {
        CAPTURE(stored, incoming, func);
        Frame frame = whole_target({0, 0, 0}, {incoming, incoming});
        frame.commands[0].clear_depth = stored;
        frame.commands[1].depth_func = static_cast<DepthFunc>(func);
        const std::array passes{false,
                                incoming<stored, incoming == stored, incoming <= stored, incoming> stored,
                                incoming != stored, incoming >= stored, true};
        for (const FrameResult& result : every_core(frame)) {
          REQUIRE(holds(result, passes[func] ? incoming : stored));
          REQUIRE(result.counters.early_z.survivors == (passes[func] ? kTargetSide * kTargetSide : 0));
        }
      }
    }
  }
}

TEST_CASE("float32: depth clamp and polygon offset keep to the depth range, or leave it, as the draw says") {
  const auto draw_with = [](double z, const glm::vec2& range, std::uint32_t flags, float units) {
    Frame frame = whole_target({z, z, z}, range);
    frame.commands[1].flags |= flags;
    frame.commands[1].offset_units = units;
    return frame;
  };
  constexpr std::uint32_t kOffset = bits({Flag::kPolygonOffset});
  constexpr std::uint32_t kClamp = bits({Flag::kDepthClamp});
  const auto all_hold = [](const Frame& frame, float depth) {
    for (const FrameResult& result : every_core(frame)) {
      CHECK(holds(result, depth));
    }
  };
  // z = -0.5 is behind the near plane, which only depth clamp leaves in.
  all_hold(draw_with(-0.5, {-8, 8}, kClamp, 0), -8);
  all_hold(draw_with(1.5, {-8, 8}, kClamp, 0), 8);
  all_hold(draw_with(-0.5, {-8, 8}, 0, 0), 1);  // clipped: the clear is left
  // A unit of a float32 at 2 is 2^-22.
  all_hold(draw_with(0, {2, 3}, kOffset, 1 << 22), 3);
  all_hold(draw_with(1, {-3, 2}, kOffset, 1 << 22), 3);           // beyond the range: nothing clamps it
  all_hold(draw_with(1, {-3, 2}, kOffset | kClamp, 1 << 22), 2);  // but depth clamp does
  all_hold(draw_with(0, {-2, 3}, kOffset | kClamp, -(1 << 22)), -2);
  all_hold(draw_with(1, {0, 0.5f}, kOffset, 1 << 26), 1);  // a range in [0, 1] keeps fragments there
}

TEST_CASE("clears outside [0, 1]: stored on float32 surfaces, clamped on unorm surfaces") {
  for (const auto& [depth, format, expected] :
       {std::tuple{-5.0f, DepthFormat::kFloat32, -5.0f}, std::tuple{1e30f, DepthFormat::kFloat32, 1e30f},
        std::tuple{-5.0f, DepthFormat::kUnorm24, 0.0f}, std::tuple{1e30f, DepthFormat::kUnorm24, 1.0f},
        std::tuple{-0.25f, DepthFormat::kUnorm16, 0.0f}, std::tuple{2.0f, DepthFormat::kUnorm16, 1.0f}}) {
    for (const bool fast_clear : {false, true}) {
      CAPTURE(depth, static_cast<int>(format), fast_clear);
      FrameBuilder builder(kTargetSide, format);
      builder.clear(depth);
      validate(builder.frame);
      Config config;
      config.z_cache.fast_clear = fast_clear;
      for (const Core core : {Core::kFast, Core::kReadable}) {
        CHECK(holds(run_functional(builder.frame, config, {.core = core}), expected));
      }
      const std::vector<reference::Surface> exact = reference::rasterize(builder.frame, {});
      CHECK(exact.at(0).depth == std::vector<float>(kTargetSide * kTargetSide, expected));
    }
  }
}

TEST_CASE("what skips work changes nothing of depths outside [0, 1]", "[property]") {
  Random random(seed() + 1);
  for (std::uint64_t run = 0; run < samples(1'000'000) / 2000; ++run) {
    CAPTURE(seed(), run);
    Config config = random_config(random);
    while (!config.hi_z.enabled) {
      config = random_config(random);
    }
    const Frame frame = unrestricted_frame(random);
    INFO(difference_from_default(config));
    const FrameResult with = run_in_order(frame, config, {.keep_visible = true}, nullptr);
    const bool unrestricted = std::ranges::any_of(frame.commands, [](const Command& command) {
      return command.is_unrestricted(DepthFormat::kFloat32);
    });
    if (unrestricted) {
      REQUIRE(with.counters.hi_z.tiles_rejected == 0);  // it does not look at such a surface
    }
    config.hi_z.enabled = false;
    config.z_cache.compression = !config.z_cache.compression;
    config.block_walker.trivial_reject = !config.block_walker.trivial_reject;
    REQUIRE(picture_difference(with, run_in_order(frame, config, {.keep_visible = true}, nullptr)) == "");
  }
}

}  // namespace halfspace::testing
