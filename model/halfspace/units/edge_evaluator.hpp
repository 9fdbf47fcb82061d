/// edge_evaluator: from a tile job to the coverage mask of the tile.
///
/// Coverage is exact (docs/numerics.md): a sample is inside when all three edge values are >= 0, the fill
/// rule being folded into them. An edge whose accept bit is set is not looked at.
#pragma once

#include "halfspace/numerics/edge.hpp"
#include "halfspace/units/packets.hpp"
#include "halfspace/units/tile_mask.hpp"

namespace halfspace {

/// The samples of a tile that are inside one edge, given its saturated value at the tile origin.
template <int TileSize>
constexpr TileMask half_plane(std::int32_t local_edge, std::int32_t a, std::int32_t b) {
  TileMask mask;
  for (int y = 0; y < TileSize; ++y) {
    std::uint32_t outside = 0;  // the sign bits; x falls, so that one shift serves all
    for (int x = TileSize - 1; x >= 0; --x) {
      outside = 2 * outside + (static_cast<std::uint32_t>(local_edge + x * a + y * b) >> 31);
    }
    set_row<TileSize>(mask, y, outside ^ ((1U << TileSize) - 1));
  }
  return mask;
}

/// `job` must satisfy the widths of its packet for `sub_pixel_bits` (4 to 8).
template <int TileSize>
constexpr Coverage edge_evaluator(const TileJob& job, int sub_pixel_bits) {
  Coverage coverage{.slot = job.slot,
                    .tile_x = job.tile_x,
                    .tile_y = job.tile_y,
                    .sure = job.sure,
                    .e = {job.e[1], job.e[2]},
                    .mask = {}};
  coverage.mask = rect_mask<TileSize>(job.x_first, job.x_last, job.y_first, job.y_last);
  for (std::size_t i = 0; i < 3; ++i) {
    if ((job.accept >> i & 1) != 0) {
      continue;
    }
    const std::int32_t local = saturate_local_edge<TileSize>(drop_sub_pixel(job.e[i], sub_pixel_bits));
    coverage.mask &= half_plane<TileSize>(local, job.a[i], job.b[i]);
  }
  return coverage;
}

}  // namespace halfspace
