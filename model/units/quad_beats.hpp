/// A burst as the beats that cross the link between quad_generator and early_z.
#pragma once

#include <vector>

#include "halfspace/units/link_packets.hpp"
#include "halfspace/units/quad_generator.hpp"

namespace halfspace {

/// The beats of a burst in the order in which they leave; none for a burst without quads.
template <int TileSize>
std::vector<QuadBeat> quad_beats(const QuadBurst& burst, const Widths& widths) {
  const Coverage& coverage = burst.coverage;
  QuadBeat head{.slot = coverage.slot, .tile_x = coverage.tile_x, .tile_y = coverage.tile_y, .e = coverage.e};
  std::vector<QuadBeat> beats;
  int quads = 0;
  for_each_quad<TileSize>(burst, [&](const Quad& quad) {
    const auto place = static_cast<std::size_t>(quads++ % widths.QuadWidth);
    if (place == 0) {
      beats.push_back(head);
    }
    beats.back().index[place] = static_cast<std::uint8_t>(quad.y / 2 * (TileSize / 2) + quad.x / 2);
    beats.back().mask[place] = quad.mask;
    head.parts[static_cast<std::size_t>(quad.y * widths.ZParts / TileSize)] = 1;
  });
  for (QuadBeat& beat : beats) {
    beat.parts = head.parts;
    beat.last = &beat == &beats.back() ? 1 : 0;
  }
  return beats;
}

}  // namespace halfspace
