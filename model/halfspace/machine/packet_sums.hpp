/// Sums of the packets on a surface, for the pictures: what the walker decided about each tile, and the quads
/// that left at each place.
#pragma once

#include <cstdint>
#include <limits>

#include "halfspace/scene/validate.hpp"
#include "halfspace/units/packets.hpp"
#include "halfspace/units/tiled_image.hpp"

namespace halfspace {

/// Decisions about a tile.
struct TileDecisions {
  std::uint32_t rejected = 0;
  std::uint32_t accepted = 0;
  std::uint32_t partial = 0;
  friend bool operator==(const TileDecisions&, const TileDecisions&) = default;
};

/// Quads that left at a place, and the samples that they covered.
struct QuadLanes {
  std::uint32_t quads = 0;
  std::uint32_t covered = 0;
  friend bool operator==(const QuadLanes&, const QuadLanes&) = default;
};

// No sum reaches the end of its range. A triangle of the frame is drawn as at most 7 (scene/clip.hpp), each
// of which is decided once in a tile and is one quad at a place; together they cover a sample once.
static_assert(7 * kMaxFrameTriangles <= std::numeric_limits<std::uint32_t>::max());

/// Of all draws; clears do not count. passage/packet_sums.hpp adds to them.
struct PacketSums {
  PacketSums() = default;
  /// Width, height and sizes in pixels.
  PacketSums(int width, int height, int tile_size, int block_size)
      : decisions((width + tile_size - 1) / tile_size, (height + tile_size - 1) / tile_size,
                  block_size / tile_size, {}),
        quads((width + 1) / 2, (height + 1) / 2, tile_size / 2, {}) {}

  [[nodiscard]] bool empty() const { return quads.empty(); }

  void clear() {
    decisions.fill({.x_last = decisions.width() - 1, .y_last = decisions.height() - 1}, {});
    quads.fill({.x_last = quads.width() - 1, .y_last = quads.height() - 1}, {});
  }

  TiledImage<TileDecisions> decisions;  ///< a value a tile; those of a block lie together
  TiledImage<QuadLanes> quads;          ///< a value a place; those of a tile lie together
};

}  // namespace halfspace
