// Without a guard that stops a second inclusion: once for each target of Highway.
#if defined(HALFSPACE_FAST_BLOCK_CACHE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HALFSPACE_FAST_BLOCK_CACHE_INL
#undef HALFSPACE_FAST_BLOCK_CACHE_INL
#else
#define HALFSPACE_FAST_BLOCK_CACHE_INL
#endif

#include <hwy/highway.h>

#include <bit>
#include <cstdint>

#include "halfspace/fast/block_cache.hpp"
#include "halfspace/fast/lanes-inl.hpp"
#include "halfspace/fast/tallies.hpp"

HWY_BEFORE_NAMESPACE();
namespace halfspace::fast::HWY_NAMESPACE {
namespace {

/// What tiles of a group missed: bits of lanes.
HWY_INLINE void count_misses(BlockCache& cache, const CachePlace& at, std::size_t word, std::uint32_t missed,
                             const std::int32_t* victim, std::uint32_t dirty, EarlyZCounters& counters) {
  const std::uint32_t cleared = missed & cache.cleared[word];
  counters.z_misses += ones(missed);
  counters.z_cleared += ones(cleared);
  counters.bytes_read += ones(missed & ~cleared) * at.line_bytes;
  counters.z_evicted += ones(dirty);
  while (dirty != 0) {
    const auto block = static_cast<std::uint32_t>(victim[std::countr_zero(dirty)]);
    const std::uint32_t same =
        dirty & group_bits([&](int i) { return bits_of(hn::Eq(hn::LoadU(Tag(), victim + i), set(block))); });
    counters.bytes_written += ones(same) * (block == at.block ? at.line_bytes : cache.line_bytes(block));
    std::uint16_t& there = cache.cleared[cache.word_of(at, word, block)];
    there = static_cast<std::uint16_t>(there & ~same);
    dirty &= ~same;
  }
}

/// Lines of one part of a group's tiles: bits of lanes that are touched, and of those that are written to.
/// Misses go to `stream`, if there is one.
inline void access_lines(BlockCache& cache, const CachePlace& at, int part, std::uint32_t touched,
                         std::uint32_t written, EarlyZCounters& counters, StreamWriter* stream) {
  const Tag tag;
  const std::size_t first = at.entry + static_cast<std::size_t>(part) * cache.of_part;
  std::int32_t* const tags = cache.tag.get() + first;
  auto* const slots = reinterpret_cast<std::int32_t*>(cache.slot.get() + first);
  const Vector block = set(at.block);
  const std::uint32_t recent =
      touched & group_bits([&](int i) { return bits_of(hn::Eq(hn::LoadU(tag, tags + i), block)); });
  const Vector dirty = set(BlockCache::kDirty);
  if (recent == touched) {
    for (int i = 0; i < kLanes; i += kWidth) {
      hn::BlendedStore(hn::Or(hn::LoadU(tag, slots + i), dirty), mask_of(written >> i), tag, slots + i);
    }
    counters.z_hits += ones(touched);
    return;
  }
  alignas(64) std::int32_t victim[kLanes];
  std::uint32_t missed = 0;
  std::uint32_t leaving = 0;
  const int ways = cache.ways;
  for (int i = 0; i < kLanes; i += kWidth) {
    const auto wanted = mask_of(touched >> i);
    // Lanes that no way so far has: what is there moves one way on.
    auto open = wanted;
    Vector moved_tag = block;
    Vector moved_slot = hn::Zero(tag);
    Vector found_slot = hn::Zero(tag);  // of a line that is there
    for (int way = 0; way < ways; ++way) {
      const std::size_t entry = static_cast<std::size_t>(way) * cache.of_way + static_cast<std::size_t>(i);
      const Vector old_tag = hn::LoadU(tag, tags + entry);
      const Vector old_slot = hn::LoadU(tag, slots + entry);
      hn::BlendedStore(moved_tag, open, tag, tags + entry);
      hn::BlendedStore(moved_slot, open, tag, slots + entry);
      const auto hit = hn::And(open, hn::Eq(old_tag, block));
      found_slot = hn::IfThenElse(hit, old_slot, found_slot);
      moved_tag = old_tag;
      moved_slot = old_slot;
      open = hn::AndNot(hit, open);
    }
    hn::Store(moved_tag, tag, victim + i);
    missed |= bits_of(open) << i;
    leaving |= bits_of(hn::And(open, hn::Lt(moved_slot, hn::Zero(tag)))) << i;
    // A line that was not there takes the slot that its victim had.
    found_slot = hn::IfThenElse(open, hn::AndNot(dirty, moved_slot), found_slot);
    found_slot = hn::Or(found_slot, hn::IfThenElseZero(mask_of(written >> i), dirty));
    hn::BlendedStore(found_slot, wanted, tag, slots + i);
  }
  counters.z_hits += ones(touched & ~missed);
  if (missed != 0) {
    const std::size_t word = at.word + static_cast<std::size_t>(part);
    if (stream != nullptr) {
      for (std::uint32_t left = missed; left != 0; left &= left - 1) {
        const int lane = std::countr_zero(left);
        stream->miss(cache.miss(at, word, lane, victim[lane], (leaving >> lane & 1) != 0),
                     static_cast<std::uint32_t>(ones(touched & ((1u << lane) - 1))));
      }
    }
    count_misses(cache, at, word, missed, victim, leaving, counters);
  }
}

}  // namespace
}  // namespace halfspace::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
