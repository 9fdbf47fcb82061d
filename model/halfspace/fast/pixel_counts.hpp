/// How often something happened to each pixel of a surface, up to 0xFFFF: bit k of the counts of a tile's
/// pixels is a word with a bit a pixel. To add a mask touches some two words, where the counts side by side
/// would be two lines of the processor's cache.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "halfspace/units/lazy_array.hpp"

namespace halfspace::fast {

class PixelCounts {
 public:
  static constexpr std::size_t kBits = 16;

  PixelCounts() = default;
  explicit PixelCounts(std::size_t tiles)
      : tiles_(tiles),
        words_(unset_array<std::uint64_t>(tiles * kBits)),
        used_(unset_array<std::uint8_t>(tiles, Pages::kSmall)) {}

  /// Nothing has been counted in `count` tiles from `first` on.
  void start(std::size_t first, std::size_t count) {
    std::fill_n(used_.get() + first, count, std::uint8_t{0});
  }

  /// Adds 1 to the pixels of a tile that are in `mask`.
  void add(std::size_t tile, std::uint64_t mask) {
    std::uint64_t* word = words_.get() + tile;
    std::uint64_t carry = mask;
    const std::size_t used = used_[tile];
    for (std::size_t k = 0; k < used && carry != 0; ++k, word += tiles_) {
      const std::uint64_t one = *word;
      *word = one ^ carry;
      carry &= one;
    }
    if (carry != 0) [[unlikely]] {
      add_word(tile, carry);
    }
  }

  /// Bits that counts of the tile have.
  [[nodiscard]] std::size_t used(std::size_t tile) const { return used_[tile]; }
  /// Bit `k` of them, a bit a pixel.
  [[nodiscard]] std::uint64_t word(std::size_t tile, std::size_t k) const {
    return words_[k * tiles_ + tile];
  }
  /// What add() touches first.
  [[nodiscard]] const std::uint64_t* first_word(std::size_t tile) const { return words_.get() + tile; }
  [[nodiscard]] const std::uint64_t* second_word(std::size_t tile) const {
    return words_.get() + tiles_ + tile;
  }

 private:
  /// Counts are about to have another bit; those that have all stay at the largest number.
  void add_word(std::size_t tile, std::uint64_t carry) {
    const std::size_t used = used_[tile];
    if (used < kBits) {
      words_[used * tiles_ + tile] = carry;
      used_[tile] = static_cast<std::uint8_t>(used + 1);
      return;
    }
    for (std::size_t k = 0; k < kBits; ++k) {
      words_[k * tiles_ + tile] |= carry;
    }
  }

  std::size_t tiles_ = 0;
  LazyArray<std::uint64_t> words_;  ///< bit by bit, in each by tile
  LazyArray<std::uint8_t> used_;  ///< by tile: bits that its counts have; the words of the others are not set
};

}  // namespace halfspace::fast
