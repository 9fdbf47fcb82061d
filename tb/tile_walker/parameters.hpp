/// A configuration of tile_walker: its widths and its parameters.
#pragma once

#include "common/walk_triangles.hpp"
#include "halfspace/units/square_edges.hpp"

namespace halfspace::tb {

struct TileWalkerParameters {
  WalkSizes sizes;
  int fifo_depth = 16;
  bool trivial_accept = true;
  TileOrder order = TileOrder::kRaster;

  [[nodiscard]] WalkerConfig walker() const {
    return {.sub_pixel_bits = sizes.sub_pixel_bits,
            .block_size = sizes.block_size,
            .trivial_accept = trivial_accept,
            .tile_order = order,
            .samples = sizes.pattern()};
  }
};

}  // namespace halfspace::tb
