/// block_walker: from a triangle to the blocks that it may touch, each with a mask of its tiles.
///
/// It visits the blocks of the bounds, in row order or in another. In each it tests all tiles that the bounds
/// touch at once, and leaves out those that are outside one edge at every corner of the box of their samples.
/// Of a triangle whose bounds lie in one block and hold few samples it tests these instead, and leaves out
/// the tiles in which none is covered: the tests of as many tiles do for it. A block that is left with no
/// tile goes nowhere.
///
/// With one level a step visits a tile instead, and gives out its block with this tile alone. With three a
/// step first decides all blocks of a superblock, which has as many of them as a block has tiles.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "halfspace/units/cell_walk.hpp"
#include "halfspace/units/hi_z_plane.hpp"
#include "halfspace/units/packets.hpp"
#include "halfspace/units/square_edges.hpp"

namespace halfspace {

/// The tiles of a block that `inside`, pixels of the block, touches: bit y * (tiles in a row) + x.
template <int TileSize>
constexpr std::uint64_t tiles_of_rect(const PixelRect& inside, int block_size) {
  const int row_tiles = block_size / TileSize;
  const int first = inside.x_first / TileSize;
  const std::uint64_t row = (std::uint64_t{2} << (inside.x_last / TileSize)) - (std::uint64_t{1} << first);
  std::uint64_t tiles = 0;
  for (int y = inside.y_first / TileSize; y <= inside.y_last / TileSize; ++y) {
    tiles |= row << (y * row_tiles);
  }
  return tiles;
}

/// The bounds lie in one block, and have no more columns and rows than a block has of tiles.
constexpr bool has_few_samples(const PixelRect& bounds, int block_size, int row_tiles) {
  return bounds.x_first / block_size == bounds.x_last / block_size &&
         bounds.y_first / block_size == bounds.y_last / block_size &&
         bounds.x_last - bounds.x_first < row_tiles && bounds.y_last - bounds.y_first < row_tiles;
}

/// The tiles of a block, as in BlockJob, in which a sample of `inside`, pixels of the block, is covered.
/// `block`: edges at its top left sample.
template <int TileSize>
constexpr std::uint64_t covered_tiles(const SquareEdges& block, const PixelRect& inside, int row_tiles) {
  std::uint64_t tiles = 0;
  for (int y = inside.y_first; y <= inside.y_last; ++y) {
    for (int x = inside.x_first; x <= inside.x_last; ++x) {
      const std::array<std::int64_t, 3> e = block.at(x, y);
      const bool covered = e[0] >= 0 && e[1] >= 0 && e[2] >= 0;
      tiles |= std::uint64_t{covered} << (y / TileSize * row_tiles + x / TileSize);
    }
  }
  return tiles;
}

/// The blocks of a triangle.
template <int TileSize>
class TriangleBlocks {
 public:
  TriangleBlocks(const SetupTriangle& triangle, const WalkerConfig& config, std::uint8_t slot)
      : triangle_(triangle),
        config_(config),
        row_tiles_(config.block_size / TileSize),
        few_samples_(config.sample_reject && has_few_samples(triangle.bounds, config.block_size, row_tiles_)),
        job_{.slot = slot,
             .a = slopes(triangle, &Edge::a),
             .b = slopes(triangle, &Edge::b),
             .z_dx = triangle.plane.dx,
             .z_dy = triangle.plane.dy,
             .z_known = static_cast<std::uint8_t>(triangle.plane.known ? 1 : 0)},
        screen_({triangle.edge[0].c, triangle.edge[1].c, triangle.edge[2].c}, job_.a, job_.b,
                config.sub_pixel_bits) {
    const SampleBox box = config.samples.box();
    for (std::size_t i = 0; i < 3; ++i) {
      to_largest_sample_[i] = to_largest_sample(job_.a[i], job_.b[i], box, config.sub_pixel_bits);
    }
  }

  [[nodiscard]] int row_tiles() const { return row_tiles_; }

  /// The squares of the grid that the bounds touch; they have `side` pixels.
  [[nodiscard]] PixelRect cells(int side) const {
    const PixelRect& bounds = triangle_.bounds;
    return {.x_first = bounds.x_first / side,
            .y_first = bounds.y_first / side,
            .x_last = bounds.x_last / side,
            .y_last = bounds.y_last / side};
  }

  /// What edges that are negative at all samples of a square say of its row.
  [[nodiscard]] RowSides sides(const GridPlace& square, int side) const {
    const std::array<std::int64_t, 3> e = screen_.at(square.x * side, square.y * side);
    RowSides found;
    for (std::size_t i = 0; i < 3; ++i) {
      const bool outside = e[i] + screen_.to_largest(i, side) + to_largest_sample_[i] < 0;
      found.none_left |= outside && job_.a[i] >= 0;
      found.none_right |= outside && job_.a[i] <= 0;
    }
    return found;
  }
  [[nodiscard]] bool rejects(const GridPlace& square, int side) const {
    return !sides(square, side).inside();
  }

