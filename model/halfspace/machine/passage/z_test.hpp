/// A burst's passage through the test of early_z: the unit and its counters.
#pragma once

#include <cstdint>

#include "halfspace/machine/draw_context.hpp"
#include "halfspace/machine/passage/quad_generator.hpp"
#include "halfspace/units/z_test.hpp"

namespace halfspace::passage {

/// Counts what became of a burst's fragments.
inline void count_z_test(DrawContext& draw, int fragments, int survivors) {
  EarlyZCounters& counters = draw.counters.early_z;
  const auto passed = static_cast<std::uint64_t>(survivors);
  (draw.early_z.test ? counters.tested : counters.untested) += static_cast<std::uint64_t>(fragments);
  counters.survivors += passed;
  counters.written += draw.early_z.write ? passed : 0;
  counters.tiles_killed += survivors == 0 ? 1 : 0;
}

/// Depth codes that leave with the burst, where somebody looks at them: with the test off they are
/// interpolated all the same, and where the target has no depth surface they are 0.
template <int TileSize>
void complete_codes(const SetupTriangle& triangle, const QuadBurst& burst, const EarlyZState& state,
                    TileCodes<TileSize>& codes) {
  if (state.format == DepthFormat::kNone) {
    codes = {};
  } else if (!state.test) {
    interpolate_tile<TileSize>(triangle, burst, state, codes);
  }
}

/// The samples that pass. `stored`: the tile's codes in the surface, null where the test is off; those that
/// pass are written there. `codes` is filled where the test is on, or where the draw's quads are recorded.
template <int TileSize>
TileMask z_test(const SetupTriangle& triangle, const Burst& burst, DrawContext& draw, std::uint32_t* stored,
                TileCodes<TileSize>& codes) {
  const TileMask passed = halfspace::z_test<TileSize>(triangle, burst.packet, draw.early_z, stored, codes);
  count_z_test(draw, burst.fragments, popcount<TileSize>(passed));
  if (draw.record_quads) {
    complete_codes<TileSize>(triangle, burst.packet, draw.early_z, codes);
  }
  return passed;
}

}  // namespace halfspace::passage
