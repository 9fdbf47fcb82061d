/// The depth interpolator `plane`: z = z0 + x dx + y dy modulo a power of two, by additions alone.
///
/// The gradients of a sliver are far larger than the range of depth. But z at a covered sample lies between
/// the vertices, so its low bits say all: gradients may overflow as long as they are right modulo the word.
/// Error and the proof of the bounds: docs/numerics.md.
///
/// A word is a signed number below 1 with its binary point behind the sign: 32 bits on unorm surfaces, where
/// 1 is 2^31 units of a vertex depth, and 64 bits on float32 surfaces, where 1 is the power of two above the
/// largest vertex depth.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <type_traits>

#include "halfspace/numerics/depth.hpp"
#include "halfspace/units/float_parts.hpp"
#include "halfspace/units/packets.hpp"

namespace halfspace {

inline constexpr int kGradientFraction = 22;  ///< bits of a gradient below those of the word

/// The plane at one tile.
template <class Word>
struct TilePlane {
  Word origin;  ///< at the centre of the tile's first pixel
  Word dx;      ///< change for a pixel in x
  Word dy;
};

/// `v` in positive order, vertex i opposite to edge[i]; area2 > 0 is twice the area in squared sub-pixel
/// units.
PlaneEquation plane_equation(const std::array<ScreenVertex, 3>& v, const std::array<Edge, 3>& edge,
                             std::int64_t area2, DepthFormat format);

/// `x` and `y` are the tile's first pixel. Word is std::uint32_t or std::uint64_t.
template <class Word>
TilePlane<Word> tile_plane(const PlaneEquation& plane, std::int32_t x, std::int32_t y, int sub_pixel_bits) {
  using Product = std::conditional_t<sizeof(Word) == 4, std::uint64_t, Modular>;
  const auto dx = static_cast<Product>(plane.dx);
  const auto dy = static_cast<Product>(plane.dy);
  const std::int64_t half_pixel = std::int64_t{1} << (sub_pixel_bits - 1);
  const auto right = static_cast<Product>((std::int64_t{x} << sub_pixel_bits) + half_pixel - plane.x);
  const auto down = static_cast<Product>((std::int64_t{y} << sub_pixel_bits) + half_pixel - plane.y);
  // The words nearest to `value`, which has `fraction` bits more.
  const auto nearest = [](Product value, int fraction) {
    return static_cast<Word>((value + (Product{1} << (fraction - 1))) >> fraction);
  };
  const Product origin = (static_cast<Product>(plane.z) << kGradientFraction) + dx * right + dy * down;
  return {.origin = nearest(origin, kGradientFraction),
          .dx = nearest(dx, kGradientFraction - sub_pixel_bits),
          .dy = nearest(dy, kGradientFraction - sub_pixel_bits)};
}

/// The word at pixel (x, y) of the tile, kept between the vertices.
template <class Word>
Word plane_word(const PlaneEquation& plane, const TilePlane<Word>& tile, std::uint32_t x, std::uint32_t y) {
  using Signed = std::make_signed_t<Word>;
  const auto word = static_cast<Signed>(tile.origin + x * tile.dx + y * tile.dy);
  return static_cast<Word>(
      std::clamp(word, static_cast<Signed>(plane.low), static_cast<Signed>(plane.high)));
}

/// Stored code of a word of a unorm surface; halves upwards.
constexpr std::uint32_t unorm_of_word(std::uint32_t word, int fraction) {
  return (word + (1u << (fraction - 1))) >> fraction;
}

/// Stored bits of a word of a float32 surface.
constexpr std::uint32_t float_of_word(std::uint64_t word, const PlaneEquation& plane) {
  return float_bits(word, plane.exponent - 63);
}

}  // namespace halfspace
