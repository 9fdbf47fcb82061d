/// block_walker: from a triangle to the blocks that it may touch, each with a mask of its tiles.
///
/// It visits the blocks of the bounds in row order. In each it tests all tiles that the bounds touch at once,
/// and leaves out those that are outside one edge at every corner of the box of their samples. Of a triangle
/// whose bounds lie in one block and hold few samples it tests these instead, and leaves out the tiles in
/// which none is covered: the tests of as many tiles do for it. A block that is left with no tile goes
/// nowhere.
#pragma once

#include <algorithm>
#include <cstdint>

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

/// Walks one triangle. Calls sink.block(job, touched) for every block of the bounds; `touched` are the tiles
/// that the bounds touch, of which job.tiles are those that are not rejected: none, where nothing leaves.
template <int TileSize, class Sink>
void block_walker(const SetupTriangle& triangle, const WalkerConfig& config, std::uint8_t slot, Sink& sink) {
  const int size = config.block_size;
  const int row_tiles = size / TileSize;
  const PixelRect& bounds = triangle.bounds;
  BlockJob job{.slot = slot,
               .z_dx = triangle.plane.dx,
               .z_dy = triangle.plane.dy,
               .z_known = static_cast<std::uint8_t>(triangle.plane.known ? 1 : 0)};
  std::array<std::int64_t, 3> origin{};  // E at pixel (0, 0)
  for (std::size_t i = 0; i < 3; ++i) {
    job.a[i] = triangle.edge[i].a;
    job.b[i] = triangle.edge[i].b;
    origin[i] = triangle.edge[i].c;
  }
  const SquareEdges screen(origin, job.a, job.b, config.sub_pixel_bits);
  const SampleBox box = config.samples.box();
  std::array<std::int64_t, 3> to_largest{};
  for (std::size_t i = 0; i < 3; ++i) {
    to_largest[i] =
        screen.to_largest(i, TileSize) + to_largest_sample(job.a[i], job.b[i], box, config.sub_pixel_bits);
  }
  for (int y = bounds.y_first / size * size; y <= bounds.y_last; y += size) {
    for (int x = bounds.x_first / size * size; x <= bounds.x_last; x += size) {
      const PixelRect inside{.x_first = std::max(bounds.x_first - x, 0),
                             .y_first = std::max(bounds.y_first - y, 0),
                             .x_last = std::min(bounds.x_last - x, size - 1),
                             .y_last = std::min(bounds.y_last - y, size - 1)};
      job.block_x = static_cast<std::uint16_t>(x / size);
      job.block_y = static_cast<std::uint16_t>(y / size);
      job.e = screen.at(x, y);
      job.z = hi_z_wrap(triangle.plane.z + triangle.plane.dx * x + triangle.plane.dy * y);
      job.x_first = static_cast<std::uint8_t>(inside.x_first);
      job.x_last = static_cast<std::uint8_t>(inside.x_last);
      job.y_first = static_cast<std::uint8_t>(inside.y_first);
      job.y_last = static_cast<std::uint8_t>(inside.y_last);
      const std::uint64_t touched = tiles_of_rect<TileSize>(inside, size);
      job.tiles = touched;
      if (config.sample_reject && has_few_samples(bounds, size, row_tiles)) {
        job.tiles = covered_tiles<TileSize>(SquareEdges(job.e, job.a, job.b, config.sub_pixel_bits), inside,
                                            row_tiles);
        sink.block(job, touched);
        continue;
      }
      for (std::uint64_t left = config.trivial_reject ? touched : 0; left != 0; left &= left - 1) {
        const int tile = std::countr_zero(left);
        const std::array<std::int64_t, 3> e =
            screen.at(x + tile % row_tiles * TileSize, y + tile / row_tiles * TileSize);
        const bool outside = e[0] + to_largest[0] < 0 || e[1] + to_largest[1] < 0 || e[2] + to_largest[2] < 0;
        job.tiles &= ~(std::uint64_t{outside} << tile);
      }
      sink.block(job, touched);
    }
  }
}

}  // namespace halfspace
