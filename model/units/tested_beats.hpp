/// A tested burst as the beats that leave early_z.
#pragma once

#include <cstdint>
#include <vector>

#include "halfspace/units/early_z.hpp"
#include "halfspace/units/link_packets.hpp"
#include "halfspace/units/quad_generator.hpp"

namespace halfspace {

/// The beats in the order in which they leave. `codes` of covered samples, 0 where there is no depth surface.
template <int TileSize>
std::vector<TestedBeat> tested_beats(const QuadBurst& burst, const TileMask& passed,
                                     const TileCodes<TileSize>& codes, const Widths& widths) {
  const Coverage& coverage = burst.coverage;
  std::vector<TestedBeat> beats;
  int quads = 0;
  for_each_quad<TileSize>(burst, [&](const Quad& quad) {
    const auto place = static_cast<std::size_t>(quads++ % widths.TestWidth);
    if (place == 0) {
      beats.push_back({.slot = coverage.slot, .tile_x = coverage.tile_x, .tile_y = coverage.tile_y});
    }
    TestedBeat& beat = beats.back();
    beat.index[place] = static_cast<std::uint8_t>(quad.y / 2 * (TileSize / 2) + quad.x / 2);
    beat.mask[place] = quad.mask;
    beat.passed[place] = quad_bits<TileSize>(passed, quad.x, quad.y);
    for (int sample = 0; sample < 4; ++sample) {
      if ((quad.mask >> sample & 1) != 0) {
        const int bit = (quad.y + sample / 2) * TileSize + quad.x + sample % 2;
        beat.depth[4 * place + static_cast<std::size_t>(sample)] = codes[static_cast<std::size_t>(bit)];
      }
    }
  });
  if (!beats.empty()) {
    beats.back().last = 1;
  }
  return beats;
}

}  // namespace halfspace
