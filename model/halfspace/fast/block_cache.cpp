#include "halfspace/fast/block_cache.hpp"

#include <algorithm>
#include <bit>
#include <utility>

namespace halfspace::fast {
namespace {

int x_set_bits(const ZCacheShape& shape) {
  return (std::countr_zero(static_cast<unsigned>(shape.sets())) + 1) / 2;
}
int y_set_bits(const ZCacheShape& shape) { return std::countr_zero(static_cast<unsigned>(shape.sets())) / 2; }

}  // namespace

bool BlockCache::takes(const ZCacheShape& shape, int block_shift) { return y_set_bits(shape) >= block_shift; }

std::uint32_t BlockCache::columns(const ZCacheShape& shape, int block_shift) {
  return 1u << (x_set_bits(shape) - block_shift);
}

BlockCache::BlockCache(const ZCacheShape& shape, int block_shift, std::vector<BlockSurface> all)
    : ways(shape.ways), parts(shape.parts), surfaces(std::move(all)) {
  const int x_bits = x_set_bits(shape) - block_shift;
  y_bits = y_set_bits(shape) - block_shift;
  x_mask = (1u << x_bits) - 1;
  y_mask = (1u << y_bits) - 1;
  groups = std::max<std::size_t>(1, (std::size_t{1} << 2 * block_shift) / kLanes);
  entries = groups * kLanes;
  of_part = entries;
  of_way = of_part * static_cast<std::size_t>(parts);
  of_block = kGap + of_way * static_cast<std::size_t>(ways);
  size = (of_block << (x_bits + y_bits)) + kGap;
  tag = unset_array<std::int32_t>(size);
  std::fill_n(tag.get(), size, kFree);
  slot = unset_array<std::uint32_t>(size);
  number_slots(shape, block_shift);
  words = surfaces.back().first * groups * static_cast<std::size_t>(parts);
  cleared = zeroed_array<std::uint16_t>(words);
}

void BlockCache::number_slots(const ZCacheShape& shape, int block_shift) {
  const std::size_t side = std::size_t{1} << block_shift;
  const int x_set = x_set_bits(shape);
  std::fill_n(slot.get(), size, 0);
  for (std::size_t i = 0; i < size; ++i) {
    if (i % of_block < kGap) {
      continue;
    }
    const std::size_t block = i / of_block;
    const std::size_t in_block = i % of_block - kGap;
    const std::size_t way = in_block / of_way;
    const std::size_t part = in_block % of_way / of_part;
    const std::size_t tile = in_block % entries % (side * side);  // no tile is behind a small block's last
    const std::size_t x = block >> y_bits << block_shift | tile % side;
    const std::size_t y = (block & y_mask) << block_shift | tile / side;
    const std::size_t set = x | y << x_set;
    slot[i] = static_cast<std::uint32_t>(
        (part * static_cast<std::size_t>(shape.sets()) + set) * static_cast<std::size_t>(shape.ways) + way);
  }
}

void BlockCache::clear(const BlockSurface& surface) {
  const auto first = static_cast<std::int32_t>(surface.first);
  const auto end = static_cast<std::int32_t>(surface.first + surface.blocks);
  std::vector<std::uint32_t> free;
  for (std::size_t line = 0; line < size / of_block * of_way; ++line) {
    const std::size_t begin = line / of_way * of_block + kGap + line % of_way;
    const std::size_t end_way = begin + of_way * static_cast<std::size_t>(ways);
    // What stays moves to the front; what is free follows, the one used longest ago last.
    free.clear();
    std::size_t kept = begin;
    for (std::size_t from = begin; from < end_way; from += of_way) {
      if (tag[from] == kFree || (tag[from] >= first && tag[from] < end)) {
        free.push_back(slot[from] & ~kDirty);
        continue;
      }
      tag[kept] = tag[from];
      slot[kept] = slot[from];
      kept += of_way;
    }
    for (const std::uint32_t each : free) {
      tag[kept] = kFree;
      slot[kept] = each;
      kept += of_way;
    }
  }
  const std::size_t of_block_words = groups * static_cast<std::size_t>(parts);
  std::fill_n(cleared.get() + surface.first * of_block_words, surface.blocks * of_block_words,
              std::uint16_t{0xFFFF});
}

std::vector<ZFlush> BlockCache::flush() const {
  std::vector<ZFlush> dirty;
  for (std::size_t i = 0; i < size; ++i) {
    if ((slot[i] & kDirty) != 0) {
      dirty.push_back({.slot = slot[i] & ~kDirty, .bytes = line_bytes(static_cast<std::uint32_t>(tag[i]))});
    }
  }
  std::ranges::sort(dirty, {}, &ZFlush::slot);
  return dirty;
}

}  // namespace halfspace::fast
