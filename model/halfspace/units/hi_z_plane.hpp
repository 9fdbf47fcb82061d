/// The range of a triangle's depth over the tiles of a block, as hi_z knows it: by the triangle's vertices,
/// and by its plane, which is walked from block to block like an edge.
///
/// Arithmetic is on words of 32 bits whose unit is 2^(exponent - 31), exponent being that of the depth
/// equation, with kHiZFraction bits below. All of it is modulo 2^kHiZBits: that holds the plane wherever a
/// block has a sample of the triangle, and what it says elsewhere does not matter. docs/numerics.md has the
/// error of the words that the interpolator makes, which kHiZMargin covers.
#pragma once

#include <algorithm>
#include <cstdint>

#include "halfspace/units/depth_plane.hpp"
#include "halfspace/units/float_parts.hpp"
#include "halfspace/units/packets.hpp"

namespace halfspace {

inline constexpr int kHiZFraction = 16;
inline constexpr int kHiZBits = Widths{}.HiZWordBits;

/// A pixel changes depth by less than 2^kHiZMostStep units where the plane is known.
inline constexpr int kHiZMostStep = 25;

/// Interpolated words are less than so many units away from the plane as it is kept here. 15.5 are the
/// interpolator's: half a unit for the word that its additions start from, and half a unit for each of at
/// most 30 steps. Steps that are rounded down take 0.75 for each of x and y, since no sample is more than 1.5
/// 2^15 pixels away from a vertex; the rest is less than 0.1.
inline constexpr std::int64_t kHiZMargin = 18;

/// Keeps the low kHiZBits bits, as a signed number.
constexpr std::int64_t hi_z_wrap(std::int64_t value) {
  constexpr int kAbove = 64 - kHiZBits;
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(value) << kAbove) >> kAbove;
}

/// At pixel (0, 0). The equation's plane must be there.
inline HiZPlane hi_z_plane(const DepthEquation& eq, DepthFormat format, int sub_pixel_bits) {
  const bool is_float = format == DepthFormat::kFloat32;
  const bool is_short = !is_float && !eq.beyond;
  // Bits of a gradient, which is for a sub-pixel, below those of a step.
  const int cut = kGradientFraction - kHiZFraction + (is_short ? 0 : 32) - sub_pixel_bits;
  const auto step = [cut](Modular gradient) {
    const auto value = static_cast<Int128>(gradient);
    return cut >= 0 ? value >> cut : value * (Int128{1} << -cut);
  };
  const Int128 dx = step(eq.plane.dx);
  const Int128 dy = step(eq.plane.dy);
  const Int128 most = Int128{1} << (kHiZMostStep + kHiZFraction);
  HiZPlane plane;
  plane.known = dx >= -most && dx < most && dy >= -most && dy < most;
  if (!plane.known) {
    return plane;
  }
  const std::int64_t word = is_short ? eq.plane.z << kHiZFraction : eq.plane.z >> (32 - kHiZFraction);
  const std::int64_t offset = is_short   ? eq.offset << kHiZFraction
                              : is_float ? eq.offset >> (32 - kHiZFraction)
                                         : word_of_unorm(eq.offset, eq.exponent) >> (32 - kHiZFraction);
  const std::int64_t half_pixel = std::int64_t{1} << (sub_pixel_bits - 1);
  const Int128 way = dx * (half_pixel - eq.plane.x) + dy * (half_pixel - eq.plane.y);
  plane.z = hi_z_wrap(word + offset + static_cast<std::int64_t>(way >> sub_pixel_bits));
  plane.dx = static_cast<std::int64_t>(dx);
  plane.dy = static_cast<std::int64_t>(dy);
  return plane;
}

/// Words of all samples of a tile lie between these.
struct WordBounds {
  std::int64_t least = 0;
  std::int64_t most = 0;
};

/// Of the tile whose first pixel is (x, y) of the block that the plane is at.
template <int TileSize>
constexpr WordBounds tile_words(const HiZPlane& plane, int x, int y) {
  const std::int64_t first = plane.z + plane.dx * x + plane.dy * y;
  const auto word = [&](std::int64_t dx, std::int64_t dy) {
    return hi_z_wrap(first + (TileSize - 1) * (dx + dy)) >> kHiZFraction;
  };
  const std::int64_t none = 0;
  return {.least = word(std::min(plane.dx, none), std::min(plane.dy, none)) - kHiZMargin,
          .most = word(std::max(plane.dx, none), std::max(plane.dy, none)) + 1 + kHiZMargin};
}

/// The least word of which the interpolator makes `code` or more; `code` is 1 or more.
constexpr std::int64_t word_of_code(std::uint32_t code, DepthFormat format, int exponent) {
  constexpr std::int64_t kBeyond = std::int64_t{1} << (kHiZBits - kHiZFraction);  // of every word
  // value * 2^up, rounded up
  const auto scale = [](std::uint64_t value, int up) {
    if (up >= 0) {
      return up > kHiZBits - kHiZFraction || value >> (kHiZBits - kHiZFraction - up) != 0
                 ? kBeyond
                 : static_cast<std::int64_t>(value << up);
    }
    return up <= -63 ? std::int64_t{1}
                     : static_cast<std::int64_t>((value + (std::uint64_t{1} << -up) - 1) >> -up);
  };
  if (format != DepthFormat::kFloat32) {
    const int fraction = vertex_depth_fraction(format);
    return scale((std::uint64_t{code} << fraction) - (std::uint64_t{1} << (fraction - 1)), -exponent);
  }
  // Half way from the float below, which is half as far away below a power of two.
  const FloatParts parts = float_parts(code);
  const bool power = parts.mantissa == 0x800000 && parts.exponent != -149;
  return scale(power ? 4 * std::uint64_t{parts.mantissa} - 1 : 4 * std::uint64_t{parts.mantissa} - 2,
               parts.exponent - 2 - exponent + 31);
}

}  // namespace halfspace
