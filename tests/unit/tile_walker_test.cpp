// tile_walker: verdicts are sound, nothing is lost, and its switches change only the work.
#include "halfspace/units/tile_walker.hpp"

#include <catch2/catch.hpp>
#include <map>

#include "../triangles.hpp"
#include "halfspace/units/edge_evaluator.hpp"

using namespace halfspace;
using namespace halfspace::testing;

namespace {

constexpr int kSize = 100;  // not a multiple of any tile

/// Keeps what the walker says.
struct Recorded {
  struct Decision {
    int x, y, size;
    TileVerdict verdict;
  };
  std::vector<Decision> decisions;
  std::vector<std::pair<TileJob, TileWork>> tiles;

  void decision(int x, int y, int size, TileVerdict verdict) { decisions.push_back({x, y, size, verdict}); }
  void tile(const TileJob& job, TileWork work) { tiles.emplace_back(job, work); }
};

/// Coverage of the target by definition.
std::vector<bool> exact_coverage(const ScreenTriangle& t, const PixelRect& bounds, int bits) {
  std::vector<bool> covered(kSize * kSize);
  for (int y = bounds.y_first; y <= bounds.y_last; ++y) {
    for (int x = bounds.x_first; x <= bounds.x_last; ++x) {
      covered[static_cast<std::size_t>(y * kSize + x)] =
          reference::covers(grid(t), reference::pixel_centre(x, y, bits), reference::TieRule::kTopLeft);
    }
  }
  return covered;
}

template <int TileSize>
void check_walk(const ScreenTriangle& t, const SetupState& state, const WalkerConfig& config) {
  SetupTriangle triangle;
  if (setup(t, state, triangle) != SetupVerdict::kDrawn) {
    return;
  }
  const std::vector<bool> exact = exact_coverage(t, state.bounds, state.sub_pixel_bits);
  Recorded recorded;
  tile_walker<TileSize>(triangle, config, 0, recorded);

  for (const Recorded::Decision& d : recorded.decisions) {
    for (int y = d.y; y < std::min(d.y + d.size, kSize); ++y) {
      for (int x = d.x; x < std::min(d.x + d.size, kSize); ++x) {
        const bool covered = exact[static_cast<std::size_t>(y * kSize + x)];
        REQUIRE((d.verdict != TileVerdict::kReject || !covered));
        REQUIRE((d.verdict != TileVerdict::kAccept || covered));
      }
    }
  }
  std::vector<bool> walked(kSize * kSize);
  std::map<std::pair<int, int>, int> visits;
  for (const auto& [job, work] : recorded.tiles) {
    REQUIRE(++visits[{job.tile_x, job.tile_y}] == 1);
    const TileMask mask = edge_evaluator<TileSize>(job, state.sub_pixel_bits).mask;
    REQUIRE((work == TileWork::kEvaluate || mask == full_mask<TileSize>()));
    for (int y = 0; y < TileSize; ++y) {
      for (int x = 0; x < TileSize; ++x) {
        if (test<TileSize>(mask, x, y)) {
          walked[static_cast<std::size_t>((job.tile_y * TileSize + y) * kSize + job.tile_x * TileSize + x)] =
              true;
        }
      }
    }
  }
  REQUIRE(walked == exact);
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("tile_walker: covers exactly the samples of the definition, whatever its switches", "",
                       ((int TileSize), TileSize), 4, 8, 16) {
  const int switches = GENERATE(range(0, 8));
  const int bits = GENERATE(4, 8);
  CAPTURE(TileSize, switches, bits);
  const WalkerConfig config{.sub_pixel_bits = bits,
                            .block_size = 32,
                            .block_level = (switches & 1) != 0,
                            .trivial_reject = (switches & 2) != 0,
                            .trivial_accept = (switches & 4) != 0};
  SetupState state = open_state(kSize, bits);
  TriangleSource source(static_cast<std::uint64_t>(switches * 100 + bits), kSize, bits);
  for (int n = 0; n < 60; ++n) {
    const int x = source.integer(0, kSize - 1);
    const int y = source.integer(0, kSize - 1);
    if (n % 3 == 0) {  // a scissor
      state.bounds = {.x_first = x,
                      .y_first = y,
                      .x_last = source.integer(x, kSize - 1),
                      .y_last = source.integer(y, kSize - 1)};
    }
    check_walk<TileSize>(source.next(), state, config);
  }
}

TEST_CASE("tile_walker: decides blocks first, and skips that level where one tile holds the bounds") {
  const auto walk = [](const ScreenTriangle& t) {
    SetupTriangle triangle;
    REQUIRE(setup(t, open_state(kSize), triangle) == SetupVerdict::kDrawn);
    Recorded recorded;
    tile_walker<8>(triangle, WalkerConfig{}, 0, recorded);
    return recorded;
  };
  SECTION("a triangle over the whole target accepts the blocks inside") {
    const Recorded r = walk(
        {{ScreenVertex{-40000, -40000, 0}, ScreenVertex{200000, -40000, 0}, ScreenVertex{-40000, 200000, 0}},
         0});
    int accepted = 0;
    for (const Recorded::Decision& d : r.decisions) {
      accepted += d.size == 32 && d.verdict == TileVerdict::kAccept;
    }
    CHECK(accepted == 9);  // 3 x 3 whole blocks in 100 pixels; the others are cut by the target
    CHECK(r.tiles.size() == 13 * 13);
  }
  SECTION("a triangle inside one tile is one decision") {
    const Recorded r =
        walk({{ScreenVertex{2100, 2100, 0}, ScreenVertex{3500, 2100, 0}, ScreenVertex{2100, 3500, 0}}, 0});
    REQUIRE(r.decisions.size() == 1);
    CHECK(r.decisions[0].size == 8);
  }
}

TEST_CASE("tile_walker: accepts an edge at 0 on its last corner sample and rejects it below") {
  // an edge that falls by 1 a pixel in x: e = start - x
  const WalkerConfig config;
  const auto corners = [&](std::int64_t start) {
    return test_corners({{{start, -1, 0}, {1000, 0, 0}, {1000, 0, 0}}}, 8, 0, config);
  };
  CHECK(corners(7).accept == 7);  // 0 at x = 7
  CHECK(corners(6).accept == 6);  // -1 at x = 7
  CHECK(!corners(0).reject);      // 0 at x = 0
  CHECK(corners(-1).reject);
}
