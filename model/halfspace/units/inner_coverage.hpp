/// inner_coverage, of early_z: which covered pixels of a tile the triangle fills. It is what tier 3 of
/// conservative rasterization tells a shader beside outer pixels (SV_InnerCoverage of Direct3D).
///
/// A pixel is an inner one where no edge function is below 0 at the corner of its square where it is least: E
/// at the centre is no less than to_square() (numerics/conservative.hpp). E of edges 1 and 2 comes with the
/// coverage, that of edge 0 is 2A less both.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "halfspace/numerics/conservative.hpp"
#include "halfspace/units/packets.hpp"
#include "halfspace/units/tile_mask.hpp"

namespace halfspace {

/// Of the covered pixels of a triangle that is drawn by outer squares, of reach `reach` above 0
/// (square_reach()). A triangle without area has none: no square of a line is on the inner side of both of
/// its edges, and a point has an edge of no length.
template <int TileSize>
constexpr TileMask inner_coverage(const SetupTriangle& triangle, const Coverage& coverage, int sub_pixel_bits,
                                  int reach) {
  TileMask inner;
  if (triangle.edge[1].a == 0 && triangle.edge[1].b == 0) {
    return inner;
  }
  std::array<std::int64_t, 3> square{};
  for (std::size_t i = 0; i < 3; ++i) {
    square[i] = to_square(triangle.edge[i].a, triangle.edge[i].b, reach);
  }
  const auto at_centre = [&](std::size_t i, int x, int y) {
    const Edge& edge = triangle.edge[i];
    return coverage.e[i - 1] - square[i] +
           (std::int64_t{edge.a} * x + std::int64_t{edge.b} * y) * (std::int64_t{1} << sub_pixel_bits);
  };
  for (std::size_t word = 0; word < kMaskWords<TileSize>; ++word) {
    for (std::uint64_t left = coverage.mask.word[word]; left != 0; left &= left - 1) {
      const int bit = std::countr_zero(left);
      const int place = static_cast<int>(word) * 64 + bit;
      const std::int64_t e1 = at_centre(1, place % TileSize, place / TileSize);
      const std::int64_t e2 = at_centre(2, place % TileSize, place / TileSize);
      const std::int64_t e0 = triangle.depth.area2 - e1 - e2;
      const bool fills = e0 >= square[0] && e1 >= square[1] && e2 >= square[2];
      inner.word[word] |= std::uint64_t{fills} << bit;
    }
  }
  return inner;
}

}  // namespace halfspace
