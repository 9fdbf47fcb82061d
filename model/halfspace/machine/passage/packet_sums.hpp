/// What packets add to the sums of a surface.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "halfspace/machine/packet_sums.hpp"
#include "halfspace/units/quad_generator.hpp"
#include "halfspace/units/tile_walker.hpp"

namespace halfspace::passage {

inline void count(TileDecisions& tile, TileVerdict verdict) {
  ++(verdict == TileVerdict::kReject   ? tile.rejected
     : verdict == TileVerdict::kAccept ? tile.accepted
                                       : tile.partial);
}

/// About a block or a tile, `size` pixels on a side with the top left one at (x, y). A block that is partial
/// says nothing of its tiles.
template <int TileSize>
void count_decision(PacketSums& sums, int x, int y, int size, TileVerdict verdict) {
  if (size == TileSize) {
    count(sums.decisions.at(x / TileSize, y / TileSize), verdict);
  } else if (verdict != TileVerdict::kPartial) {
    const int tiles = size / TileSize * (size / TileSize);
    std::for_each_n(sums.decisions.tile(x / size, y / size), tiles,
                    [verdict](TileDecisions& tile) { count(tile, verdict); });
  }
}

/// The quads of a tile that hold samples of `covered`.
template <int TileSize>
void count_quads(PacketSums& sums, int tile_x, int tile_y, const TileMask& covered) {
  QuadLanes* const places = sums.quads.tile(tile_x, tile_y);
  for_each_quad<TileSize>(halfspace::quad_generator<TileSize>({.mask = covered}), [places](const Quad& quad) {
    QuadLanes& place = places[quad.y / 2 * (TileSize / 2) + quad.x / 2];
    ++place.quads;
    place.covered += static_cast<std::uint32_t>(std::popcount(quad.mask));
  });
}

}  // namespace halfspace::passage
