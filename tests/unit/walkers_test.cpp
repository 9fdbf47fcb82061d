// The walk over blocks and tiles: nothing is lost, what is left out or accepted is sound, and switches change
// only the work.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <tuple>

#include "../triangles.hpp"
#include "halfspace/units/block_walker.hpp"
#include "halfspace/units/edge_evaluator.hpp"
#include "halfspace/units/tile_walker.hpp"

using namespace halfspace;
using namespace halfspace::testing;

namespace {

constexpr int kSize = 100;  // not a multiple of any tile

/// Keeps what the walkers say.
template <int TileSize>
struct Recorded {
  struct Block {
    BlockJob job;
    std::uint64_t touched;
  };
  WalkerConfig config;
  std::vector<Block> blocks;
  std::vector<std::pair<TileJob, bool>> tiles{};
  int passes = 0;

  void block(const BlockJob& job, std::uint64_t touched) {
    blocks.push_back({job, touched});
    tile_walker<TileSize>(job, config, *this);
  }
  void pass(const GridPlace& /*cell*/, int /*side*/) { ++passes; }
  void tile(const TileJob& job, bool whole) { tiles.emplace_back(job, whole); }
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
  const int row_tiles = config.block_size / TileSize;
  Recorded<TileSize> recorded{.config = config, .blocks = {}};
  block_walker<TileSize>(triangle, config, 0, recorded);

