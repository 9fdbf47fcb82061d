/// A block job's passage through hi_z: the unit, its counters and events.
#pragma once

#include <bit>
#include <cstdint>

#include "halfspace/machine/draw_context.hpp"
#include "halfspace/units/hi_z.hpp"

namespace halfspace::passage {

/// What is left of `block`, of a triangle with this depth equation: a block without a tile where that is
/// nothing. `surface`: the place of the draw's depth surface, looked at where it tests depth.
inline void hi_z(HiZ& unit, BlockJob& block, const DepthEquation& equation, const HiZSurface& surface,
                 DrawContext& draw) {
  const HiZ::Verdict verdict = unit.decide(block, equation, draw.early_z, surface);
  HiZCounters& counters = draw.counters.hi_z;
  counters.tiles_rejected += static_cast<std::uint64_t>(std::popcount(verdict.rejected));
  counters.blocks_rejected += verdict.rejected == block.tiles ? 1 : 0;
  counters.tiles_sure += static_cast<std::uint64_t>(std::popcount(verdict.sure));
  if (draw.record_walk) {
    draw.observer->hi_z_decided(block, verdict.rejected);
  }
  block.slot = verdict.slot;
  block.tiles &= ~verdict.rejected;
  block.sure = verdict.sure;
}

/// What hi_z is told of a burst that touched `touched`, of `parts`. `stored`: the tile's codes (TileSize^2,
/// row order) after its test, without what it writes late. Nothing where hi_z does not look at the surface.
template <int TileSize>
HiZUpdate hi_z_update(const DrawContext& draw, const DepthEquation& equation, const std::uint32_t* stored,
                      std::uint8_t touched, int parts) {
  HiZUpdate update =
      halfspace::hi_z_update<TileSize>(stored, draw.early_z.unrestricted ? std::uint8_t{0} : touched, parts);
  if (draw.early_z.late) {
    allow_for_late_write(update, equation, draw.early_z);
  }
  return update;
}

}  // namespace halfspace::passage
