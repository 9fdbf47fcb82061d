/// z_control of early_z: clears of whole surfaces, and the flush at the end of a frame.
#pragma once

#include <cstdint>
#include <utility>

#include "halfspace/units/z_lookup.hpp"
#include "halfspace/units/z_test.hpp"

namespace halfspace {

/// Marks all lines of a surface cleared, and drops them from the z cache, dirty or not. `parts`: lines of a
/// tile.
inline void z_clear(ZTags& tags, ZLines& lines, const ZSurface& surface, int parts) {
  const std::uint32_t first = surface.line(0, 0, parts, 0);
  const std::uint32_t last = first + surface.tiles * static_cast<std::uint32_t>(parts) - 1;
  tags.drop(first, last);
  lines.clear(first, last);
}

/// Writes back what is dirty: calls visit(slot, line, bytes) for it, in order of slots.
template <class Visit>
void z_flush(ZLines& lines, Visit&& visit) {
  lines.flush(std::forward<Visit>(visit));
}

}  // namespace halfspace
