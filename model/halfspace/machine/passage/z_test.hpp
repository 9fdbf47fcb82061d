/// A burst's passage through the test of early_z: the unit and its counters.
#pragma once

#include <cstdint>

#include "halfspace/machine/draw_context.hpp"
#include "halfspace/machine/frame_result.hpp"
#include "halfspace/machine/passage/quad_generator.hpp"
#include "halfspace/units/inner_coverage.hpp"
#include "halfspace/units/z_test.hpp"

namespace halfspace::passage {

/// Counts what became of a burst's fragments. `kept`: survivors that the shader does not discard.
/// `inner`: fragments whose pixel the triangle fills.
inline void count_z_test(DrawContext& draw, int fragments, int survivors, int kept, int inner) {
  EarlyZCounters& counters = draw.counters.early_z;
  const auto passed = static_cast<std::uint64_t>(survivors);
  (draw.early_z.test ? counters.tested : counters.untested) += static_cast<std::uint64_t>(fragments);
  counters.survivors += passed;
  counters.written += draw.early_z.write ? static_cast<std::uint64_t>(kept) : 0;
  counters.discarded += static_cast<std::uint64_t>(survivors - kept);
  counters.tiles_killed += survivors == 0 ? 1 : 0;
  counters.inner += static_cast<std::uint64_t>(inner);
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

/// Of the samples of a tile that passed, those that the shader does not discard.
template <int TileSize>
TileMask kept(const TileMask& passed, int tile_x, int tile_y, std::uint32_t triangle,
              const DrawContext& draw) {
  return draw.early_z.late ? shader_keeps<TileSize>(draw.discard, passed, draw.draw, triangle, tile_x, tile_y)
                           : passed;
}

/// What is stored in a tile of the surface that a draw is drawn on; null where that has no depth.
inline std::uint32_t* stored_codes(Surface& surface, const DrawContext& draw, const Coverage& coverage) {
  return draw.surface == kNoSurface ? nullptr : surface.codes.tile(coverage.tile_x, coverage.tile_y);
}

struct Tested {
  TileMask passed;
  TileMask kept;   ///< by the shader
  TileMask inner;  ///< of the covered pixels those that the triangle fills; none without inner coverage
};

/// Tested::inner of a burst.
template <int TileSize>
TileMask inner(const SetupTriangle& triangle, const Coverage& coverage, const EarlyZState& state) {
  return state.inner_coverage
             ? inner_coverage<TileSize>(triangle, coverage, state.sub_pixel_bits, state.square_reach)
             : TileMask{};
}

/// Tests a burst. `stored`: the tile's codes, null where the target has no depth; those that
/// pass are written there, where the draw does not write late: then write_late() follows. `codes` is filled
/// where the test is on, or where the draw's quads are recorded.
template <int TileSize>
Tested z_test(const SetupTriangle& triangle, const Burst& burst, DrawContext& draw, std::uint32_t* stored,
              TileCodes<TileSize>& codes) {
  const Coverage& coverage = burst.packet.coverage;
  Tested tested;
  tested.passed = halfspace::z_test<TileSize>(triangle, burst.packet, draw.early_z, stored, codes);
  tested.kept = kept<TileSize>(tested.passed, coverage.tile_x, coverage.tile_y, triangle.triangle, draw);
  tested.inner = inner<TileSize>(triangle, coverage, draw.early_z);
  count_z_test(draw, burst.fragments, popcount<TileSize>(tested.passed), popcount<TileSize>(tested.kept),
               popcount<TileSize>(tested.inner));
  if (draw.record_quads) {
    complete_codes<TileSize>(triangle, burst.packet, draw.early_z, codes);
  }
  return tested;
}

/// Writes what the shader keeps of a burst, where its draw is late. Whatever time that takes, no other burst
/// sees the line before.
template <int TileSize>
void write_late(const Tested& tested, const TileCodes<TileSize>& codes, const DrawContext& draw,
                std::uint32_t* stored) {
  if (draw.early_z.late) {
    write_codes<TileSize>(codes.data(), tested.kept, stored);
  }
}

}  // namespace halfspace::passage
