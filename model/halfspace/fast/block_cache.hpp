/// The z cache (units/z_cache.hpp) a second time, by blocks: the lines of all tiles of a block in the lanes
/// of vectors.
///
/// Neighbouring tiles lie in different sets, so the tiles of a block never compete, and the order in which
/// they come does not matter. A tag is the number of the block: where in it a line lies, its set says.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "halfspace/machine/stream_writer.hpp"
#include "halfspace/units/counters.hpp"
#include "halfspace/units/lazy_array.hpp"
#include "halfspace/units/z_cache.hpp"

namespace halfspace::fast {

/// Tiles that vectors take in one go: the tiles of a block lie together, so many or a multiple.
inline constexpr int kLanes = 16;

/// Where a surface's blocks lie among those of all surfaces.
struct BlockSurface {
  std::uint32_t first = 0;  ///< block
  std::uint32_t blocks = 0;
  std::uint32_t line_bytes = 0;
};

/// Where a group of tiles is: its block among those of all surfaces, and its entries of the first way and
/// part.
struct CachePlace {
  std::uint32_t block = 0;
  std::uint32_t line_bytes = 0;
  std::size_t entry = 0;
  std::size_t word = 0;  ///< in BlockCache::cleared
};

struct BlockCache {
  BlockCache() = default;
  /// `block_shift`: log2 of the tiles on a side of a block. `surfaces`: all, in order; with one more, empty,
  /// at the end.
  BlockCache(const ZCacheShape& shape, int block_shift, std::vector<BlockSurface> surfaces);

  /// Whether the cache has a set for each tile of a block.
  static bool takes(const ZCacheShape& shape, int block_shift);
  /// Columns of blocks that have sets of their own; the next ones share them.
  static std::uint32_t columns(const ZCacheShape& shape, int block_shift);

  /// Of the sets of a block's tiles, in entries; `block_x` and `block_y` are in blocks.
  [[nodiscard]] std::size_t sets(std::uint32_t block_x, std::uint32_t block_y) const {
    return ((block_x & x_mask) << y_bits | (block_y & y_mask)) * of_block + kGap;
  }

  [[nodiscard]] std::uint32_t line_bytes(std::uint32_t block) const {
    std::size_t i = 0;
    while (block >= surfaces[i + 1].first) {
      ++i;
    }
    return surfaces[i].line_bytes;
  }

  /// A group of tiles of a block; `block_x` and `block_y` in the surface.
  [[nodiscard]] CachePlace place(const BlockSurface& surface, std::uint32_t block, std::uint32_t block_x,
                                 std::uint32_t block_y, std::uint32_t group) const {
    return {.block = surface.first + block,
            .line_bytes = surface.line_bytes,
            .entry = sets(block_x, block_y) + group * kLanes,
            .word = ((surface.first + block) * groups + group) * static_cast<std::size_t>(parts)};
  }

  /// Lines of memory that all surfaces take.
  [[nodiscard]] std::uint32_t memory_lines() const { return static_cast<std::uint32_t>(words * kLanes); }
  /// A line that is not there, before it has been counted. `word`: in `cleared`; `victim`: tag of the line
  /// that leaves.
  [[nodiscard]] ZMiss miss(const CachePlace& at, std::size_t word, int lane, std::int32_t victim,
                           bool is_dirty) const {
    const auto line = [lane](std::size_t of) {
      return static_cast<std::uint32_t>(of * kLanes + static_cast<std::size_t>(lane));
    };
    ZMiss miss{.line = line(word),
               .bytes = static_cast<std::uint16_t>(at.line_bytes),
               .fetch = (cleared[word] >> lane & 1) == 0,
               .write_back = is_dirty};
    if (victim != kFree) {
      miss.victim = line(word_of(at, word, static_cast<std::uint32_t>(victim)));
      miss.victim_bytes = static_cast<std::uint16_t>(line_bytes(static_cast<std::uint32_t>(victim)));
    }
    return miss;
  }
  /// Of the same group and part of another block.
  [[nodiscard]] std::size_t word_of(const CachePlace& at, std::size_t word, std::uint32_t block) const {
    return word + (std::size_t{block} - std::size_t{at.block}) * groups * static_cast<std::size_t>(parts);
  }

  /// All lines of a surface are cleared, and none of them is in the cache.
  void clear(const BlockSurface& surface);

