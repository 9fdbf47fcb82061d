// early_z: the eight functions, the write, and what a switched-off test does.
#include "halfspace/units/z_test.hpp"

#include <catch2/catch.hpp>

#include "../triangles.hpp"
#include "halfspace/units/quad_generator.hpp"

using namespace halfspace;
using namespace halfspace::testing;

namespace {

constexpr std::uint32_t kHere = 1000;

/// A triangle that covers tile (0, 0) at one constant depth code.
SetupTriangle flat_triangle(DepthFormat format) {
  const std::uint32_t z = format == DepthFormat::kFloat32 ? kHere : kHere << vertex_depth_fraction(format);
  SetupState state = open_state(64);
  state.depth_format = format;
  SetupTriangle out;
  REQUIRE(
      setup(
          {{ScreenVertex{-5000, -5000, z}, ScreenVertex{30000, -5000, z}, ScreenVertex{-5000, 30000, z}}, 0},
          state, out) == SetupVerdict::kDrawn);
  return out;
}

QuadBurst burst_of(const SetupTriangle& triangle, std::uint64_t mask) {
  Coverage coverage;
  coverage.e = {triangle.edge[1].c, triangle.edge[2].c};
  coverage.mask.word[0] = mask;
  return quad_generator<8>(coverage);
}

}  // namespace

TEST_CASE("early_z: passes and writes as the depth function says") {
  const DepthFormat format = GENERATE(DepthFormat::kUnorm16, DepthFormat::kUnorm24, DepthFormat::kFloat32);
  const bool write = GENERATE(false, true);
  const SetupTriangle triangle = flat_triangle(format);
  // never, less, equal, lequal, greater, notequal, gequal, always: does `incoming OP stored` hold?
  const bool if_less[] = {false, true, false, true, false, true, false, true};
  const bool if_equal[] = {false, false, true, true, false, false, true, true};
  const bool if_greater[] = {false, false, false, false, true, true, true, true};
  for (std::uint32_t func = 0; func < 8; ++func) {
    CAPTURE(func);
    std::array<std::uint32_t, 64> stored;
    for (std::size_t i = 0; i < 64; ++i) {
      stored[i] = kHere + 1 - static_cast<std::uint32_t>(i % 3);  // incoming is less, equal, greater in turn
    }
    const std::array<std::uint32_t, 64> before = stored;
    const EarlyZState state{.test = true,
                            .write = write,
                            .func = static_cast<DepthFunc>(func),
                            .format = format,
                            .interpolator = DepthInterpolator::kPlane,
                            .sub_pixel_bits = 8};
    const std::uint64_t covered = 0x00FF00FF0F0F0F0Full;
    TileCodes<8> codes{};
    const TileMask passed = z_test<8>(triangle, burst_of(triangle, covered), state, stored.data(), codes);
    for (int i = 0; i < 64; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const bool expected = (covered >> i & 1) != 0 && (i % 3 == 0   ? if_less
                                                        : i % 3 == 1 ? if_equal
                                                                     : if_greater)[func];
      REQUIRE((passed.word[0] >> i & 1) == expected);
      REQUIRE(stored[at] == (expected && write ? kHere : before[at]));
    }
  }
}

TEST_CASE("early_z: a test that is off passes everything and writes nothing") {
  const SetupTriangle triangle = flat_triangle(DepthFormat::kUnorm24);
  std::array<std::uint32_t, 64> stored{};
  TileCodes<8> codes{};
  const TileMask passed =
      z_test<8>(triangle, burst_of(triangle, 0xF0F0), EarlyZState{}, stored.data(), codes);
  CHECK(passed.word[0] == 0xF0F0);
  CHECK(stored == std::array<std::uint32_t, 64>{});
}
