#include "halfspace/timing/systemc/early_z.hpp"

#include <algorithm>
#include <vector>

namespace halfspace::systemc {

EarlyZ::EarlyZ(const sc_core::sc_module_name& name, RunState& run, JobReturns& returns, std::uint64_t base)
    : sc_module(name),
      cache(run, base),
      lookup("z_lookup", run, cache),
      test("z_test", run, returns, cache),
      control("z_control", run, cache),
      run_(run) {}

void EarlyZ::begin_frame() {
  cache.begin_frame();
  lookup.begin_frame();
  test.begin_frame();
}

void EarlyZ::read_surface(std::uint32_t surface, TiledImage<std::uint32_t>& codes) {
  const ZSurface& place = run_.places[surface];
  const int parts = run_.config.z_cache.parts;
  std::vector<std::uint8_t> bytes;
  std::vector<std::uint32_t> line_codes;
  for (std::uint32_t tile = 0; tile < place.tiles; ++tile) {
    const std::uint32_t x = tile % place.tiles_x;
    const std::uint32_t y = tile / place.tiles_x;
    std::uint32_t* to = codes.tile(static_cast<int>(x), static_cast<int>(y));
    for (int part = 0; part < parts; ++part) {
      const std::uint32_t line = place.line(x, y, parts, part);
      if (cache.lines.cleared(line)) {
        to = std::fill_n(to, cache.memory.layout.samples(line), cache.clear_code[surface]);
      } else {
        bytes.resize(cache.stored_bytes(line));
        cache.memory.access_in_no_time(tlm::TLM_READ_COMMAND, line, bytes);
        cache.unpack(line, bytes, line_codes);
        to = std::copy(line_codes.begin(), line_codes.end(), to);
      }
    }
  }
}

}  // namespace halfspace::systemc
