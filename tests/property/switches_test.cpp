// What a machine skips changes nothing of the picture: any set of its switches, on any machine.
#include <catch2/catch.hpp>

#include "../line_frames.hpp"
#include "../result_difference.hpp"
#include "halfspace/machine/in_order.hpp"
#include "hard_frames.hpp"

namespace halfspace::testing {
namespace {

/// A frame counts as so many samples.
constexpr std::uint64_t kSwitchFrameSamples = 2000;

constexpr const char* kSwitches[] = {
    "block_walker.trivial_reject", "block_walker.sample_reject", "hi_z.enabled",       "hi_z.accept",
    "tile_walker.trivial_accept",  "z_cache.compression",        "z_cache.fast_clear",
};

Frame any_frame(Random& random, const Config& config) {
  switch (random.between(0, 4)) {
    case 0:
      return random_frame(random);
    case 1:
      return depth_stack(random);
    case 2:
      return touching_planes(random);
    case 3:
      return random_lines(random, takes_thin_lines(config));
    default:
      return hard_frame(random);
  }
}

/// Random, with any walk, or all off and in row order; hi_z stays off where a block has too many parts of
/// tiles for it.
Config with_switches(Random& random, Config config, bool off) {
  config.block_walker.levels = 2;
  config.block_walker.order = WalkOrder::kRaster;
  config.tile_walker.order = TileOrder::kRaster;
  for (const char* name : kSwitches) {
    set_config(config, name, off || random.between(0, 1) == 0 ? "false" : "true");
  }
  try {
    validate(config);
  } catch (const InputError&) {
    config.hi_z.enabled = false;
  }
  if (!off) {
    random_walk(random, config);
  }
  return config;
}

}  // namespace

TEST_CASE("switches: whatever is skipped, the picture is the same", "[property]") {
  Random random(seed());
  const Watch watch{.keep_visible = true};
  for (std::uint64_t left = samples(1'000'000) / kSwitchFrameSamples; left > 0; --left) {
    const Config base = random_config(random);
    const Frame frame = any_frame(random, base);
    const Config config = with_switches(random, base, false);
    const FrameResult all_off = run_in_order(frame, with_switches(random, base, true), watch, nullptr);
    INFO(difference_from_default(config));
    REQUIRE(picture_difference(run_in_order(frame, config, watch, nullptr), all_off) == "");
  }
}

}  // namespace halfspace::testing
