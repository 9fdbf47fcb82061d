/// Operations on the coverage mask of a tile: bit y * TileSize + x.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "halfspace/units/packets.hpp"

namespace halfspace {

/// Words of a TileMask that a tile of this size uses.
template <int TileSize>
inline constexpr std::size_t kMaskWords = (TileSize * TileSize + 63) / 64;

constexpr TileMask& operator&=(TileMask& left, const TileMask& right) {
  for (std::size_t i = 0; i < left.word.size(); ++i) {
    left.word[i] &= right.word[i];
  }
  return left;
}

constexpr bool any(const TileMask& mask) {
  return (mask.word[0] | mask.word[1] | mask.word[2] | mask.word[3]) != 0;
}

/// Of a tile of at most this size.
template <int TileSize = 16>
constexpr int popcount(const TileMask& mask) {
  int count = 0;
  for (std::size_t i = 0; i < kMaskWords<TileSize>; ++i) {
    count += std::popcount(mask.word[i]);
  }
  return count;
}

template <int TileSize>
constexpr bool test(const TileMask& mask, int x, int y) {
  const int bit = y * TileSize + x;
  return (mask.word[static_cast<std::size_t>(bit / 64)] >> (bit % 64) & 1) != 0;
}

/// ORs the low TileSize bits of `bits` into row y.
template <int TileSize>
constexpr void set_row(TileMask& mask, int y, std::uint32_t bits) {
  const int bit = y * TileSize;
  mask.word[static_cast<std::size_t>(bit / 64)] |= std::uint64_t{bits} << (bit % 64);
}

/// All samples of the tile.
template <int TileSize>
constexpr TileMask full_mask() {
  TileMask mask;
  for (int y = 0; y < TileSize; ++y) {
    set_row<TileSize>(mask, y, (1u << TileSize) - 1);
  }
  return mask;
}

/// Columns x_first to x_last of rows y_first to y_last, inclusive.
template <int TileSize>
constexpr TileMask rect_mask(int x_first, int x_last, int y_first, int y_last) {
  TileMask mask;
  const std::uint32_t row = x_last < x_first ? 0 : ((2u << (x_last - x_first)) - 1) << x_first;
  for (int y = y_first; y <= y_last; ++y) {
    set_row<TileSize>(mask, y, row);
  }
  return mask;
}

}  // namespace halfspace
