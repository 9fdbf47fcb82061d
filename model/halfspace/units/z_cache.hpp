/// The z cache of early_z: which lines of the depth surfaces are on the chip, which of them are dirty, and
/// which lines of memory are only marked cleared.
///
/// A line is one tile, or one of `parts` equal bands of its rows. Parts have tags of their own. What hits and
/// what is replaced depends on the order of bursts only, never on time. The state is in two halves, because
/// hardware has them at two places of the pipe, each of which sees all bursts in order: ZTags at the lookup,
/// ZLines where the data moves. H. Igehy, M. Eldridge, K. Proudfoot, "Prefetching in a Texture Cache
/// Architecture", Graphics Hardware 1998. docs/units/early_z.md has the protocol.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "halfspace/units/early_z.hpp"
#include "halfspace/units/packets.hpp"

namespace halfspace {

inline constexpr int kMaxZParts = 4;
inline constexpr std::uint32_t kNoZLine = 0xFFFFFFFFu;

/// Powers of two; lines >= parts * ways.
struct ZCacheShape {
  int lines = 128;  ///< in all
  int ways = 4;
  int parts = 1;

  [[nodiscard]] int sets() const { return lines / (ways * parts); }
  friend bool operator==(const ZCacheShape&, const ZCacheShape&) = default;
};

/// Where the tiles of a depth surface lie among those of all surfaces.
struct ZSurface {
  std::uint32_t first_tile = 0;
  std::uint32_t tiles_x = 0;
  std::uint32_t tiles = 0;
  std::uint32_t line_bytes = 0;  ///< of one line in memory

  /// Number of a line of the surface in memory.
  [[nodiscard]] std::uint32_t line(std::uint32_t tile_x, std::uint32_t tile_y, int parts, int part) const {
    return (first_tile + tile_y * tiles_x + tile_x) * static_cast<std::uint32_t>(parts) +
           static_cast<std::uint32_t>(part);
  }
};

/// True where a burst has to do with stored depth.
inline bool touches_depth(const EarlyZState& state) {
  return state.test && state.func != DepthFunc::kNever && (state.write || state.func != DepthFunc::kAlways);
}

/// Bytes of a sample in memory.
constexpr int sample_bytes(DepthFormat format) { return format == DepthFormat::kUnorm16 ? 2 : 4; }

/// Bit i: part i of the tile has a sample of the mask.
template <int TileSize>
constexpr std::uint8_t parts_of_mask(const TileMask& mask, int parts) {
  if (parts == 1) {
    return any(mask) ? 1 : 0;
  }
  std::uint8_t found = 0;
  for (int y = 0; y < TileSize; ++y) {
    const int bit = y * TileSize;
    const std::uint64_t row = mask.word[static_cast<std::size_t>(bit / 64)] >> (bit % 64);
    const bool hit = (row & ((std::uint64_t{1} << TileSize) - 1)) != 0;
    found |= static_cast<std::uint8_t>((hit ? 1u : 0u) << (y * parts / TileSize));
  }
  return found;
}

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

/// What the lines of the cache hold, as the test keeps it, and the state of the lines of memory.
class ZLines {
 public:
  struct Victim {
    std::uint32_t line = kNoZLine;  ///< of memory; none where the slot was free
    std::uint32_t bytes = 0;
    bool dirty = false;
  };

  ZLines() = default;
  /// `memory_lines`: of all surfaces.
  ZLines(const ZCacheShape& shape, std::uint32_t memory_lines)
      : slots_(static_cast<std::size_t>(shape.lines)), cleared_(memory_lines) {}

  /// The line of memory is only marked cleared, so there is nothing to fetch.
  [[nodiscard]] bool cleared(std::uint32_t line) const { return cleared_[line]; }

  /// Puts a line into a slot. A dirty victim is written back by the caller; it is then stored.
  Victim replace(std::uint32_t slot, std::uint32_t line, std::uint32_t bytes) {
    const Victim victim = slots_[slot];
    if (victim.dirty) {
      cleared_[victim.line] = false;
    }
    slots_[slot] = {.line = line, .bytes = bytes, .dirty = false};
    return victim;
  }

