/// The depth interpolator `plane`: z = z0 + x dx + y dy modulo a power of two, by additions alone.
///
/// The gradients of a sliver are far larger than the range of depth. But z at a covered sample lies between
/// the vertices, so its low bits say all: gradients may overflow as long as they are right modulo the word.
/// Error and the proof of the bounds: docs/numerics.md.
///
/// A word is a signed number below 1 with its binary point behind the sign. A short one has 32 bits: of a
/// vertex depth on unorm surfaces, as it is. A long one has 64, for float32 surfaces and for vertex depths
/// outside [0, 1]; in it 1 is 2^DepthEquation::exponent.
///
/// Where a pixel counts whose centre is outside the triangle, the plane there may be far beyond the vertices.
/// A wide word holds it, whichever of the two it is a word of: 106 bits, those that gradients leave of 128.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "halfspace/numerics/depth.hpp"
#include "halfspace/numerics/sample_pattern.hpp"
#include "halfspace/units/float_parts.hpp"
#include "halfspace/units/packets.hpp"

namespace halfspace {

using ShortWord = std::uint32_t;
using LongWord = std::uint64_t;
using WideWord = Modular;

inline constexpr int kGradientFraction = 22;  ///< bits of a gradient below those of the word

/// Fills `eq.plane`; the rest of `eq` is there. `vertex` is vertex 0, vertex i is opposite to edge[i].
void set_plane(const ScreenVertex& vertex, const std::array<Edge, 3>& edge, DepthFormat format,
               DepthEquation& eq);

/// A vertex depth of a unorm surface as a long word.
constexpr std::int64_t word_of_unorm(std::int64_t z, int exponent) {
  return z << (kLongWordFraction - kVertexDepthBits - exponent);
}

/// A word as a signed number.
constexpr std::int32_t signed_word(ShortWord word) { return static_cast<std::int32_t>(word); }
constexpr std::int64_t signed_word(LongWord word) { return static_cast<std::int64_t>(word); }
constexpr Int128 signed_word(WideWord word) {
  return static_cast<Int128>(word << kGradientFraction) >> kGradientFraction;
}

/// The plane at one tile.
template <class Word>
struct TilePlane {
  Word origin;  ///< at the sample of the tile's first pixel
  Word dx;      ///< change for a pixel in x
  Word dy;

  /// At pixel (x, y) of the tile.
  [[nodiscard]] auto at(std::uint32_t x, std::uint32_t y) const {
    return signed_word(static_cast<Word>(origin + x * dx + y * dy));
  }
};

/// Squares of so many pixels on a side share the word that additions start from, whatever the size of tiles:
/// so depth does not depend on it.
inline constexpr std::int32_t kAnchorSize = 16;

/// `x` and `y` are the tile's first pixel, `sample` where its samples are. A gradient is for a step of the
/// sub-pixel grid, on which the sample is: so the word at the first pixel is as exact at any of them.
template <class Word>
TilePlane<Word> tile_plane(const PlaneEquation& plane, std::int32_t x, std::int32_t y, int sub_pixel_bits,
                           const SamplePosition& sample = {}) {
  using Product = std::conditional_t<sizeof(Word) == sizeof(ShortWord), std::uint64_t, Modular>;
  const auto dx = static_cast<Product>(plane.dx);
  const auto dy = static_cast<Product>(plane.dy);
  const auto from_vertex = [&](std::int32_t pixel, int sixteenths, std::int32_t vertex) {
    const std::int64_t anchor = pixel / kAnchorSize * kAnchorSize;
    return static_cast<Product>((anchor << sub_pixel_bits) + sample_way(sixteenths, sub_pixel_bits) - vertex);
  };
  // The word nearest to `value`, which has `fraction` bits more.
  const auto nearest = [](Product value, int fraction) {
    return static_cast<Word>((value + (Product{1} << (fraction - 1))) >> fraction);
  };
  const Product anchor = (static_cast<Product>(plane.z) << kGradientFraction) +
                         dx * from_vertex(x, sample.x, plane.x) + dy * from_vertex(y, sample.y, plane.y);
  TilePlane<Word> tile{.origin = nearest(anchor, kGradientFraction),
                       .dx = nearest(dx, kGradientFraction - sub_pixel_bits),
                       .dy = nearest(dy, kGradientFraction - sub_pixel_bits)};
  tile.origin += static_cast<Word>(x % kAnchorSize) * tile.dx + static_cast<Word>(y % kAnchorSize) * tile.dy;
  return tile;
}

}  // namespace halfspace
