/// A burst as the beats that cross the links before and behind early_z.
#pragma once

#include <vector>

#include "halfspace/units/link_packets.hpp"
#include "halfspace/units/quad_generator.hpp"
#include "halfspace/units/z_test.hpp"

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
  const std::uint8_t sure = sure_parts<TileSize>(coverage, widths.ZParts);
  for (QuadBeat& beat : beats) {
    beat.parts = head.parts;
    for (std::size_t part = 0; part < beat.sure.size(); ++part) {
      beat.sure[part] = sure >> part & 1;
    }
    beat.last = &beat == &beats.back() ? 1 : 0;
  }
  return beats;
}

/// The same burst after the test; `inner`: of the covered pixels those that the triangle fills, none without
/// inner coverage; `codes` are those of its samples, all 0 where there is no depth surface.
template <int TileSize>
std::vector<TestedBeat> tested_beats(const QuadBurst& burst, const TileMask& passed, const TileMask& inner,
                                     const TileCodes<TileSize>& codes, const Widths& widths) {
  const Coverage& coverage = burst.coverage;
  const int most = TileSize * TileSize / 4 / widths.TestWidth + 1;
  std::vector<TestedBeat> beats;
  beats.reserve(static_cast<std::size_t>(most));  // they are large
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
    beat.inner[place] = quad_bits<TileSize>(inner, quad.x, quad.y);
    for (int sample = 0; sample < 4; ++sample) {
      if ((quad.mask >> sample & 1) != 0) {
        const int at = (quad.y + sample / 2) * TileSize + quad.x + sample % 2;
        beat.depth[4 * place + static_cast<std::size_t>(sample)] = codes[static_cast<std::size_t>(at)];
      }
    }
  });
  if (!beats.empty()) {
    beats.back().last = 1;
  }
  return beats;
}

}  // namespace halfspace
