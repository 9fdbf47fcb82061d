/// What hi_z keeps of depth: for each tile of a block, or each part of it, codes between which all that is
/// stored lies; and what such bounds say of a depth test.
///
/// The bounds of a block share a base and a shift, so that a few bits hold them however narrow the block's
/// range of depth is. Rounding is outwards.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "halfspace/numerics/depth.hpp"

namespace halfspace {

/// Codes from `least` to `most`, inclusive.
struct CodeBounds {
  std::uint32_t least = 0;
  std::uint32_t most = ~0u;  ///< without a known bound: no code is more

  friend bool operator==(const CodeBounds&, const CodeBounds&) = default;
};

constexpr CodeBounds unite(const CodeBounds& l, const CodeBounds& r) {
  return {.least = std::min(l.least, r.least), .most = std::max(l.most, r.most)};
}

/// Most entries of a word: tiles of a block times parts of a tile.
inline constexpr std::size_t kMostHiZEntries = 64;

/// The bounds of a block as memory holds them: entry i lies from base + least[i] 2^shift to base + (most[i] +
/// 1) 2^shift - 1, with `bits` bits for each of least and most.
struct HiZWord {
  std::uint32_t base = 0;
  std::uint8_t shift = 0;
  std::array<std::uint32_t, kMostHiZEntries> least{};
  std::array<std::uint32_t, kMostHiZEntries> most{};

  [[nodiscard]] CodeBounds entry(std::size_t i) const {
    const std::uint64_t end = base + ((std::uint64_t{most[i]} + 1) << shift);
    return {.least = base + (least[i] << shift), .most = static_cast<std::uint32_t>(end - 1)};
  }

  friend bool operator==(const HiZWord&, const HiZWord&) = default;
};

/// Every entry is exactly `code`: a block that is cleared.
constexpr HiZWord cleared_word(std::uint32_t code) { return {.base = code}; }

/// Puts `bounds[part]` in the place of entry `first + part` of the first `entries`, for each part that
/// `parts` has a bit of, one or more. The others keep theirs, rounded outwards where the block's range has
/// grown. The shift is the least with which all fit.
constexpr void put_entries(HiZWord& word, std::size_t entries, std::size_t first, std::uint32_t parts,
                           std::span<const CodeBounds> bounds, int bits) {
  std::array<CodeBounds, kMostHiZEntries> all{};
  for (std::size_t k = 0; k < entries; ++k) {
    const std::size_t part = k - first;
    all[k] = part < bounds.size() && (parts >> part & 1) != 0 ? bounds[part] : word.entry(k);
  }
  CodeBounds range = all[0];
  for (std::size_t k = 1; k < entries; ++k) {
    range = unite(range, all[k]);
  }
  int shift = 0;
  while (((std::uint64_t{range.most} >> shift) - (std::uint64_t{range.least} >> shift)) >> bits != 0) {
    ++shift;
  }
  word.shift = static_cast<std::uint8_t>(shift);
  word.base = range.least >> shift << shift;
  for (std::size_t k = 0; k < entries; ++k) {
    word.least[k] = (all[k].least - word.base) >> shift;
    word.most[k] = (all[k].most - word.base) >> shift;
  }
}

/// Nothing is known.
constexpr HiZWord unknown_word(std::size_t entries, int bits) {
  HiZWord word{.shift = static_cast<std::uint8_t>(32 - bits)};
  std::fill_n(word.most.begin(), entries, ~0u >> word.shift);
  return word;
}

/// How a draw's writes may move what is stored, from its function: LESS only down, GREATER only up.
struct DepthMoves {
  bool up = false;
  bool down = false;
};

constexpr DepthMoves depth_moves(DepthFunc func, bool write) {
  const bool both = func == DepthFunc::kAlways || func == DepthFunc::kNotEqual;
  return {.up = write && (both || func == DepthFunc::kGreater || func == DepthFunc::kGequal),
          .down = write && (both || func == DepthFunc::kLess || func == DepthFunc::kLequal)};
}

}  // namespace halfspace
