/// Triangles for the benches of the walkers, all of them made by the C++ setup().
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "halfspace/numerics/sample_pattern.hpp"
#include "halfspace/numerics/widths.hpp"
#include "halfspace/units/packets.hpp"
#include "random.hpp"

namespace halfspace::tb {

/// What the walk of a triangle depends on.
struct WalkSizes {
  int tile_size = 8;
  int block_size = 32;
  int sub_pixel_bits = 8;
  int samples = 1;  ///< of a pixel, at the standard positions

  [[nodiscard]] Widths widths() const {
    return Widths{.SubPixelBits = sub_pixel_bits,
                  .PixelSamples = samples,
                  .BlockSize = block_size,
                  .TileSize = tile_size};
  }
  [[nodiscard]] SamplePattern pattern() const { return standard_samples(samples); }
  [[nodiscard]] int row_tiles() const { return block_size / tile_size; }
};

/// Cases that a random search might miss: one pixel at every place of a block, bounds at the edges of blocks
/// and of the screen, edges along rows and columns of samples, triangles that cover nothing, the guard band.
[[nodiscard]] std::vector<SetupTriangle> directed_triangles(const WalkSizes& sizes);

/// One triangle of a random kind: of a pixel, of a tile, of blocks, slivers, on samples, at the guard
/// band, large, at the edges of the screen; some of them cut by a scissor.
[[nodiscard]] SetupTriangle random_triangle(const WalkSizes& sizes, Random& random);

/// The triangles that setup gives for a frame (.ptf and the like), in their order.
[[nodiscard]] std::vector<SetupTriangle> frame_triangles(const std::string& file, const WalkSizes& sizes);

/// Two triangles of `size` pixels square that cover it.
[[nodiscard]] std::vector<SetupTriangle> square_triangles(int x, int y, int size, const WalkSizes& sizes);

}  // namespace halfspace::tb
