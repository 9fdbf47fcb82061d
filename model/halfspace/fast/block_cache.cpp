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

BlockCache::BlockCache(const ZCacheShape& shape, int block_shift, std::vector<BlockSurface> all)
    : ways(shape.ways), parts(shape.parts), surfaces(std::move(all)) {
  x_bits = x_set_bits(shape) - block_shift;
  const int y_bits = y_set_bits(shape) - block_shift;
  x_mask = (1u << x_bits) - 1;
  y_mask = (1u << y_bits) - 1;
  groups = std::max<std::size_t>(1, (std::size_t{1} << 2 * block_shift) / kLanes);
  entries = groups * kLanes;
  of_part = entries << (x_bits + y_bits);
  of_way = of_part * static_cast<std::size_t>(parts);
  tag.assign(of_way * static_cast<std::size_t>(ways), kFree);
  slot.assign(tag.size(), 0);
  cleared.assign((surfaces.back().first * groups) * static_cast<std::size_t>(parts), 0);
}

void BlockCache::clear(const BlockSurface& surface) {
  const auto first = static_cast<std::int32_t>(surface.first);
  const auto end = static_cast<std::int32_t>(surface.first + surface.blocks);
  for (std::size_t set = 0; set < of_way; ++set) {
    // What stays moves to the front; what is free follows, the one used longest ago last.
    std::size_t kept = 0;
    for (std::size_t way = 0; way < static_cast<std::size_t>(ways); ++way) {
      const std::size_t from = way * of_way + set;
      if (tag[from] < first || tag[from] >= end) {
        if (tag[from] != kFree) {
          std::swap(tag[kept * of_way + set], tag[from]);
          std::swap(slot[kept * of_way + set], slot[from]);
          ++kept;
        }
        continue;
      }
      tag[from] = kFree;
      slot[from] = 0;
    }
  }
  const std::size_t words = groups * static_cast<std::size_t>(parts);
  std::fill_n(cleared.begin() + static_cast<std::ptrdiff_t>(surface.first * words), surface.blocks * words,
              std::uint16_t{0xFFFF});
}

void BlockCache::flush(std::uint64_t& lines, std::uint64_t& bytes) const {
  for (std::size_t i = 0; i < tag.size(); ++i) {
    if ((slot[i] & kDirty) != 0) {
      ++lines;
      bytes += line_bytes(static_cast<std::uint32_t>(tag[i]));
    }
  }
}

}  // namespace halfspace::fast
