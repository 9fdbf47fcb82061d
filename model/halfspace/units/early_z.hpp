/// early_z: interpolates depth at the covered samples of a tile's quads, tests it against the surface and
/// writes it.
#pragma once

#include <array>
#include <cstdint>

#include "halfspace/numerics/depth.hpp"
#include "halfspace/units/depth_interpolator.hpp"
#include "halfspace/units/packets.hpp"
#include "halfspace/units/tile_mask.hpp"

namespace halfspace {

/// The state of a draw that early_z looks at.
struct EarlyZState {
  bool test = false;   ///< off: every fragment passes and nothing is written
  bool write = false;  ///< passing fragments write; only with the test on
  DepthFunc func = DepthFunc::kAlways;
  DepthFormat format = DepthFormat::kNone;
  DepthInterpolator interpolator = DepthInterpolator::kBarycentric;
  int sub_pixel_bits = 8;
};

/// Depth codes of a tile in row order; those of samples that are not covered mean nothing.
template <int TileSize>
using TileCodes = std::array<std::uint32_t, TileSize * TileSize>;

/// Codes at the covered samples of the burst.
template <int TileSize>
void interpolate_tile(const SetupTriangle& triangle, const QuadBurst& burst, const EarlyZState& state,
                      TileCodes<TileSize>& codes);

/// Tests the burst against `stored`, the tile's codes in the surface (TileSize^2, row order), writes those
/// that pass where the state says so, and returns the mask of the samples that passed. Fills `codes` when the
/// test is on.
template <int TileSize>
TileMask early_z(const SetupTriangle& triangle, const QuadBurst& burst, const EarlyZState& state,
                 std::uint32_t* stored, TileCodes<TileSize>& codes);

}  // namespace halfspace
