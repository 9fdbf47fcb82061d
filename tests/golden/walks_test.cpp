// Every walk over triangles draws captured frames as the default walk does.
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "../result_difference.hpp"
#include "captured_frame.hpp"
#include "halfspace/core/functional.hpp"
#include "halfspace/numerics/error.hpp"

using namespace halfspace;
using halfspace::testing::captured_frame;

namespace {

/// The walks that are legal; the tiles of a block in each order in turn.
std::vector<Config> walks() {
  std::vector<Config> list;
  for (int walk = 0; walk < 3 * 6; ++walk) {
    Config config;
    config.block_walker.levels = walk / 6 + 1;
    config.block_walker.order = static_cast<WalkOrder>(walk % 6);
    config.tile_walker.order = static_cast<TileOrder>(walk % 4);
    try {
      validate(config);
      list.push_back(config);
    } catch (const OptionError&) {
      // a led walk with superblocks
    }
  }
  return list;
}

void check_walks(const std::string& name) {
  const Frame frame = captured_frame(name);
  const Watch watch{.keep_visible = true};
  const FrameResult plain = run_functional(frame, {}, watch);
  for (const Config& config : walks()) {
    CAPTURE(name, config.block_walker.levels, static_cast<int>(config.block_walker.order));
    const FrameResult result = run_functional(frame, config, watch);
    REQUIRE(halfspace::testing::picture_difference(result, plain) == "");
    for (std::size_t s = 0; s < plain.surfaces.size(); ++s) {
      REQUIRE(halfspace::testing::image_difference("surface " + std::to_string(s) + " fragments",
                                                   result.surfaces[s].fragments,
                                                   plain.surfaces[s].fragments) == "");
    }
    REQUIRE(halfspace::testing::difference("quads", result.counters.quad_generator.quads,
                                           plain.counters.quad_generator.quads) == "");
  }
}

}  // namespace

TEST_CASE("walks: there are six by tiles, six by blocks, four by superblocks") {
  CHECK(walks().size() == 16);
}

// A frame that is not there skips its own case only.
TEST_CASE("walks: vkcube", "[golden]") { check_walks("vkcube"); }
TEST_CASE("walks: cc0_truck", "[golden]") { check_walks("cc0_truck"); }
TEST_CASE("walks: glmark2_ideas", "[golden]") { check_walks("glmark2_ideas"); }
TEST_CASE("walks: glmark2_shadow", "[golden]") { check_walks("glmark2_shadow"); }
TEST_CASE("walks: stk_snowmountain", "[golden]") { check_walks("stk_snowmountain"); }
TEST_CASE("walks: openarena_gl2", "[golden]") { check_walks("openarena_gl2"); }
TEST_CASE("walks: warzone2100_vulkan", "[golden]") { check_walks("warzone2100_vulkan"); }
