/// What packets add to the sums of a surface.
#pragma once

#include <bit>
#include <cstdint>

#include "halfspace/machine/draw_context.hpp"
#include "halfspace/machine/packet_observer.hpp"
#include "halfspace/machine/packet_sums.hpp"
#include "halfspace/units/quad_generator.hpp"
#include "halfspace/units/tile_walker.hpp"

namespace halfspace::passage {

inline void count(TileDecisions& tile, TileVerdict verdict) {
  ++(verdict == TileVerdict::kReject   ? tile.rejected
     : verdict == TileVerdict::kAccept ? tile.accepted
                                       : tile.partial);
}

/// A decision about a tile, for who keeps sums or looks on; `triangle` is its number in the draw.
inline void show_decision(int tile_x, int tile_y, TileVerdict verdict, std::uint32_t triangle,
                          const DrawContext& draw) {
  if (draw.sums != nullptr) {
    count(draw.sums->decisions.at(tile_x, tile_y), verdict);
  }
  if (draw.record_decisions) {
    draw.observer->decision({.draw = draw.draw,
                             .triangle = triangle,
                             .surface = draw.surface,
                             .tile_x = static_cast<std::uint32_t>(tile_x),
                             .tile_y = static_cast<std::uint32_t>(tile_y),
                             .verdict = verdict});
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
