// The yardstick of `bench speed`: does it draw what the units draw?
#include "halfspace/speed/scalar_loop.hpp"

#include <catch2/catch.hpp>
#include <string>

#include "../frames.hpp"
#include "../property/random.hpp"
#include "halfspace/core/functional.hpp"
#include "halfspace/scene/load.hpp"
#include "halfspace/scene/synthetic.hpp"

using namespace halfspace;
using namespace halfspace::testing;

namespace {

ScalarCounts count(const Frame& frame) { return ScalarLoop(frame, Config{}).count(); }

/// Single-precision planes turn the verdict on some fragments in a thousand at most.
void check_alike(const Frame& frame) {
  CAPTURE(frame.name);
  const Counters units = run_functional(frame, Config{}).counters;
  const ScalarCounts loop = count(frame);
  CHECK(loop.fragments == units.quad_generator.fragments);
  const auto survivors = static_cast<double>(units.early_z.survivors);
  CHECK(static_cast<double>(loop.survivors) == Approx(survivors).epsilon(1e-3));
}

}  // namespace

TEST_CASE("scalar loop: covers what the units cover, on every synthetic frame and in both formats",
          "[exhaustive]") {
  for (const SyntheticInfo& info : synthetic_frames()) {
    for (const DepthFormat format : {DepthFormat::kUnorm24, DepthFormat::kFloat32}) {
      check_alike(synthetic_frame(info.name, format));
    }
  }
}

TEST_CASE("scalar loop: covers what the units cover, on the frames that ship", "[exhaustive]") {
  for (const char* name : {"vkcube", "cc0_truck"}) {
    check_alike(load(HALFSPACE_SCENES "/" + std::string(name) + ".ptf.xz"));
  }
}

TEST_CASE("scalar loop: a shared edge belongs to one of its triangles, by either rule", "[property]") {
  Random random(seed());
  CAPTURE(seed());
  constexpr int kSide = 64;
  for (int i = 0; i < 200; ++i) {
    FrameBuilder builder(kSide);
    // Corners on whole and half pixels: many samples lie on edges.
    const double x = static_cast<double>(random.between(0, 2 * kSide)) / 2;
    const double y = static_cast<double>(random.between(0, 2 * kSide)) / 2;
    Command& draw = builder.draw({{0, 0, 0.5},
                                  {kSide, 0, 0.5},
                                  {x, y, 0.5},  //
                                  {kSide, 0, 0.5},
                                  {kSide, kSide, 0.5},
                                  {x, y, 0.5},  //
                                  {0, kSide, 0.5},
                                  {x, y, 0.5},
                                  {kSide, kSide, 0.5},
                                  {0, 0, 0.5},
                                  {x, y, 0.5},
                                  {0, kSide, 0.5}});
    draw.flags |= random.between(0, 1) == 0 ? 0 : bits({Flag::kBottomLeftRule});
    CHECK(count(builder.frame).fragments == kSide * kSide);
  }
}

TEST_CASE("scalar loop: culls, scissors, compares and writes as the draw says", "[property]") {
  Random random(seed());
  CAPTURE(seed());
  constexpr int kSide = 64;
  for (int i = 0; i < 300; ++i) {
    FrameBuilder builder(kSide, random.between(0, 1) == 0 ? DepthFormat::kUnorm24 : DepthFormat::kFloat32);
    for (int n = 0; n < 3; ++n) {
      std::vector<glm::dvec3> corners;
      for (int k = 0; k < 30; ++k) {
        // Depths that are flat, and far apart, so that rounding decides nothing.
        const double z = static_cast<double>(random.between(0, 16)) / 16;
        const double at = k % 3 == 0 ? z : corners.back().z;
        corners.emplace_back(static_cast<double>(random.between(-5000, 20000)) / 256,
                             static_cast<double>(random.between(-5000, 20000)) / 256, at);
      }
      Command& draw = builder.draw(corners);
      draw.depth_func = static_cast<DepthFunc>(random.between(0, 7));
      draw.scissor = {.x = static_cast<std::int32_t>(random.between(-9, 40)),
                      .y = static_cast<std::int32_t>(random.between(-9, 40)),
                      .width = static_cast<std::int32_t>(random.between(1, 80)),
                      .height = static_cast<std::int32_t>(random.between(1, 80))};
      for (const Flag flag : {Flag::kCullFront, Flag::kCullBack, Flag::kFrontPositiveArea, Flag::kDepthTest,
                              Flag::kDepthWrite, Flag::kBottomLeftRule, Flag::kDepthClamp}) {
        const std::uint32_t bit = bits({flag});
        draw.flags = random.between(0, 3) == 0 ? draw.flags ^ bit : draw.flags;
      }
    }
    Command& clear = builder.clear(0.3F);
    clear.scissor = {.x = 3, .y = 5, .width = static_cast<std::int32_t>(random.between(0, 70)), .height = 20};
    std::swap(builder.frame.commands[2], builder.frame.commands.back());
    const Counters units = run_functional(builder.frame, Config{}).counters;
    const ScalarCounts loop = count(builder.frame);
    REQUIRE(loop.fragments == units.quad_generator.fragments);
    REQUIRE(loop.survivors == units.early_z.survivors);
  }
}

TEST_CASE("scalar loop: drawing again after a clear gives the same") {
  const Frame frame = synthetic_frame("medium");
  ScalarLoop loop(frame, Config{});
  const std::uint64_t survivors = loop.count().survivors;
  CHECK(loop.draw() == 0);  // nothing is nearer than itself
  loop.clear();
  CHECK(loop.draw() == survivors);
}