  const PixelRect& bounds = triangle.bounds;
  const bool few_samples = config.sample_reject && recorded.blocks.size() == 1 &&
                           bounds.x_last - bounds.x_first < row_tiles &&
                           bounds.y_last - bounds.y_first < row_tiles;
  std::map<std::pair<int, int>, int> visits;
  for (const auto& [job, touched] : recorded.blocks) {
    REQUIRE((job.tiles & ~touched) == 0);
    REQUIRE((config.trivial_reject || few_samples || job.tiles == touched));
    for (int i = 0; i < row_tiles * row_tiles; ++i) {
      const int x = job.block_x * row_tiles + i % row_tiles;
      const int y = job.block_y * row_tiles + i / row_tiles;
      const PixelRect inside = intersect(triangle.bounds, {.x_first = x * TileSize,
                                                           .y_first = y * TileSize,
                                                           .x_last = x * TileSize + TileSize - 1,
                                                           .y_last = y * TileSize + TileSize - 1});
      REQUIRE((touched >> i & 1) == (inside.empty() ? 0u : 1u));
      if (!inside.empty()) {
        REQUIRE(++visits[{x, y}] == 1);
      }
    }
  }
  std::vector<bool> walked(kSize * kSize);
  for (const auto& [job, whole] : recorded.tiles) {
    REQUIRE(visits[{job.tile_x, job.tile_y}]++ == 1);
    const TileMask mask = edge_evaluator<TileSize>(job, state.sub_pixel_bits).mask;
    REQUIRE((!whole || mask == full_mask<TileSize>()));
    REQUIRE((!few_samples || any(mask)));
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

TEMPLATE_TEST_CASE_SIG("walkers: cover exactly the samples of the definition, whatever their switches", "",
                       ((int TileSize), TileSize), 4, 8, 16) {
  const int switches = GENERATE(range(0, 8));
  const int row_tiles = GENERATE(2, 4, 8);
  const int bits = GENERATE(4, 8);
  if (row_tiles * TileSize > 64) {
    return;
  }
  CAPTURE(TileSize, row_tiles, switches, bits);
  const WalkerConfig config{.sub_pixel_bits = bits,
                            .block_size = row_tiles * TileSize,
                            .trivial_reject = (switches & 1) != 0,
                            .trivial_accept = (switches & 2) != 0,
                            .sample_reject = (switches & 4) != 0};
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

namespace {

/// By place, so that orders compare.
template <int TileSize>
auto sorted_tiles(const SetupTriangle& triangle, const WalkerConfig& config) {
  Recorded<TileSize> recorded{.config = config, .blocks = {}};
  block_walker<TileSize>(triangle, config, 0, recorded);
  const auto fields = [](const TileJob& j, bool whole) {
    return std::tuple(j.tile_y, j.tile_x, j.e, j.a, j.b, int{j.accept}, int{j.x_first}, int{j.x_last},
                      int{j.y_first}, int{j.y_last}, whole);
  };
  std::vector<decltype(fields({}, false))> tiles;
  for (const auto& [job, whole] : recorded.tiles) {
    tiles.push_back(fields(job, whole));
  }
  std::ranges::sort(tiles);
  return tiles;
}

bool is_legal(const WalkerConfig& config) {
  return !is_led(config.order) || (config.levels != 3 && config.trivial_reject);
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("walkers: every walk gives the tiles of the walk in row order, each once", "",
                       ((int TileSize), TileSize), 4, 8, 16) {
  const int row_tiles = GENERATE(2, 4, 8);
  const int levels = GENERATE(1, 2, 3);
  const auto order = static_cast<WalkOrder>(GENERATE(range(0, 6)));
  const bool reject = GENERATE(true, false);
  const WalkerConfig raster{.block_size = row_tiles * TileSize, .trivial_reject = reject};
  WalkerConfig config = raster;
  config.levels = levels;
  config.order = order;
  if (row_tiles * TileSize > 64 || !is_legal(config) || (levels == 3 && !reject)) {
    return;
  }
  constexpr int kWide = 400;
  CAPTURE(TileSize, row_tiles, levels, static_cast<int>(order), reject);
  SetupState state = open_state(kWide);
  TriangleSource source(static_cast<std::uint64_t>(levels * 10 + static_cast<int>(order)), kWide, 8);
  for (int n = 0; n < 150; ++n) {
    state.bounds = {.x_first = 0, .y_first = 0, .x_last = kWide - 1, .y_last = kWide - 1};
    if (n % 3 == 0) {  // a scissor
      const int x = source.integer(0, kWide - 1);
      const int y = source.integer(0, kWide - 1);
      state.bounds = {x, y, source.integer(x, kWide - 1), source.integer(y, kWide - 1)};
    }
    config.tile_order = static_cast<TileOrder>(n % 4);
    SetupTriangle triangle;
    if (setup(source.next(), state, triangle) != SetupVerdict::kDrawn) {
      continue;
    }
    REQUIRE(sorted_tiles<TileSize>(triangle, config) == sorted_tiles<TileSize>(triangle, raster));
  }
}

TEST_CASE("walkers: a triangle over the whole target covers the tiles inside whole") {
  SetupTriangle triangle;
  REQUIRE(setup({{ScreenVertex{-40000, -40000, 0}, ScreenVertex{200000, -40000, 0},
                  ScreenVertex{-40000, 200000, 0}},
                 0},
                open_state(kSize), triangle) == SetupVerdict::kDrawn);
  Recorded<8> recorded{.config = {}, .blocks = {}};
  block_walker<8>(triangle, {}, 0, recorded);
  CHECK(recorded.blocks.size() == 16);
  CHECK(recorded.blocks[0].job.tiles == 0xFFFF);
  CHECK(recorded.blocks[15].job.tiles == 1);  // 4 pixels of 100 are left of 96
  CHECK(recorded.tiles.size() == 13 * 13);
  int whole = 0;
  for (const auto& [job, all] : recorded.tiles) {
    whole += all ? 1 : 0;
  }
  CHECK(whole == 12 * 12);
}

TEST_CASE(
    "walkers: an edge leaves a tile out below 0 at its largest sample, and is accepted at 0 at its least") {
  // An edge that falls by 1 a pixel in x, the others inside everywhere: e = start - x in the first tile.
  const auto walk = [](std::int64_t start) {
    SetupTriangle triangle;
    triangle.bounds = {.x_first = 0, .y_first = 0, .x_last = 7, .y_last = 7};
    triangle.edge = {Edge{.a = -1, .b = 0, .c = start << 8}, Edge{.a = 0, .b = 0, .c = 1000},
                     Edge{.a = 0, .b = 0, .c = 1000}};
    Recorded<8> recorded{.config = {}, .blocks = {}};
    block_walker<8>(triangle, {}, 0, recorded);
    return recorded;
  };
  CHECK(walk(7).tiles.at(0).first.accept == 7);  // 0 at x = 7
  CHECK(walk(6).tiles.at(0).first.accept == 6);  // -1 at x = 7
  CHECK(walk(0).tiles.size() == 1);              // 0 at x = 0
  CHECK(walk(-1).tiles.empty());
  CHECK(walk(-1).blocks.at(0).job.tiles == 0);
}
