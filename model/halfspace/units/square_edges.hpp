/// The three edges of a triangle at the samples of a square.
///
/// An edge function is linear, so over the samples of a square it is largest and least at corners: two
/// numbers decide it (N. Greene, "Hierarchical Polygon Tiling with Coverage Masks", SIGGRAPH 1996). Corners
/// of the area would be a looser test than corner samples.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "halfspace/numerics/sample_pattern.hpp"
#include "halfspace/units/walk_order.hpp"

namespace halfspace {

/// How the walk over blocks and tiles is done. Every choice gives the same coverage.
struct WalkerConfig {
  int sub_pixel_bits = 8;
  int block_size = 32;  ///< pixels; 2, 4 or 8 tiles
  bool trivial_reject = true;
  bool trivial_accept = true;
  bool sample_reject = false;
  int levels =
      2;  ///< what a step decides: 1 a tile, 2 the tiles of a block, 3 also the blocks of a superblock
  WalkOrder order = WalkOrder::kRaster;       ///< of the steps
  TileOrder tile_order = TileOrder::kRaster;  ///< of the tiles of a block
  SamplePattern samples{};
};

/// Edges by the pixel, at one place of each: "the sample" of a square of pixels.
struct SquareEdges {
  std::array<std::int64_t, 3> e{};   ///< at the top left sample
  std::array<std::int64_t, 3> dx{};  ///< change for one pixel
  std::array<std::int64_t, 3> dy{};

  SquareEdges(const std::array<std::int64_t, 3>& first, const std::array<std::int32_t, 3>& a,
              const std::array<std::int32_t, 3>& b, int sub_pixel_bits)
      : e(first) {
    for (std::size_t i = 0; i < 3; ++i) {
      dx[i] = std::int64_t{a[i]} << sub_pixel_bits;
      dy[i] = std::int64_t{b[i]} << sub_pixel_bits;
    }
  }

  /// At the sample x to the right and y below.
  [[nodiscard]] std::array<std::int64_t, 3> at(int x, int y) const {
    return {e[0] + dx[0] * x + dy[0] * y, e[1] + dx[1] * x + dy[1] * y, e[2] + dx[2] * x + dy[2] * y};
  }

  /// From the top left sample of a square of `size` pixels to where edge i is largest in it.
  [[nodiscard]] std::int64_t to_largest(std::size_t i, int size) const {
    return (std::max<std::int64_t>(dx[i], 0) + std::max<std::int64_t>(dy[i], 0)) * (size - 1);
  }
  [[nodiscard]] std::int64_t to_least(std::size_t i, int size) const {
    return (std::min<std::int64_t>(dx[i], 0) + std::min<std::int64_t>(dy[i], 0)) * (size - 1);
  }
};

/// What E changes by from the centre of a pixel to its sample.
constexpr std::int64_t to_sample(std::int32_t a, std::int32_t b, const SamplePosition& sample,
                                 int sub_pixel_bits) {
  return std::int64_t{a} * sample_way(sample.x - kSampleGrid / 2, sub_pixel_bits) +
         std::int64_t{b} * sample_way(sample.y - kSampleGrid / 2, sub_pixel_bits);
}

/// To the corner of the box of the samples where E is largest: at no sample is it larger.
constexpr std::int64_t to_largest_sample(std::int32_t a, std::int32_t b, const SampleBox& box,
                                         int sub_pixel_bits) {
  const SamplePosition corner{.x = a > 0 ? box.x_most : box.x_least, .y = b > 0 ? box.y_most : box.y_least};
  return to_sample(a, b, corner, sub_pixel_bits);
}

}  // namespace halfspace
