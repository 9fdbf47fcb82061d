// Without a guard that stops a second inclusion: once for each target of Highway.
#if defined(HALFSPACE_FAST_TRIANGLE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HALFSPACE_FAST_TRIANGLE_INL
#undef HALFSPACE_FAST_TRIANGLE_INL
#else
#define HALFSPACE_FAST_TRIANGLE_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "halfspace/fast/plane-inl.hpp"
#include "halfspace/fast/raster.hpp"

HWY_BEFORE_NAMESPACE();
namespace halfspace::fast::HWY_NAMESPACE {
namespace {

/// How far an edge function changes, from the first sample of a square, to those where it is most and least.
struct Reach {
  std::int32_t most = 0;
  std::int32_t least = 0;
};

/// A triangle in the hands of the raster kernels.
struct Triangle {
  // Of each edge, in pixel steps.
  alignas(64) std::int32_t sample_steps[3][kWidth];  ///< from a tile's first sample to the first kWidth
  alignas(64) std::int32_t tile_steps[3][kLanes];    ///< from a block's first tile to those of a group
  std::array<std::int64_t, 3> e;                     ///< at pixel (0, 0) of the screen
  std::array<std::int32_t, 3> a;
  std::array<std::int32_t, 3> b;
  std::array<Reach, 3> tile_reach;
  std::array<Reach, 3> block_reach;
  PixelRect bounds;
  std::uint32_t number;  ///< in the draw

  // Depth.
  DepthKind kind;
  alignas(64) std::int32_t depth_steps[kWidth];  ///< kShort: as sample_steps
  alignas(64) std::uint64_t long_steps[8 * 8];   ///< kLong: of all samples
  Plane plane;
  ShortWords short_words;
  LongWords long_words;
  std::int64_t rebias;         ///< kLong
  std::uint32_t plane_number;  ///< among those of the surface, or kResolved
  // Bounds of depth by tiles, in codes, or in depth for float32.
  alignas(64) float tile_depth[kLanes];  ///< from a block's first tile to those of a group
  double gradient_x;                     ///< for a pixel
  double gradient_y;
  double depth_origin;  ///< at pixel (0, 0) of the screen
  float tile_least;     ///< from a tile's first sample to its least
  float tile_most;
  float block_least;  ///< the same of a block
  float block_most;
  const SetupTriangle* whole;  ///< kUnits

  [[nodiscard]] HWY_INLINE std::int64_t at(std::size_t edge, int x, int y) const {
    return e[edge] + std::int64_t{a[edge]} * x + std::int64_t{b[edge]} * y;
  }
  [[nodiscard]] HWY_INLINE double depth_at(int x, int y) const {
    return depth_origin + gradient_x * x + gradient_y * y;
  }
};

HWY_INLINE Reach reach(std::int32_t a, std::int32_t b, int size) {
  const std::int32_t x = a * (size - 1);
  const std::int32_t y = b * (size - 1);
  return {.most = std::max(x, 0) + std::max(y, 0), .least = std::min(x, 0) + std::min(y, 0)};
}

template <int TileSize>
HWY_INLINE void load_edges(const SetUpTriangles& in, std::size_t at, int block_size, Triangle& out) {
  const int block_tiles = block_size / TileSize;
  const int shift = std::countr_zero(static_cast<unsigned>(block_tiles));
  out.bounds = {
      .x_first = in.x_first[at], .y_first = in.y_first[at], .x_last = in.x_last[at], .y_last = in.y_last[at]};
  out.number = static_cast<std::uint32_t>(in.number[at]);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::int32_t a = in.a[k][at];
    const std::int32_t b = in.b[k][at];
    out.e[k] = in.e[k][at];
    out.a[k] = a;
    out.b[k] = b;
    out.tile_reach[k] = reach(a, b, TileSize);
    out.block_reach[k] = reach(a, b, block_size);
    hn::Store(first_samples<TileSize>(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)), Tag(),
              out.sample_steps[k]);
    for (int i = 0; i < kLanes; i += kWidth) {
      const Vector lane = hn::Iota(Tag(), i);
      const Vector x = hn::And(lane, set(block_tiles - 1));
      const Vector y = hn::ShiftRightSame(lane, shift);
      hn::Store(hn::Add(hn::Mul(x, set(a * TileSize)), hn::Mul(y, set(b * TileSize))), Tag(),
                out.tile_steps[k] + i);
    }
  }
}

/// A gradient with the sign that it has.
inline double real(std::uint64_t gradient) {
  return static_cast<double>(static_cast<std::int64_t>(gradient));
}
inline double real(Modular gradient) { return static_cast<double>(static_cast<Int128>(gradient)); }

