// Do the frames of `bench surfaces` touch the tiles that they say?
#include "halfspace/speed/surface_cost.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <stdexcept>
#include <vector>

#include "halfspace/config/config.hpp"
#include "halfspace/core/functional.hpp"
#include "halfspace/scene/validate.hpp"

using namespace halfspace;

namespace {

struct Drawn {
  std::size_t tiles = 0;  ///< with a fragment
  std::uint64_t fragments = 0;
};

Drawn drawn(const Frame& frame) {
  validate(frame);
  const FrameResult result = run_functional(frame, Config{});
  const auto& counts = result.surfaces.at(0).fragments;
  Drawn drawn{.tiles = 0, .fragments = result.counters.quad_generator.fragments};
  for (int y = 0; y < counts.tiles_y(); ++y) {
    for (int x = 0; x < counts.tiles_x(); ++x) {
      const auto* const tile = counts.tile(x, y);
      drawn.tiles += std::any_of(tile, tile + 64, [](std::uint16_t n) { return n != 0; }) ? 1 : 0;
    }
  }
  return drawn;
}

}  // namespace

TEST_CASE("bench surfaces: a square covers its tiles whole, scattered triangles one tile each") {
  const SurfaceFrames frames{.side = 1024, .tile_side = 8};
  CHECK(drawn(frames.cleared(0)).tiles == 0);
  CHECK(run_functional(frames.cleared(3), Config{}).clears == 3);
  for (const std::uint32_t side : {1u, 2u, 5u, 64u}) {
    CAPTURE(side);
    const Drawn square = drawn(frames.block(side));
    CHECK(square.tiles == side * side);
    CHECK(square.fragments == std::uint64_t{64} * side * side);
    CHECK(drawn(frames.scattered(side * side)).tiles == side * side);
  }
}

TEST_CASE("bench surfaces: a run is measured in a process of its own, and its failure is told") {
  int runs = 0;
  const RunCost cost = cost_of_fresh_run([&] {
    ++runs;
    std::vector<char> bytes(50'000'000, 1);
    asm volatile("" : : "r"(bytes.data()) : "memory");
  });
  CHECK(runs == 0);  // in this process
  CHECK(cost.milliseconds > 0);
  CHECK(cost.megabytes > 40);
  CHECK_THROWS_AS(cost_of_fresh_run([] { throw std::runtime_error("no"); }), std::runtime_error);
}
