#include "halfspace/units/z_test.hpp"

#include <algorithm>
#include <limits>

#include "halfspace/numerics/conservative.hpp"
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

/// The plane in words of a size; code(word) is the stored code, not yet clamped.
template <int TileSize, class Word, class Code>
void interpolate_plane(const DepthEquation& eq, const Coverage& coverage, const EarlyZState& state,
                       TileCodes<TileSize>& codes, Code&& code) {
  const SamplePattern& samples = state.samples;
  const SamplePosition& sample = samples.at[static_cast<std::size_t>(coverage.tile_x % samples.count)];
  const TilePlane<Word> tile = tile_plane<Word>(eq.plane, coverage.tile_x / samples.count * TileSize,
                                                coverage.tile_y * TileSize, state.sub_pixel_bits, sample);
  for_each_sample<TileSize>(coverage.mask, [&](int bit) {
    const auto at = static_cast<std::uint32_t>(bit);
    const std::int64_t stored = code(tile.at(at % TileSize, at / TileSize));
    codes[at] = static_cast<std::uint32_t>(
        std::clamp<std::int64_t>(stored, code_order(eq.min_code), code_order(eq.max_code)));
  });
}

template <int TileSize>
void interpolate_plane(const DepthEquation& eq, const Coverage& coverage, const EarlyZState& state,
                       TileCodes<TileSize>& codes) {
  const auto interpolate = [&]<class Word>(Word, auto&& code) {
    if (state.square_reach <= 0) {
      interpolate_plane<TileSize, Word>(eq, coverage, state, codes, code);
      return;
    }
    // The centre may be outside: what no word of the vertices holds is beyond all of them.
    using Signed = decltype(signed_word(Word{}));
    using Limits = std::numeric_limits<Signed>;
    interpolate_plane<TileSize, WideWord>(eq, coverage, state, codes, [&](Int128 word) {
      return code(static_cast<Signed>(std::clamp<Int128>(word, Limits::min(), Limits::max())));
    });
  };
  if (state.format == DepthFormat::kFloat32) {
    interpolate(LongWord{}, [&](std::int64_t word) {
      return std::int64_t{code_order(code_of_word(Int128{word} + eq.offset, eq.exponent))};
    });
    return;
  }
  int fraction = vertex_depth_fraction(state.format);
  if (!eq.beyond) {
    const std::int64_t offset = eq.offset + (std::int64_t{1} << (fraction - 1));
    interpolate(ShortWord{}, [&](std::int32_t word) { return (word + offset) >> fraction; });
    return;
  }
  fraction += kLongWordFraction - kVertexDepthBits - eq.exponent;
  const Int128 offset = Int128{word_of_unorm(eq.offset, eq.exponent)} + (Int128{1} << (fraction - 1));
  interpolate(LongWord{},
              [&](std::int64_t word) { return static_cast<std::int64_t>((word + offset) >> fraction); });
}

template <int TileSize>
void interpolate_barycentric(const SetupTriangle& triangle, const Coverage& coverage,
                             const EarlyZState& state, TileCodes<TileSize>& codes) {
  const DepthEquation& eq = triangle.depth;
  const auto weight_edge = [&](std::size_t i, int bit) {
    const Edge& edge = triangle.edge[i];
    const std::int64_t steps =
        std::int64_t{edge.a} * (bit % TileSize) + std::int64_t{edge.b} * (bit / TileSize);
    return coverage.e[i - 1] + eq.bias[i] - to_square(edge.a, edge.b, state.square_reach) +
           (steps << state.sub_pixel_bits);
  };
  const bool is_float = state.format == DepthFormat::kFloat32;
  const int fraction = vertex_depth_fraction(state.format);
  const std::int64_t offset = eq.offset + (std::int64_t{1} << (fraction - 1));
  for_each_sample<TileSize>(coverage.mask, [&](int bit) {
    std::int64_t e1 = weight_edge(1, bit);
    std::int64_t e2 = weight_edge(2, bit);
    if (state.square_reach > 0) {  // the centre may be outside: depth is that of a point inside
      e1 = std::clamp<std::int64_t>(e1, 0, eq.area2);
      e2 = std::clamp<std::int64_t>(e2, 0, eq.area2 - e1);
    }
    const std::int64_t stored = is_float ? std::int64_t{code_order(barycentric_float(eq, e1, e2))}
                                         : (barycentric_unorm(eq, e1, e2) + offset) >> fraction;
    codes[static_cast<std::size_t>(bit)] = static_cast<std::uint32_t>(
        std::clamp<std::int64_t>(stored, code_order(eq.min_code), code_order(eq.max_code)));
  });
}

}  // namespace

template <int TileSize>
void interpolate_tile(const SetupTriangle& triangle, const QuadBurst& burst, const EarlyZState& state,
                      TileCodes<TileSize>& codes) {
  const DepthEquation& eq = triangle.depth;
  if (eq.min_code == eq.max_code) {
    codes.fill(eq.min_code);
  } else if (state.interpolator == DepthInterpolator::kPlane) {
    interpolate_plane<TileSize>(eq, burst.coverage, state, codes);
  } else {
    interpolate_barycentric<TileSize>(triangle, burst.coverage, state, codes);
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
    const bool pass = burst.coverage.sure != 0 || depth_passes(state.func, code, stored[bit]);
    passed.word[static_cast<std::size_t>(bit / 64)] |= std::uint64_t{pass} << (bit % 64);
    if (pass && state.write && !state.late) {
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
