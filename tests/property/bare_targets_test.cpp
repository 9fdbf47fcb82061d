// A target without depth is drawn to like one whose depth nobody tests.
#include <catch2/catch.hpp>

#include "../result_difference.hpp"
#include "halfspace/core/functional.hpp"
#include "halfspace/machine/surfaces.hpp"
#include "hard_frames.hpp"

namespace halfspace::testing {
namespace {

/// The frame with a depth surface on each target without one, on which no draw tests depth.
Frame with_depth(Frame frame) {
  std::vector<bool> bare;
  for (Target& target : frame.targets) {
    bare.push_back(target.depth_surface == kNoSurface);
    if (bare.back()) {
      target.depth_format = DepthFormat::kUnorm24;
      target.depth_surface = 100 + static_cast<std::uint32_t>(bare.size()) - 1;
    }
  }
  for (Command& command : frame.commands) {
    if (bare[command.target]) {
      command.flags &= ~bits({Flag::kDepthTest, Flag::kDepthWrite, Flag::kClearDepth});
    }
  }
  return frame;
}

/// A random frame in which each target may lose its depth.
Frame frame_with_bare_targets(Random& random) {
  Frame frame = hard_frame(random);
  for (Target& target : frame.targets) {
    if (random.between(0, 1) == 0) {
      target.depth_format = DepthFormat::kNone;
      target.depth_surface = kNoSurface;
    }
  }
  return frame;
}

}  // namespace

TEST_CASE("what is counted of a target without depth is that of one whose depth is not tested",
          "[property]") {
  Random random(seed());
  const std::uint64_t runs = samples(2'000'000) / 2000;  // a frame counts as so many samples
  std::uint64_t compared = 0;
  for (std::uint64_t run = 0; run < runs; ++run) {
    CAPTURE(seed(), run);
    const Config config = random_config(random);
    const Frame frame = frame_with_bare_targets(random);
    INFO(difference_from_default(config));
    const Watch watch{.keep_visible = true, .keep_sums = random.between(0, 1) == 0};
    const FrameResult result = run_functional(frame, config, watch);
    const FrameResult other = run_functional(with_depth(frame), config, watch);
    for (const Surface& surface : result.surfaces) {
      if (!surface.target) {
        continue;
      }
      ++compared;
      const Surface& with = other.surfaces.at(100 + *surface.target);
      const std::string name = "target " + std::to_string(*surface.target) + " ";
      REQUIRE(image_difference(name + "fragments", surface.fragments, with.fragments) == "");
      REQUIRE(image_difference(name + "survivors", surface.survivors, with.survivors) == "");
      REQUIRE(image_difference(name + "visible", surface.visible, with.visible) == "");
      REQUIRE(difference(name + "sums", surface.sums, with.sums) == "");
      REQUIRE(surface.counters.early_z.tested == 0);
      REQUIRE(surface.counters.early_z.survivors == surface.counters.quad_generator.fragments);
    }
  }
  CHECK(compared > runs / 4);
}

TEST_CASE("the surfaces of a frame are those of depth by number, then targets without depth") {
  FrameBuilder builder(16);
  Target bare = builder.frame.targets[0];
  bare.depth_format = DepthFormat::kNone;
  bare.depth_surface = kNoSurface;
  Target last = builder.frame.targets[0];
  last.depth_surface = 3;
  builder.frame.targets = {bare, last, bare, bare, builder.frame.targets[0]};
  for (Command& command : builder.frame.commands) {
    command.target = 3;  // a clear makes no surface
  }
  for (const std::uint32_t target : {2u, 0u, 2u}) {
    builder.draw({{0, 0, 0.5}, {8, 0, 0.5}, {0, 8, 0.5}}).target = target;
  }
  const std::vector<Surface> surfaces = make_surfaces(builder.frame, {}, {});
  REQUIRE(surfaces.size() == 6);
  CHECK(depth_surfaces(surfaces).size() == 4);
  CHECK(surfaces[4].target == 0u);
  CHECK(surfaces[5].target == 2u);
  CHECK(surfaces_of_targets(builder.frame, surfaces) == std::vector<std::uint32_t>{4, 3, 5, kNoSurface, 0});
  CHECK(stream_surfaces(surfaces).size() == 4);
  CHECK(place_blocks(surfaces, {}).size() == 4);
}

}  // namespace halfspace::testing