/// What bounds of depth are made of: in codes, of float32 in depth. `unit`: of these, in words. `highest`:
/// that the triangle has. `least_margin`: what the words' own rounding takes at most. The gradients are for a
/// sub-pixel: those of a pixel, which words have, are cut to their bits where a triangle is steep.
template <int TileSize>
HWY_INLINE void load_bounds(double gradient_x, double gradient_y, double unit, double highest,
                            double least_margin, const RasterTask& task, Triangle& out) {
  const double pixel = 1 << task.walker.sub_pixel_bits;
  const double scale = pixel / (double{1 << kGradientFraction} * unit);
  const double dx = gradient_x * scale;
  const double dy = gradient_y * scale;
  const Plane& plane = out.plane;
  const double z = (static_cast<double>(plane.z) + static_cast<double>(plane.add)) / unit;
  out.gradient_x = dx;
  out.gradient_y = dy;
  out.depth_origin = z + (0.5 - plane.x / pixel) * dx + (0.5 - plane.y / pixel) * dy;
  // A bound is three sums of floats, each off by 2^-24 of what is summed. That is at most the highest depth
  // and what it changes by around the bounds. Vertex 0 says nothing of it: it may be far away, and much less
  // deep.
  const double reach = std::fabs(dx) * (out.bounds.x_last - out.bounds.x_first + 2 * task.walker.block_size) +
                       std::fabs(dy) * (out.bounds.y_last - out.bounds.y_first + 2 * task.walker.block_size);
  const auto margin = static_cast<float>(least_margin + (highest + 2 * reach) * 0x1p-20);
  const auto gx = static_cast<float>(dx);
  const auto gy = static_cast<float>(dy);
  const float down = std::min(gx, 0.0F) + std::min(gy, 0.0F);
  const float up = std::max(gx, 0.0F) + std::max(gy, 0.0F);
  const float tile_side = TileSize - 1;
  const auto block_side = static_cast<float>(task.walker.block_size - 1);
  out.tile_least = tile_side * down - margin;
  out.tile_most = tile_side * up + margin;
  out.block_least = block_side * down - margin;
  out.block_most = block_side * up + margin;
  const int block_tiles = task.walker.block_size / TileSize;
  const int shift = std::countr_zero(static_cast<unsigned>(block_tiles));
  const FloatTag tag;
  for (int i = 0; i < kLanes; i += kWidth) {
    const Vector lane = hn::Iota(Tag(), i);
    const auto x = hn::ConvertTo(tag, hn::And(lane, set(block_tiles - 1)));
    const auto y = hn::ConvertTo(tag, hn::ShiftRightSame(lane, shift));
    hn::Store(hn::Add(hn::Mul(x, hn::Set(tag, gx * TileSize)), hn::Mul(y, hn::Set(tag, gy * TileSize))), tag,
              out.tile_depth + i);
  }
}

/// Of a triangle with a slope.
HWY_INLINE Plane plane_of(const SetUpTriangles& in, std::size_t at) {
  return {.kind = static_cast<DepthKind>(in.kind[at]),
          .low = in.low[at],
          .high = in.high[at],
          .add = in.added[at],
          .x = in.x[at],
          .y = in.y[at],
          .z = in.z[at],
          .dx = in.dx[at],
          .dy = in.dy[at],
          .dx_high = in.dx_high[at],
          .dy_high = in.dy_high[at],
          .exponent = in.exponent[at]};
}

template <int TileSize>
HWY_INLINE void load_depth(const SetUpTriangles& in, std::size_t at, const RasterTask& task, Triangle& out) {
  const EarlyZState& state = task.draw->early_z;
  out.plane_number = kResolved;
  out.kind = static_cast<DepthKind>(in.kind[at]);
  if (out.kind == DepthKind::kNone) {
    return;
  }
  Plane& plane = out.plane;
  plane.kind = out.kind;
  plane.low = in.low[at];
  plane.high = in.high[at];
  if (out.kind == DepthKind::kUnits) {
    out.whole = in.first_whole + in.full[at];
    return;
  }
  if (out.kind == DepthKind::kFlat) {
    return;
  }
  plane = plane_of(in, at);
  if (out.kind == DepthKind::kShort) {
    out.short_words = ShortWords(plane, plane.dx, plane.dy, state.sub_pixel_bits);
    constexpr double kMargin = 2;
    const double code = static_cast<double>(std::int64_t{1} << vertex_depth_fraction(state.format));
    load_bounds<TileSize>(real(plane.dx), real(plane.dy), code, plane.high, kMargin, task, out);
    hn::Store(first_samples<TileSize>(out.short_words.step_x, out.short_words.step_y), Tag(),
              out.depth_steps);
  } else {
    out.long_words = long_words(plane, state.sub_pixel_bits);
    const double margin = std::ldexp(1.0, plane.exponent - 55);  // 256 words
    const double one = std::ldexp(1.0, kLongWordFraction - plane.exponent);
    const double highest = std::bit_cast<float>(plane.high);
    load_bounds<TileSize>(real(wide(plane.dx_high, plane.dx)), real(wide(plane.dy_high, plane.dy)), one,
                          highest, margin, task, out);
    out.rebias = float_rebias(plane.exponent);
    long_steps<TileSize>(out.long_words, out.long_steps);
  }
}

}  // namespace
}  // namespace halfspace::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
