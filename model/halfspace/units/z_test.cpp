#include "halfspace/units/z_test.hpp"

#include "halfspace/units/depth_barycentric.hpp"
#include "halfspace/units/depth_plane.hpp"

namespace halfspace {
namespace {

/// Calls visit(bit) for every set bit.
template <int TileSize, class Visit>
void for_each_sample(const TileMask& mask, Visit&& visit) {
  for (std::size_t i = 0; i < kMaskWords<TileSize>; ++i) {
    for (std::uint64_t left = mask.word[i]; left != 0; left &= left - 1) {
      visit(static_cast<int>(i) * 64 + std::countr_zero(left));
    }
  }
}

template <int TileSize, class Word, class Code>
void interpolate_plane(const PlaneEquation& plane, const Coverage& coverage, int sub_pixel_bits,
                       TileCodes<TileSize>& codes, Code&& code) {
  const TilePlane<Word> tile =
      tile_plane<Word>(plane, coverage.tile_x * TileSize, coverage.tile_y * TileSize, sub_pixel_bits);
  for_each_sample<TileSize>(coverage.mask, [&](int bit) {
    const auto at = static_cast<std::uint32_t>(bit);
    codes[at] = code(plane_word(plane, tile, at % TileSize, at / TileSize));
  });
}

template <int TileSize>
void interpolate_barycentric(const SetupTriangle& triangle, const Coverage& coverage, DepthFormat format,
                             int sub_pixel_bits, TileCodes<TileSize>& codes) {
  const DepthEquation& eq = triangle.depth;
  const auto weight_edge = [&](std::size_t i, int bit) {
    const Edge& edge = triangle.edge[i];
    const std::int64_t steps =
        std::int64_t{edge.a} * (bit % TileSize) + std::int64_t{edge.b} * (bit / TileSize);
    return coverage.e[i - 1] + eq.bias[i] + (steps << sub_pixel_bits);
  };
  const int fraction = vertex_depth_fraction(format);
  const bool is_float = format == DepthFormat::kFloat32;
  for_each_sample<TileSize>(coverage.mask, [&](int bit) {
    const std::int64_t e1 = weight_edge(1, bit);
    const std::int64_t e2 = weight_edge(2, bit);
    codes[static_cast<std::size_t>(bit)] =
        is_float ? barycentric_float(eq, e1, e2) : barycentric_unorm(eq, fraction, e1, e2);
  });
}

}  // namespace

template <int TileSize>
void interpolate_tile(const SetupTriangle& triangle, const QuadBurst& burst, const EarlyZState& state,
                      TileCodes<TileSize>& codes) {
  const Coverage& coverage = burst.coverage;
  const PlaneEquation& plane = triangle.depth.plane;
  if (state.interpolator == DepthInterpolator::kBarycentric) {
    interpolate_barycentric<TileSize>(triangle, coverage, state.format, state.sub_pixel_bits, codes);
  } else if (state.format == DepthFormat::kFloat32) {
    interpolate_plane<TileSize, std::uint64_t>(
        plane, coverage, state.sub_pixel_bits, codes,
        [&](std::uint64_t word) { return float_of_word(word, plane); });
  } else {
    const int fraction = vertex_depth_fraction(state.format);
    interpolate_plane<TileSize, std::uint32_t>(
        plane, coverage, state.sub_pixel_bits, codes,
        [&](std::uint32_t word) { return unorm_of_word(word, fraction); });
  }
}

template <int TileSize>
TileMask z_test(const SetupTriangle& triangle, const QuadBurst& burst, const EarlyZState& state,
                std::uint32_t* stored, TileCodes<TileSize>& codes) {
  if (!state.test) {
    return burst.coverage.mask;
  }
  interpolate_tile<TileSize>(triangle, burst, state, codes);
  TileMask passed;
  for_each_sample<TileSize>(burst.coverage.mask, [&](int bit) {
    const std::uint32_t code = codes[static_cast<std::size_t>(bit)];
    const bool pass = depth_passes(state.func, code, stored[bit]);
    passed.word[static_cast<std::size_t>(bit / 64)] |= std::uint64_t{pass} << (bit % 64);
    if (pass && state.write) {
      stored[bit] = code;
    }
  });
  return passed;
}

#define HALFSPACE_INSTANTIATE(size)                                                                          \
  template void interpolate_tile<size>(const SetupTriangle&, const QuadBurst&, const EarlyZState&,           \
                                       TileCodes<size>&);                                                    \
  template TileMask z_test<size>(const SetupTriangle&, const QuadBurst&, const EarlyZState&, std::uint32_t*, \
                                 TileCodes<size>&);
HALFSPACE_INSTANTIATE(4)
HALFSPACE_INSTANTIATE(8)
HALFSPACE_INSTANTIATE(16)
#undef HALFSPACE_INSTANTIATE

}  // namespace halfspace
