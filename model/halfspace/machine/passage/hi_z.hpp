/// A block job's passage through hi_z: the unit and its counters.
#pragma once

#include <bit>
#include <cstdint>

#include "halfspace/machine/draw_context.hpp"
#include "halfspace/units/hi_z.hpp"

namespace halfspace::passage {

/// The tiles of `block`, of a triangle with this depth equation, that are left. `surface`: the place of the
/// draw's depth surface, looked at where it tests depth.
inline std::uint64_t hi_z(HiZ& unit, const BlockJob& block, const DepthEquation& equation,
                          const HiZSurface& surface, DrawContext& draw) {
  const std::uint64_t rejected = unit.decide(block, equation, draw.early_z, surface);
  HiZCounters& counters = draw.counters.hi_z;
  counters.tiles_rejected += static_cast<std::uint64_t>(std::popcount(rejected));
  counters.blocks_rejected += rejected == block.tiles ? 1 : 0;
  return block.tiles & ~rejected;
}

}  // namespace halfspace::passage
