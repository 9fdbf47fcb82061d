#include "halfspace/timing/systemc/z_control.hpp"

#include <algorithm>

#include "halfspace/units/z_control.hpp"

namespace halfspace::systemc {

ZControl::ZControl(const sc_core::sc_module_name& name, RunState& run, ZCacheState& cache)
    : sc_module(name), run_(run), cache_(cache) {}

void ZControl::clear(std::uint32_t surface, std::uint32_t code) {
  const int parts = run_.config.z_cache.parts;
  const ZSurface& place = run_.places[surface];
  z_clear(cache_.tags, cache_.lines, place, parts);
  const std::uint32_t first = place.line(0, 0, parts, 0);
  const std::uint32_t lines = place.tiles * static_cast<std::uint32_t>(parts);
  for (std::uint32_t& line : cache_.line_of_slot) {
    line = line - first < lines ? kNoZLine : line;
  }
  cache_.clear_code[surface] = code;
}

Cycle ZControl::wait_until_written() {
  while (cache_.writes_done != cache_.writes_sent) {
    run_.clock.wait_for(cache_.exit_changed);
  }
  return cache_.next_write;
}

Cycle ZControl::flush(Cycle begin) {
  Cycle next = begin;
  std::uint32_t next_slot = 0;
  z_flush(cache_.lines, [&](std::uint32_t slot, std::uint32_t line, std::uint32_t bytes) {
    const Cycle at = std::max(next + (slot - next_slot), cache_.write_buffers.credit(1));
    run_.clock.wait_until(at);
    cache_.send(nullptr, line, bytes, slot, at);
    next = at + 1;
    next_slot = slot + 1;
    ++run_.result.flushed_lines;
    run_.result.flushed_bytes += bytes;
  });
  const Cycle scanned = next + (static_cast<std::uint32_t>(run_.config.z_cache.lines) - next_slot);
  return std::max(scanned, wait_until_written()) - 1;
}

}  // namespace halfspace::systemc