  void mark_written(std::uint32_t slot) { slots_[slot].dirty = true; }

  /// Marks the lines `first` to `last` of memory cleared, and drops them from the cache, dirty or not.
  void clear(std::uint32_t first, std::uint32_t last) {
    for (std::uint32_t line = first; line <= last; ++line) {
      cleared_[line] = true;
    }
    for (Victim& slot : slots_) {
      if (slot.line >= first && slot.line <= last) {
        slot = {};
      }
    }
  }

  /// Writes back what is dirty: calls visit(slot, line, bytes) for it, in order of slots.
  template <class Visit>
  void flush(Visit&& visit) {
    for (std::uint32_t slot = 0; slot < slots_.size(); ++slot) {
      if (slots_[slot].dirty) {
        visit(slot, slots_[slot].line, slots_[slot].bytes);
        cleared_[slots_[slot].line] = false;
        slots_[slot].dirty = false;
      }
    }
  }

 private:
  std::vector<Victim> slots_;
  std::vector<bool> cleared_;
};

/// A part of a burst's tile that the cache did not have.
struct ZMiss {
  std::uint32_t line = 0;           ///< of memory
  std::uint32_t victim = kNoZLine;  ///< of memory, the line that had to leave
  std::uint16_t bytes = 0;          ///< of the line
  std::uint16_t victim_bytes = 0;
  bool fetch = false;       ///< asked for; else made from the clear value
  bool write_back = false;  ///< the victim was dirty
};

/// The misses of a burst, in order of parts.
struct ZMisses {
  std::size_t count = 0;
  std::array<ZMiss, kMaxZParts> part;

  [[nodiscard]] std::span<const ZMiss> parts() const { return {part.data(), count}; }
};

/// Both halves of the cache, for those who take one burst after the other through lookup and test.
class ZCache {
 public:
  ZCache() = default;
  ZCache(const ZCacheShape& shape, std::uint32_t memory_lines)
      : shape_(shape), tags_(shape), lines_(shape, memory_lines) {}

  /// A burst that touches the parts `touched` of a tile and writes to `written` of them.
  ZMisses access(const ZSurface& surface, std::uint32_t tile_x, std::uint32_t tile_y, std::uint8_t touched,
                 std::uint8_t written) {
    ZMisses misses;
    for (int i = 0; i < shape_.parts; ++i) {
      if ((touched >> i & 1) == 0) {
        continue;
      }
      const std::uint32_t line = surface.line(tile_x, tile_y, shape_.parts, i);
      const ZTags::Lookup found = tags_.lookup(tile_x, tile_y, i, line);
      if (!found.hit) {
        const bool fetch = !lines_.cleared(line);
        const ZLines::Victim victim = lines_.replace(found.slot, line, surface.line_bytes);
        misses.part[misses.count++] = {.line = line,
                                       .victim = victim.line,
                                       .bytes = static_cast<std::uint16_t>(surface.line_bytes),
                                       .victim_bytes = static_cast<std::uint16_t>(victim.bytes),
                                       .fetch = fetch,
                                       .write_back = victim.dirty};
      }
      if ((written >> i & 1) != 0) {
        lines_.mark_written(found.slot);
      }
    }
    return misses;
  }

  void clear(const ZSurface& surface) {
    const auto parts = static_cast<std::uint32_t>(shape_.parts);
    const std::uint32_t first = surface.first_tile * parts;
    const std::uint32_t last = first + surface.tiles * parts - 1;
    tags_.drop(first, last);
    lines_.clear(first, last);
  }

  template <class Visit>
  void flush(Visit&& visit) {
    lines_.flush(visit);
  }

 private:
  ZCacheShape shape_;
  ZTags tags_;
  ZLines lines_;
};

}  // namespace halfspace
