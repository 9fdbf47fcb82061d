/// Random triangles and their bursts, by the C++ units.
#pragma once

#include <cstdint>
#include <vector>

#include "common/random.hpp"
#include "halfspace/numerics/conservative.hpp"
#include "halfspace/numerics/depth.hpp"
#include "halfspace/numerics/widths.hpp"
#include "halfspace/units/link_packets.hpp"
#include "halfspace/units/packets.hpp"
#include "halfspace/units/z_test.hpp"

namespace halfspace::tb {

/// Which pixels triangles have.
struct Squares {
  Conservative mode = Conservative::kOff;
  int uncertainty = 0;

  [[nodiscard]] int reach(const Widths& widths) const {
    return square_reach(mode, uncertainty, widths.SubPixelBits);
  }
};

/// A triangle inside `width` x `height` pixels, or across their borders, that is drawn: slivers, small, large
/// and guard-band triangles; depths that are random, nearly equal, tiny, at the ends or beyond them; with and
/// without an offset and limits.
[[nodiscard]] SetupTriangle random_triangle(const Widths& widths, DepthFormat format,
                                            DepthInterpolator interpolator, int width, int height,
                                            Random& random, const Squares& squares = {});

/// The bursts of a triangle in row order of tiles, at most `most` of them from a random one on.
[[nodiscard]] std::vector<QuadBurst> bursts_of(const Widths& widths, const SetupTriangle& triangle,
                                               std::size_t most, Random& random);

/// Calls visit(std::integral_constant<int, TileSize>).
template <class Visit>
auto with_tile(int tile_size, Visit&& visit) {
  return tile_size == 4   ? visit(std::integral_constant<int, 4>())
         : tile_size == 8 ? visit(std::integral_constant<int, 8>())
                          : visit(std::integral_constant<int, 16>());
}

}  // namespace halfspace::tb
