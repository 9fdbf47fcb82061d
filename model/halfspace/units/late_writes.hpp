/// The late path of early_z: draws whose shader may discard fragments are tested early, and what the shader
/// keeps is written when it is through.
///
/// A late write stays out until a later burst needs a line that it writes, or its place in the queue. So what
/// a burst sees is what the bursts before it leave, and which late writes go before which burst depends on
/// their order only, never on time: docs/adr/0013-late-writes.md.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>

#include "halfspace/units/packets.hpp"
#include "halfspace/units/tile_mask.hpp"
#include "halfspace/units/z_line.hpp"

namespace halfspace {

/// The slots of the z cache that a burst touches, by its parts.
struct ZSlots {
  std::uint8_t touched = 0;
  std::array<std::uint32_t, kMaxZParts> slot{};

  void add(int part, std::uint32_t in) {
    touched |= static_cast<std::uint8_t>(1u << part);
    slot[static_cast<std::size_t>(part)] = in;
  }
  /// Parts have slots of their own, so the same part of both must have the same one.
  [[nodiscard]] bool meet(const ZSlots& other) const {
    for (unsigned both = touched & other.touched; both != 0; both &= both - 1) {
      const auto part = static_cast<std::size_t>(std::countr_zero(both));
      if (slot[part] == other.slot[part]) {
        return true;
      }
    }
    return false;
  }
};

/// The late writes that are out, in order, by the slots that they will write to.
class LateWrites {
 public:
  explicit LateWrites(int capacity = 0) : capacity_(static_cast<std::size_t>(capacity)) {}

  /// Has those done, the oldest, that go before the test of a burst with these slots: up to the newest that
  /// writes to one of them, and, where the burst's draw is late itself, as many as make room for it.
  void make_way(const ZSlots& burst, bool late) {
    std::size_t count = out_.size();
    while (count != 0 && !out_[count - 1].meet(burst)) {
      --count;
    }
    if (late && out_.size() >= capacity_) {
      count = std::max(count, out_.size() - capacity_ + 1);
    }
    finish(count);
  }

  /// The late write of this burst is out from now on.
  void add(const ZSlots& burst) { out_.push_back(burst); }

  /// All are done.
  void finish_all() { finish(out_.size()); }

  /// So many are done, of all so far.
  [[nodiscard]] std::uint32_t done() const { return done_; }

 private:
  void finish(std::size_t count) {
    out_.erase(out_.begin(), out_.begin() + static_cast<std::ptrdiff_t>(count));
    done_ += static_cast<std::uint32_t>(count);
  }

  std::size_t capacity_;
  std::deque<ZSlots> out_;
  std::uint32_t done_ = 0;
};

/// Which fragments a shader discards. Frames hold no shaders, so a hash of draw, triangle and pixel decides.
struct ShaderDiscard {
  std::uint64_t seed = 0;
  std::uint64_t share = 0;  ///< in parts of 2^32

  [[nodiscard]] bool discards(std::uint32_t draw, std::uint32_t triangle, int x, int y) const {
    const std::uint64_t of_triangle = mix(mix(seed) ^ (std::uint64_t{draw} << 32 | triangle));
    const std::uint64_t pixel = static_cast<std::uint64_t>(y) << 32 | static_cast<std::uint32_t>(x);
    return mix(of_triangle ^ pixel) >> 32 < share;
  }

 private:
  /// The finalizer of SplitMix64 (G. Steele, D. Lea, C. Flood, "Fast Splittable Pseudorandom Number
  /// Generators", OOPSLA 2014).
  static constexpr std::uint64_t mix(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
    x = (x ^ x >> 27) * 0x94d049bb133111ebu;
    return x ^ x >> 31;
  }
};

/// What the shader keeps of the samples `passed` of a tile.
template <int TileSize>
TileMask shader_keeps(const ShaderDiscard& discard, const TileMask& passed, std::uint32_t draw,
                      std::uint32_t triangle, int tile_x, int tile_y) {
  TileMask kept = passed;
  for (std::size_t i = 0; i < kMaskWords<TileSize>; ++i) {
    for (std::uint64_t left = discard.share == 0 ? 0 : passed.word[i]; left != 0; left &= left - 1) {
      const int bit = static_cast<int>(i) * 64 + std::countr_zero(left);
      if (discard.discards(draw, triangle, tile_x * TileSize + bit % TileSize,
                           tile_y * TileSize + bit / TileSize)) {
        kept.word[i] &= ~(left & -left);
      }
    }
  }
  return kept;
}

/// Writes the codes of `kept` to a tile: TileSize^2 codes each, row order.
template <int TileSize>
void write_codes(const std::uint32_t* codes, const TileMask& kept, std::uint32_t* stored) {
  for (std::size_t i = 0; i < kMaskWords<TileSize>; ++i) {
    for (std::uint64_t left = kept.word[i]; left != 0; left &= left - 1) {
      const std::size_t bit = i * 64 + static_cast<std::size_t>(std::countr_zero(left));
      stored[bit] = codes[bit];
    }
  }
}

}  // namespace halfspace
