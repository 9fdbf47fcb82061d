/// The z cache of early_z as a whole: which lines of the depth surfaces are on the chip, which of them are
/// dirty, and which lines of memory are only marked cleared.
///
/// Its state is in two halves, because hardware has them at two places of the pipe, each of which sees all
/// bursts in order: ZTags at z_lookup, ZLines at z_test, where the data moves.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "halfspace/units/late_writes.hpp"
#include "halfspace/units/z_control.hpp"
#include "halfspace/units/z_line.hpp"
#include "halfspace/units/z_lookup.hpp"
#include "halfspace/units/z_test.hpp"

namespace halfspace {

/// A part of a burst's tile that the cache did not have.
struct ZMiss {
  std::uint32_t line = 0;           ///< of memory
  std::uint32_t victim = kNoZLine;  ///< of memory, the line that had to leave
  std::uint16_t bytes = 0;          ///< that memory has of the line
  std::uint16_t victim_bytes = 0;   ///< that it gets of the victim
  bool fetch = false;               ///< asked for; else made from the clear value
  bool overwritten = false;         ///< the burst overwrites it whole: not asked for, and made of anything
  bool write_back = false;          ///< the victim was dirty
};

/// What a burst wants of the parts of its tile: a bit each.
struct ZAccess {
  std::uint8_t touched = 0;
  std::uint8_t written = 0;
  std::uint8_t sure = 0;    ///< overwritten whole
  ZShifts shifts{};         ///< by which those that it wrote to are coded then
  bool late = false;        ///< it writes late,
  bool late_write = false;  ///< and something passed
};

/// The misses of a burst, in order of parts.
struct ZMisses {
  std::uint32_t late_done = 0;  ///< late writes of the frame that are done before it is tested, where it
                                ///< waits for one or leaves one; else 0
  std::size_t count = 0;
  std::array<ZMiss, kMaxZParts> part;

  [[nodiscard]] std::span<const ZMiss> parts() const { return {part.data(), count}; }
};

/// Both halves, for those who take one burst after the other through lookup and test.
class ZCache {
 public:
  ZCache() = default;
  ZCache(const ZCacheShape& shape, std::uint32_t memory_lines)
      : shape_(shape), tags_(shape), lines_(shape, memory_lines), late_(shape.late_writes) {}

  ZMisses access(const ZSurface& surface, std::uint32_t tile_x, std::uint32_t tile_y, const ZAccess& access) {
    ZMisses misses;
    ZSlots slots;
    for (int i = 0; i < shape_.parts; ++i) {
      if ((access.touched >> i & 1) == 0) {
        continue;
      }
      const std::uint32_t line = surface.line(tile_x, tile_y, shape_.parts, i);
      const ZTags::Lookup found = tags_.lookup(tile_x, tile_y, i, line);
      slots.add(i, found.slot);
      if (!found.hit) {
        const bool overwritten = (access.sure >> i & 1) != 0;
        const bool fetch = !overwritten && !lines_.cleared(line);
        const ZLines::Victim victim = lines_.replace(found.slot, line, surface.line_bytes);
        misses.part[misses.count++] = {
            .line = line,
            .victim = victim.line,
            .bytes = static_cast<std::uint16_t>(lines_.stored_bytes(line, surface.line_bytes)),
            .victim_bytes = static_cast<std::uint16_t>(victim.bytes),
            .fetch = fetch,
            .overwritten = overwritten,
            .write_back = victim.dirty};
      }
      if ((access.written >> i & 1) != 0) {
        lines_.mark_written(found.slot, access.shifts.of(i));
      }
    }
    if (shape_.late_writes != 0) {
      const std::uint32_t done = late_.done();
      late_.make_way(slots, access.late);
      if (late_.done() != done || access.late_write) {
        misses.late_done = late_.done();
      }
      if (access.late_write) {
        late_.add(slots);
      }
    }
    return misses;
  }

  void clear(const ZSurface& surface) {
    late_.finish_all();
    z_clear(tags_, lines_, surface, shape_.parts);
  }

  /// See z_flush.
  template <class Visit>
  void flush(Visit&& visit) {
    late_.finish_all();
    z_flush(lines_, std::forward<Visit>(visit));
  }

 private:
  ZCacheShape shape_;
  ZTags tags_;
  ZLines lines_;
  LateWrites late_;
};

}  // namespace halfspace
