#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "halfspace/fast/raster.cpp"
#include <hwy/foreach_target.h>
// after foreach_target, as Highway asks
#include <hwy/highway.h>

#include "halfspace/fast/pixel_counts-inl.hpp"
#include "halfspace/fast/raster-inl.hpp"
#include "halfspace/fast/set_up-inl.hpp"
#include "halfspace/fast/share-inl.hpp"

#if HWY_ONCE
#include <algorithm>
#include <cstdlib>

namespace halfspace::fast {

HWY_EXPORT(raster_4);
HWY_EXPORT(set_up_triangles);
HWY_EXPORT(raster_8);
HWY_EXPORT(resolve_4);
HWY_EXPORT(resolve_8);
HWY_EXPORT(put_counts_4);
HWY_EXPORT(put_counts_8);
HWY_EXPORT(take_share_of);

bool raster_takes(const SetupTriangle& triangle, const WalkerConfig& walker) {
  // A value saturated at a block's first sample, and all steps across the block, together fit 31 bits.
  for (const Edge& edge : triangle.edge) {
    const std::int64_t steps = std::abs(std::int64_t{edge.a}) + std::abs(std::int64_t{edge.b});
    if (steps * walker.block_size >= std::int64_t{1} << 30) {
      return false;
    }
  }
  return true;
}

void raster(int tile_size, const RasterTask& task, const SetUpTriangles& triangles) {
  if (tile_size == 4) {
    HWY_DYNAMIC_DISPATCH(raster_4)(task, triangles);
  } else {
    HWY_DYNAMIC_DISPATCH(raster_8)(task, triangles);
  }
}

std::uint32_t set_up(const FrontEndTask& task, std::uint32_t first, std::uint32_t end, VertexChunk& chunk,
                     SetUpTriangles& out, FrontEndCounters& front_end, SetupCounters& setup) {
  return HWY_DYNAMIC_DISPATCH(set_up_triangles)(task, first, end, chunk, out, front_end, setup);
}

void take_share(const SetUpTriangles& in, Columns columns, int block_size, SetUpTriangles& out) {
  HWY_DYNAMIC_DISPATCH(take_share_of)(in, columns, block_size, out);
}

void resolve(int tile_size, int sub_pixel_bits, Columns columns, Surface& surface, SurfaceTiles& tiles) {
  if (tile_size == 4) {
    HWY_DYNAMIC_DISPATCH(resolve_4)(sub_pixel_bits, columns, surface, tiles);
  } else {
    HWY_DYNAMIC_DISPATCH(resolve_8)(sub_pixel_bits, columns, surface, tiles);
  }
}

void put_counts(int tile_size, const SurfaceTiles& tiles, Surface& surface) {
  if (tile_size == 4) {
    HWY_DYNAMIC_DISPATCH(put_counts_4)(tiles, surface);
  } else {
    HWY_DYNAMIC_DISPATCH(put_counts_8)(tiles, surface);
  }
}

template <int TileSize>
void codes_by_units(const DepthEquation& equation, DepthFormat format, int sub_pixel_bits, int tile_x,
                    int tile_y, std::uint32_t* codes) {
  SetupTriangle triangle;
  triangle.depth = equation;
  QuadBurst burst;
  burst.coverage.tile_x = static_cast<std::uint16_t>(tile_x);
  burst.coverage.tile_y = static_cast<std::uint16_t>(tile_y);
  burst.coverage.mask = full_mask<TileSize>();
  TileCodes<TileSize> made;
  interpolate_tile<TileSize>(triangle, burst, {.format = format, .sub_pixel_bits = sub_pixel_bits}, made);
  std::ranges::copy(made, codes);
}
template void codes_by_units<4>(const DepthEquation&, DepthFormat, int, int, int, std::uint32_t*);
template void codes_by_units<8>(const DepthEquation&, DepthFormat, int, int, int, std::uint32_t*);

}  // namespace halfspace::fast
#endif
