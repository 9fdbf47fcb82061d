/// z_test, the second half of early_z: interpolates depth at the covered samples of a tile's quads, tests it
/// against the surface and writes it; and what the lines of the z cache hold, which move here.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "halfspace/numerics/depth.hpp"
#include "halfspace/numerics/sample_pattern.hpp"
#include "halfspace/units/depth_interpolator.hpp"
#include "halfspace/units/lazy_array.hpp"
#include "halfspace/units/packets.hpp"
#include "halfspace/units/tile_mask.hpp"
#include "halfspace/units/z_line.hpp"

namespace halfspace {

/// The state of a draw that early_z looks at.
struct EarlyZState {
  bool test = false;          ///< off: every fragment passes and nothing is written
  bool write = false;         ///< passing fragments write; only with the test on
  bool late = false;          ///< what passes writes after the shader, see late_writes.hpp; only with write
  bool unrestricted = false;  ///< the surface may hold depths outside [0, 1]: hi_z does not look at it
  DepthFunc func = DepthFunc::kAlways;
  DepthFormat format = DepthFormat::kNone;
  DepthInterpolator interpolator = DepthInterpolator::kPlane;
  int sub_pixel_bits = 8;
  int square_reach = 0;         ///< as SetupState has it
  bool inner_coverage = false;  ///< quads say which of their pixels the triangle fills; with outer pixels
  SamplePattern samples{};
};

/// True where a burst has to do with stored depth.
inline bool touches_depth(const EarlyZState& state) {
  return state.test && state.func != DepthFunc::kNever && (state.write || state.func != DepthFunc::kAlways);
}

/// Depth codes of a tile in row order; those of samples that are not covered mean nothing.
template <int TileSize>
using TileCodes = std::array<std::uint32_t, TileSize * TileSize>;

/// Codes at the covered samples of the burst.
template <int TileSize>
void interpolate_tile(const SetupTriangle& triangle, const QuadBurst& burst, const EarlyZState& state,
                      TileCodes<TileSize>& codes);

/// Tests the burst against `stored`, the tile's codes in the surface (TileSize^2, row order), writes those
/// that pass where the state says so and not late, and returns the mask of the samples that passed. All of a
/// sure burst pass, whatever `stored` holds. Fills `codes` when the test is on.
template <int TileSize>
TileMask z_test(const SetupTriangle& triangle, const QuadBurst& burst, const EarlyZState& state,
                std::uint32_t* stored, TileCodes<TileSize>& codes);

/// What the lines of the cache hold, as the test keeps it, and the state of the lines of memory.
class ZLines {
 public:
  struct Victim {
    std::uint32_t line = kNoZLine;  ///< of memory; none where the slot was free
    std::uint32_t bytes = 0;        ///< as memory has it, or is to have it
    bool dirty = false;
  };

  ZLines() = default;
  /// `memory_lines`: of all surfaces.
  ZLines(const ZCacheShape& shape, std::uint32_t memory_lines)
      : slots_(static_cast<std::size_t>(shape.lines)),
        cleared_(memory_lines),
        shifts_(zeroed_array<std::uint8_t>(memory_lines)) {}

  /// The line of memory is only marked cleared, so there is nothing to fetch.
  [[nodiscard]] bool cleared(std::uint32_t line) const { return cleared_[line]; }

  /// Bytes of a line in memory that has `line_bytes` where it is not coded.
  [[nodiscard]] std::uint32_t stored_bytes(std::uint32_t line, std::uint32_t line_bytes) const {
    return line_bytes >> shifts_[line];
  }

  /// Puts a line of `line_bytes` into a slot. A dirty victim is written back by the caller; it is then
  /// stored.
  Victim replace(std::uint32_t slot, std::uint32_t line, std::uint32_t line_bytes) {
    const Slot victim = slots_[slot];
    if (victim.dirty) {
      store(victim);
    }
    slots_[slot] = {.line = line, .line_bytes = line_bytes, .shift = 0, .dirty = false};
    return {.line = victim.line, .bytes = victim.bytes(), .dirty = victim.dirty};
  }

  /// `shift`: of the line as it is now, see units/z_codec.hpp.
  void mark_written(std::uint32_t slot, int shift) {
    slots_[slot].shift = static_cast<std::uint8_t>(shift);
    slots_[slot].dirty = true;
  }

  /// Marks the lines `first` to `last` of memory cleared, and drops them from the cache, dirty or not.
  void clear(std::uint32_t first, std::uint32_t last) {
    std::fill(cleared_.begin() + first, cleared_.begin() + last + 1, true);  // by words
    for (Slot& slot : slots_) {
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
        visit(slot, slots_[slot].line, slots_[slot].bytes());
        store(slots_[slot]);
        slots_[slot].dirty = false;
      }
    }
  }

 private:
  struct Slot {
    std::uint32_t line = kNoZLine;
    std::uint32_t line_bytes = 0;
    std::uint8_t shift = 0;
    bool dirty = false;

    [[nodiscard]] std::uint32_t bytes() const { return line_bytes >> shift; }
  };

  void store(const Slot& slot) {
    cleared_[slot.line] = false;
    shifts_[slot.line] = slot.shift;
  }

  std::vector<Slot> slots_;
  std::vector<bool> cleared_;
  LazyArray<std::uint8_t> shifts_;  ///< of lines in memory, by which they are coded
};

}  // namespace halfspace
