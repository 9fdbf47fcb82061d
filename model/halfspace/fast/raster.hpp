/// The kernels of the fast core: walkers, edge evaluator, quad generator and early_z of one triangle
/// after the other, with the blocks of a row, the tiles of a block or the samples of a tile in the lanes of a
/// vector. One version an instruction set.
#pragma once

#include <cstdint>

#include "halfspace/fast/block_cache.hpp"
#include "halfspace/fast/set_up.hpp"
#include "halfspace/fast/surface_tiles.hpp"
#include "halfspace/machine/draw_context.hpp"
#include "halfspace/machine/frame_result.hpp"
#include "halfspace/machine/stream_writer.hpp"
#include "halfspace/units/packets.hpp"
#include "halfspace/units/square_edges.hpp"
#include "halfspace/units/z_cache.hpp"

namespace halfspace::fast {

/// Columns of blocks: every so many-th, a power of two up to kMost.
struct Columns {
  static constexpr std::uint32_t kMost = 8;

  std::uint32_t mask = 0;  ///< of a column's number
  std::uint32_t own = 0;   ///< what is under it

  [[nodiscard]] bool all() const { return mask == 0; }
  [[nodiscard]] bool has(std::uint32_t x) const { return (x & mask) == own; }
  /// Of the 8 columns from `x` on those that belong to them, a bit each.
  [[nodiscard]] std::uint32_t lanes(std::uint32_t x) const {
    constexpr std::uint32_t kEvery[] = {0xFF, 0x55, 0, 0x11, 0, 0, 0, 0x01};
    return kEvery[mask] << ((own - x) & mask) & 0xFF;
  }
};

/// A draw, and what its triangles work on. `tiles` and `surface` are null where the target has no
/// depth, and nobody watches.
struct RasterTask {
  DrawContext* draw = nullptr;
  Columns columns;  ///< that are drawn
  WalkerConfig walker;
  SurfaceTiles* tiles = nullptr;
  Surface* surface = nullptr;
  bool counts_pixels = false;
  BlockCache* cache = nullptr;   ///< the z cache, or null where it is too small to go by blocks
  BlockSurface cached;           ///< the surface's blocks
  ZCache* tile_cache = nullptr;  ///< else the z cache, and the surface's tiles
  ZSurface place;
  int z_parts = 1;
  StreamWriter* stream = nullptr;  ///< where somebody reads
};

/// Whether raster() takes `triangle`: its steps must fit the vectors' integers.
bool raster_takes(const SetupTriangle& triangle, const WalkerConfig& walker);

/// Draws triangles, all of which it takes. `tile_size` is 4 or 8. A full part of the stream is given away.
void raster(int tile_size, const RasterTask& task, const SetUpTriangles& triangles);

/// Takes the triangles that reach blocks of `columns`, in order. They need those of `in` still.
void take_share(const SetUpTriangles& in, Columns columns, int block_size, SetUpTriangles& out);

/// Makes the codes of all tiles in `columns` of a surface that are planes.
void resolve(int tile_size, int sub_pixel_bits, Columns columns, Surface& surface, SurfaceTiles& tiles);

/// Adds what has been counted of pixels to the image's values, up to the largest.
void put_counts(int tile_size, const SurfaceTiles& tiles, Surface& surface);

/// Codes of a tile by the units, from an equation of the interpolator `plane`. `codes`: TileSize^2, in row
/// order.
template <int TileSize>
void codes_by_units(const DepthEquation& equation, DepthFormat format, int sub_pixel_bits, int tile_x,
                    int tile_y, std::uint32_t* codes);

}  // namespace halfspace::fast
