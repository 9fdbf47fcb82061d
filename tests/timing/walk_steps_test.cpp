// Each walk takes the steps that its page counts, a cycle each: block jobs of one triangle, written out by
// hand.
#include <catch2/catch.hpp>
#include <numeric>
#include <vector>

#include "../frames.hpp"
#include "halfspace/timing/recurrence/run_recurrence.hpp"

namespace halfspace::testing {
namespace {

/// The upper left half of 64 x 64 pixels, without depth: of 8 x 8 tiles those with column + row <= 7 are
/// left.
Frame half_square() {
  FrameBuilder builder(64, DepthFormat::kUnorm24);
  Command& draw = builder.draw({{0, 0, 0}, {64, 0, 0}, {0, 64, 0}});
  draw.flags = bits({Flag::kColorWrite});
  return builder.frame;
}

struct Steps {
  std::vector<std::uint64_t> block;  ///< of each block job, counted from the first step
  std::uint64_t all = 0;             ///< steps
  bool operator==(const Steps&) const = default;
};

/// Of the half square, in a machine in which nothing waits for the tile walker.
Steps steps_of(int levels, WalkOrder order) {
  Config config;
  config.block_walker.levels = levels;
  config.block_walker.order = order;
  config.tile_walker.fifo = 64;  // more than there are tiles
  EngineOptions options;
  options.packet_times = true;
  const TimedResult result = run_recurrence(half_square(), config, options);
  Steps steps;
  for (const std::uint64_t cycle : result.times.block) {
    steps.block.push_back(cycle - result.times.accept.back() - 1);
  }
  const BlockWalkerCounters& counters = result.frame.counters.block_walker;
  steps.all = counters.blocks + counters.passes;
  return steps;
}

/// The steps from `first` on, `count` of them.
void add(std::vector<std::uint64_t>& list, std::uint64_t first, int count) {
  for (int i = 0; i < count; ++i) {
    list.push_back(first + static_cast<std::uint64_t>(i));
  }
}

}  // namespace

TEST_CASE("walk steps: tiles in rows visit all of the bounds", "[timing]") {
  Steps raster{.block = {}, .all = 64};
  for (int row = 0; row < 8; ++row) {
    add(raster.block, static_cast<std::uint64_t>(8 * row), 8 - row);
  }
  CHECK(steps_of(1, WalkOrder::kRaster) == raster);

  Steps back_and_forth{.block = {}, .all = 64};
  for (int row = 0; row < 8; ++row) {  // odd rows begin with the `row` tiles outside
    add(back_and_forth.block, static_cast<std::uint64_t>(8 * row + (row % 2 == 0 ? 0 : row)), 8 - row);
  }
  CHECK(steps_of(1, WalkOrder::kBoustrophedonic) == back_and_forth);
}

TEST_CASE("walk steps: led walks see one tile outside on the right", "[timing]") {
  // The rows begin at the left of the bounds, so there is nothing to the left of any entry.
  Steps led;
  for (int row = 0; row < 8; ++row) {
    add(led.block, led.all, 8 - row);
    led.all += row == 0 ? 8 : 8 - static_cast<std::uint64_t>(row) + 1;
  }
  CHECK(led.all == 43);
  CHECK(steps_of(1, WalkOrder::kBacktracking) == led);
  CHECK(steps_of(1, WalkOrder::kZigzag) == led);
}

TEST_CASE("walk steps: tiles along Morton's curve are the quadrants of quadrants", "[timing]") {
  // All of the first quadrant; of the second and third their own first three quadrants, of which two in half.
  Steps morton{.block = {}, .all = 64};
  add(morton.block, 0, 16);
  for (const std::uint64_t quadrant : {16u, 32u}) {
    add(morton.block, quadrant, 4);      // columns and rows 0, 1 of the quadrant
    add(morton.block, quadrant + 4, 3);  // (2, 0), (3, 0), (2, 1)
    add(morton.block, quadrant + 8, 3);  // (0, 2), (1, 2), (0, 3)
  }
  CHECK(steps_of(1, WalkOrder::kMorton) == morton);
}

TEST_CASE("walk steps: blocks, and blocks of a superblock", "[timing]") {
  // Four blocks of 32 pixels; no tile of the last is left.
  CHECK(steps_of(2, WalkOrder::kRaster) == Steps{{0, 1, 2}, 4});
  CHECK(steps_of(2, WalkOrder::kBoustrophedonic) == Steps{{0, 1, 3}, 4});
  CHECK(steps_of(2, WalkOrder::kHilbert) == Steps{{0, 1, 3}, 4});
  // Back to the left in the second row: below the first block, which is the left of the bounds.
  CHECK(steps_of(2, WalkOrder::kBacktracking) == Steps{{0, 1, 2}, 4});
  // One step decides the blocks, of which three are left.
  CHECK(steps_of(3, WalkOrder::kRaster) == Steps{{1, 2, 3}, 4});
}

}  // namespace halfspace::testing
