/// z_lookup, the first half of early_z: which lines of the depth surfaces are in the z cache.
///
/// Parts of a tile have tags of their own. What hits and what is replaced depends on the order of bursts
/// only, never on time. The lookup asks memory for what is missing long before z_test needs it: H. Igehy, M.
/// Eldridge, K. Proudfoot, "Prefetching in a Texture Cache Architecture", Graphics Hardware 1998.
/// docs/units/early_z.md has the protocol.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "halfspace/units/z_line.hpp"

namespace halfspace {

/// The tags, as the lookup keeps them.
class ZTags {
 public:
  struct Lookup {
    bool hit = false;
    std::uint32_t slot = 0;  ///< line of the cache that holds, or is to hold, the line of memory
  };

  ZTags() = default;
  explicit ZTags(const ZCacheShape& shape) : shape_(shape) {
    const int set_bits = std::countr_zero(static_cast<unsigned>(shape.sets()));
    x_bits_ = (set_bits + 1) / 2;
    y_bits_ = set_bits / 2;
    for (std::uint32_t slot = 0; slot < static_cast<std::uint32_t>(shape.lines); ++slot) {
      entries_.push_back({.line = kNoZLine, .slot = slot});
    }
  }

  /// Looks up `line`, part `part` of the tile, and takes the least recently used slot of the set for it where
  /// it is not there.
  Lookup lookup(std::uint32_t tile_x, std::uint32_t tile_y, int part, std::uint32_t line) {
    const std::uint32_t set = (tile_x & ((1u << x_bits_) - 1)) | (tile_y & ((1u << y_bits_) - 1)) << x_bits_;
    const auto ways = static_cast<std::size_t>(shape_.ways);
    Entry* const recent =
        &entries_[(static_cast<std::size_t>(part) * static_cast<std::size_t>(shape_.sets()) + set) * ways];
    if (recent->line == line) {
      return {.hit = true, .slot = recent->slot};
    }
    std::size_t at = 1;
    while (at < ways && recent[at].line != line) {
      ++at;
    }
    const bool hit = at < ways;
    Entry found = recent[hit ? at : ways - 1];
    found.line = line;
    for (std::size_t i = hit ? at : ways - 1; i > 0; --i) {
      recent[i] = recent[i - 1];
    }
    *recent = found;
    return {.hit = hit, .slot = found.slot};
  }

  /// Forgets the lines `first` to `last` of memory, inclusive. Slots that become free are taken before any
  /// line has to leave, the one used longest ago first.
  void drop(std::uint32_t first, std::uint32_t last) {
    for (Entry& entry : entries_) {
      entry.line = entry.line >= first && entry.line <= last ? kNoZLine : entry.line;
    }
    for (auto set = entries_.begin(); set != entries_.end(); set += shape_.ways) {
      std::stable_partition(set, set + shape_.ways,
                            [](const Entry& entry) { return entry.line != kNoZLine; });
    }
  }

 private:
  struct Entry {
    std::uint32_t line;
    std::uint32_t slot;
  };
  ZCacheShape shape_;
  int x_bits_ = 0;
  int y_bits_ = 0;
  std::vector<Entry> entries_;  ///< of a set together, the most recently used first
};

}  // namespace halfspace