  /// What is dirty, in order of slots.
  [[nodiscard]] std::vector<ZFlush> flush() const;

  static constexpr std::uint32_t kDirty = 1u << 31;  ///< of `slot`, beside its number
  static constexpr std::int32_t kFree = -1;          ///< of `tag`
  /// Entries around those of a block. Processors fetch lines of their caches in pairs and ahead, so what two
  /// threads write to lies apart, from each other and from what both read.
  static constexpr std::size_t kGap = 1024;

  int ways = 0;
  int parts = 0;
  std::uint32_t x_mask = 0;
  std::uint32_t y_mask = 0;
  int y_bits = 0;
  std::size_t groups = 0;   ///< of kLanes tiles, of a block
  std::size_t entries = 0;  ///< kLanes a group
  // Entries lie by set of a block, column by column; in it by way, the most recently used first; by part; by
  // tile. So a column's lie together, and apart from those of another, which another thread may write to.
  std::size_t of_part = 0;
  std::size_t of_way = 0;
  std::size_t of_block = 0;
  std::size_t size = 0;
  std::vector<BlockSurface> surfaces;
  LazyArray<std::int32_t> tag;
  LazyArray<std::uint32_t> slot;     ///< where in the cache the line lies, and whether it is dirty
  std::size_t words = 0;             ///< in `cleared`
  LazyArray<std::uint16_t> cleared;  ///< by block, group and part: tiles whose line is only marked cleared

 private:
  /// As the units (units/z_lookup.hpp).
  void number_slots(const ZCacheShape& shape, int block_shift);
};

/// The line of one part of one tile. A miss goes to `stream`, if there is one.
inline void access_line(BlockCache& cache, const CachePlace& at, int part, int lane, bool written,
                        EarlyZCounters& counters, StreamWriter* stream) {
  const std::size_t first =
      at.entry + static_cast<std::size_t>(part) * cache.of_part + static_cast<std::size_t>(lane);
  std::int32_t* const tags = cache.tag.get() + first;
  std::uint32_t* const slots = cache.slot.get() + first;
  const auto block = static_cast<std::int32_t>(at.block);
  const std::uint32_t dirty = written ? BlockCache::kDirty : 0;
  if (tags[0] == block) {
    slots[0] |= dirty;
    ++counters.z_hits;
    return;
  }
  std::int32_t moved_tag = block;
  std::uint32_t moved_slot = 0;
  for (std::size_t way = 0; way < static_cast<std::size_t>(cache.ways); ++way) {
    const std::size_t entry = way * cache.of_way;
    std::swap(tags[entry], moved_tag);
    std::swap(slots[entry], moved_slot);
    if (moved_tag == block) {
      slots[0] = moved_slot | dirty;
      ++counters.z_hits;
      return;
    }
  }
  slots[0] = (moved_slot & ~BlockCache::kDirty) | dirty;
  const std::size_t word = at.word + static_cast<std::size_t>(part);
  if (stream != nullptr) {
    stream->miss(cache.miss(at, word, lane, moved_tag, (moved_slot & BlockCache::kDirty) != 0));
  }
  const bool cleared = (cache.cleared[word] >> lane & 1) != 0;
  ++counters.z_misses;
  counters.z_cleared += cleared ? 1 : 0;
  counters.bytes_read += cleared ? 0 : at.line_bytes;
  if ((moved_slot & BlockCache::kDirty) != 0) {
    const auto victim = static_cast<std::uint32_t>(moved_tag);
    ++counters.z_evicted;
    counters.bytes_written += cache.line_bytes(victim);
    std::uint16_t& cleared_there = cache.cleared[cache.word_of(at, word, victim)];
    cleared_there = static_cast<std::uint16_t>(cleared_there & ~(1u << lane));
  }
}

/// The lines of a tile, bits of parts: those that are touched, and of these those that are written to. An
/// access of `stream`, if there is one.
inline void access_parts(BlockCache& cache, const CachePlace& at, int lane, unsigned touched,
                         unsigned written, EarlyZCounters& counters, StreamWriter* stream) {
  for (int part = 0; part < cache.parts; ++part) {
    if ((touched >> part & 1) != 0) {
      access_line(cache, at, part, lane, (written >> part & 1) != 0, counters, stream);
    }
  }
  if (stream != nullptr) {
    stream->accessed();
  }
}

}  // namespace halfspace::fast
