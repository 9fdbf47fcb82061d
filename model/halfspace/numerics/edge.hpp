/// Arithmetic of edge values that the units and their RTL share. Background and proofs: docs/numerics.md.
#pragma once

#include <algorithm>
#include <cstdint>

#include "halfspace/numerics/widths.hpp"

namespace halfspace {

/// floor(e / 2^sub_pixel_bits). At pixel centres E is the same modulo 2^sub_pixel_bits all along an edge, so
/// the low bits never decide coverage.
constexpr std::int64_t drop_sub_pixel(std::int64_t e, int sub_pixel_bits) { return e >> sub_pixel_bits; }

/// Largest magnitude that is kept of an edge value inside a tile: more than |a| + |b| can add up to across
/// it. It depends on the tile only; every sub-pixel precision fits the widest steps.
template <int TileSize>
constexpr std::int32_t local_edge_limit() {
  constexpr int kStepBits = Widths{.SubPixelBits = 8, .TileSize = TileSize}.StepBits;
  return (TileSize << kStepBits) - 1;
}

/// An edge value at the tile origin in pixel steps, saturated so that 32-bit adders serve for the whole tile.
/// The sign of value + x * a + y * b is unchanged for every 0 <= x, y < TileSize.
template <int TileSize>
constexpr std::int32_t saturate_local_edge(std::int64_t pixel_edge) {
  constexpr std::int64_t kLimit = local_edge_limit<TileSize>();
  return static_cast<std::int32_t>(std::clamp(pixel_edge, -kLimit - 1, kLimit));
}

}  // namespace halfspace
