#include "halfspace/units/z_test.hpp"

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

}  // namespace

template <int TileSize>
void interpolate_tile(const SetupTriangle& triangle, const QuadBurst& burst, const EarlyZState& state,
                      TileCodes<TileSize>& codes) {
  const Coverage& coverage = burst.coverage;
  const DepthEquation& eq = triangle.depth;
  if (state.interpolator == DepthInterpolator::kPlane) {
    for_each_sample<TileSize>(coverage.mask, [&](int bit) {
      codes[static_cast<std::size_t>(bit)] =
          plane_code(eq, state.format, coverage.tile_x * TileSize + bit % TileSize,
                     coverage.tile_y * TileSize + bit / TileSize);
    });
    return;
  }
  const auto weight_edge = [&](std::size_t i, int bit) {
    const Edge& edge = triangle.edge[i];
    const std::int64_t steps =
        std::int64_t{edge.a} * (bit % TileSize) + std::int64_t{edge.b} * (bit / TileSize);
    return coverage.e[i - 1] + eq.bias[i] + (steps << state.sub_pixel_bits);
  };
  const int fraction = vertex_depth_fraction(state.format);
  const bool is_float = state.format == DepthFormat::kFloat32;
  for_each_sample<TileSize>(coverage.mask, [&](int bit) {
    const std::int64_t e1 = weight_edge(1, bit);
    const std::int64_t e2 = weight_edge(2, bit);
    codes[static_cast<std::size_t>(bit)] =
        is_float ? barycentric_float(eq, e1, e2) : barycentric_unorm(eq, fraction, e1, e2);
  });
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
