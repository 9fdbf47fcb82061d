/// quad_generator: from a coverage mask to its 2x2 quads.
///
/// Quads are aligned to even pixels. Every quad that holds a covered sample leaves, in row order of the tile;
/// empty ones are squeezed out. The samples of a quad that are not covered are helper fragments: a shader
/// runs them for its derivatives, and they touch no memory.
#pragma once

#include "halfspace/units/packets.hpp"
#include "halfspace/units/tile_mask.hpp"

namespace halfspace {

/// One quad as it leaves the unit.
struct Quad {
  int x = 0;  ///< top left pixel in the tile, even
  int y = 0;
  std::uint8_t mask = 0;  ///< covered: bit 0 (x, y), 1 (x + 1, y), 2 (x, y + 1), 3 (x + 1, y + 1)
};

/// Bits of the top left pixels of all quads of one mask word; the word holds an even number of whole rows.
template <int TileSize>
constexpr std::uint64_t quad_corners() {
  std::uint64_t bits = 0;
  for (int i = 0; i < 64 && i < TileSize * TileSize; ++i) {
    const bool even = i % TileSize % 2 == 0 && i / TileSize % 2 == 0;
    bits |= std::uint64_t{even} << i;
  }
  return bits;
}

template <int TileSize>
constexpr QuadBurst quad_generator(const Coverage& coverage) {
  QuadBurst burst{.coverage = coverage, .quads = {}};
  for (std::size_t i = 0; i < kMaskWords<TileSize>; ++i) {
    const std::uint64_t rows = coverage.mask.word[i];
    const std::uint64_t pairs = rows | rows >> 1;
    burst.quads.word[i] = (pairs | pairs >> TileSize) & quad_corners<TileSize>();
  }
  return burst;
}

/// The bits of the top left pixels of the quads all of whose samples are covered.
template <int TileSize>
constexpr TileMask full_quads(const QuadBurst& burst) {
  TileMask full;
  for (std::size_t i = 0; i < kMaskWords<TileSize>; ++i) {
    const std::uint64_t rows = burst.coverage.mask.word[i];
    const std::uint64_t pairs = rows & rows >> 1;
    full.word[i] = (pairs & pairs >> TileSize) & quad_corners<TileSize>();
  }
  return full;
}

/// The four bits of `mask` in the quad whose top left pixel is (x, y) of the tile.
template <int TileSize>
constexpr std::uint8_t quad_bits(const TileMask& mask, int x, int y) {
  const int bit = y * TileSize + x;
  const std::uint64_t rows = mask.word[static_cast<std::size_t>(bit / 64)] >> (bit % 64);
  return static_cast<std::uint8_t>((rows & 3) | (rows >> TileSize & 3) << 2);
}

/// Calls visit(Quad) for each quad of the burst in the order in which they leave.
template <int TileSize, class Visit>
constexpr void for_each_quad(const QuadBurst& burst, Visit&& visit) {
  for (std::size_t i = 0; i < kMaskWords<TileSize>; ++i) {
    for (std::uint64_t left = burst.quads.word[i]; left != 0; left &= left - 1) {
      const int bit = static_cast<int>(i) * 64 + std::countr_zero(left);
      const int x = bit % TileSize;
      const int y = bit / TileSize;
      visit(Quad{.x = x, .y = y, .mask = quad_bits<TileSize>(burst.coverage.mask, x, y)});
    }
  }
}

}  // namespace halfspace
