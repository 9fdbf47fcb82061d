/// What the raster kernels count of a draw.
#pragma once

#include <cstdint>

#include "halfspace/machine/draw_context.hpp"

namespace halfspace::fast {

struct Tallies {
  std::uint64_t bursts = 0;
  std::uint64_t fragments = 0;
  std::uint64_t quads = 0;
  std::uint64_t full_quads = 0;
  std::uint64_t survivors = 0;

  /// Adds them to the draw's, and begins again. `tile_quads`: in a tile.
  void add_to(DrawContext& draw, std::uint64_t tile_quads) {
    QuadGeneratorCounters& generator = draw.counters.quad_generator;
    generator.tiles += bursts;
    generator.fragments += fragments;
    generator.quads += quads;
    generator.quads_full += full_quads;
    generator.quads_empty += bursts * tile_quads - quads;
    generator.helpers += 4 * quads - fragments;
    EarlyZCounters& early_z = draw.counters.early_z;
    (draw.early_z.test ? early_z.tested : early_z.untested) += fragments;
    early_z.survivors += survivors;
    early_z.written += draw.early_z.write ? survivors : 0;
    *this = {};
  }
};

}  // namespace halfspace::fast