  /// Tells the sink of a block, of whose tiles only `chosen` are looked at.
  template <class Sink>
  void visit(const GridPlace& block, std::uint64_t chosen, Sink& sink) {
    const int size = config_.block_size;
    const int x = block.x * size;
    const int y = block.y * size;
    const PixelRect& bounds = triangle_.bounds;
    const PixelRect inside{.x_first = std::max(bounds.x_first - x, 0),
                           .y_first = std::max(bounds.y_first - y, 0),
                           .x_last = std::min(bounds.x_last - x, size - 1),
                           .y_last = std::min(bounds.y_last - y, size - 1)};
    job_.block_x = static_cast<std::uint16_t>(block.x);
    job_.block_y = static_cast<std::uint16_t>(block.y);
    job_.e = screen_.at(x, y);
    job_.z = hi_z_wrap(triangle_.plane.z + triangle_.plane.dx * x + triangle_.plane.dy * y);
    job_.x_first = static_cast<std::uint8_t>(inside.x_first);
    job_.x_last = static_cast<std::uint8_t>(inside.x_last);
    job_.y_first = static_cast<std::uint8_t>(inside.y_first);
    job_.y_last = static_cast<std::uint8_t>(inside.y_last);
    const std::uint64_t touched = tiles_of_rect<TileSize>(inside, size) & chosen;
    job_.tiles = few_samples_
                     ? covered_tiles<TileSize>(SquareEdges(job_.e, job_.a, job_.b, config_.sub_pixel_bits),
                                               inside, row_tiles_)
                     : kept(block, touched);
    sink.block(static_cast<const BlockJob&>(job_), touched);
  }

 private:
  static std::array<std::int32_t, 3> slopes(const SetupTriangle& triangle, std::int32_t Edge::*slope) {
    return {triangle.edge[0].*slope, triangle.edge[1].*slope, triangle.edge[2].*slope};
  }

  /// The tiles of a block that no edge rejects.
  [[nodiscard]] std::uint64_t kept(const GridPlace& block, std::uint64_t touched) const {
    std::uint64_t tiles = touched;
    for (std::uint64_t left = config_.trivial_reject ? touched : 0; left != 0; left &= left - 1) {
      const int tile = std::countr_zero(left);
      const GridPlace at{block.x * row_tiles_ + tile % row_tiles_, block.y * row_tiles_ + tile / row_tiles_};
      tiles &= ~(std::uint64_t{rejects(at, TileSize)} << tile);
    }
    return tiles;
  }

  const SetupTriangle& triangle_;
  const WalkerConfig& config_;
  int row_tiles_;
  bool few_samples_;
  BlockJob job_;
  SquareEdges screen_;                               ///< at the centres of the screen's pixels
  std::array<std::int64_t, 3> to_largest_sample_{};  ///< from the centre of a pixel
};

inline constexpr std::uint64_t kAllTiles = ~std::uint64_t{0};

/// A step for each cell: a tile (levels = 1) or a block (2).
template <int TileSize, class Sink>
void walk_cells(TriangleBlocks<TileSize>& blocks, const WalkerConfig& config, Sink& sink) {
  const int side = config.levels == 1 ? TileSize : config.block_size;
  with_cell_walk(config.order, blocks.cells(side), [&](auto walk) {
    while (!walk.done()) {
      const GridPlace at = walk.at();
      const RowSides sides = is_led(config.order) ? blocks.sides(at, side) : RowSides{};
      if (walk.passes(sides)) {
        sink.pass(at, side);
      } else if (config.levels == 1) {
        const int row = blocks.row_tiles();
        blocks.visit({at.x / row, at.y / row}, std::uint64_t{1} << (at.y % row * row + at.x % row), sink);
      } else {
        blocks.visit(at, kAllTiles, sink);
      }
      walk.advance(sides);
    }
  });
}

/// The blocks of a superblock that the bounds touch and no edge rejects: bit y * (blocks in a row) + x.
template <int TileSize>
std::uint64_t blocks_of_superblock(const TriangleBlocks<TileSize>& blocks, const GridPlace& superblock,
                                   const WalkerConfig& config) {
  const int row = blocks.row_tiles();
  const PixelRect inside =
      intersect(blocks.cells(config.block_size), {.x_first = superblock.x * row,
                                                  .y_first = superblock.y * row,
                                                  .x_last = superblock.x * row + row - 1,
                                                  .y_last = superblock.y * row + row - 1});
  std::uint64_t left = 0;
  for (int y = inside.y_first; y <= inside.y_last; ++y) {
    for (int x = inside.x_first; x <= inside.x_last; ++x) {
      left |= std::uint64_t{!blocks.rejects({x, y}, config.block_size)} << (y % row * row + x % row);
    }
  }
  return left;
}

/// A step for each superblock, then one for each of its blocks that is left (levels = 3). Bounds within one
/// block need no step of the superblock.
template <int TileSize, class Sink>
void walk_superblocks(TriangleBlocks<TileSize>& blocks, const WalkerConfig& config, Sink& sink) {
  const PixelRect all = blocks.cells(config.block_size);
  if (all.x_first == all.x_last && all.y_first == all.y_last) {
    blocks.visit({all.x_first, all.y_first}, kAllTiles, sink);
    return;
  }
  const int row = blocks.row_tiles();
  with_cell_walk(config.order, blocks.cells(row * config.block_size), [&](auto walk) {
    for (; !walk.done(); walk.advance({})) {
      const GridPlace at = walk.at();
      const std::uint64_t left = blocks_of_superblock(blocks, at, config);
      sink.pass(at, row * config.block_size);
      for_each_in_order(order_in_square(config.order), row, left, [&](int block) {
        blocks.visit({at.x * row + block % row, at.y * row + block / row}, kAllTiles, sink);
      });
    }
  });
}

/// Walks one triangle. Calls sink.block(job, touched) for every block that a step decides; `touched` are the
/// tiles that the step looks at, of which job.tiles are those that are not rejected: none, where nothing
/// leaves. Calls sink.pass(cell, side) for every step that only leads the walk: at a cell of the grid of
/// squares of `side` pixels.
template <int TileSize, class Sink>
void block_walker(const SetupTriangle& triangle, const WalkerConfig& config, std::uint8_t slot, Sink& sink) {
  TriangleBlocks<TileSize> blocks(triangle, config, slot);
  if (config.levels == 3) {
    walk_superblocks(blocks, config, sink);
  } else {
    walk_cells(blocks, config, sink);
  }
}

}  // namespace halfspace
