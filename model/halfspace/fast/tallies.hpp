/// What the raster kernels count of a draw.
#pragma once

#include <hwy/base.h>

#include <array>
#include <bit>
#include <cstdint>

#include "halfspace/machine/draw_context.hpp"

namespace halfspace::fast {

// Inlined, so that they count as the instruction set of who calls can.

/// Bits that are set.
HWY_INLINE std::uint64_t ones(std::uint64_t bits) { return static_cast<std::uint64_t>(std::popcount(bits)); }

/// Tiles that the walker decided, a bit each. `accepted`: those inside each edge.
HWY_INLINE void count_tiles(std::uint32_t rejected, std::uint32_t whole, std::uint32_t partial,
                            const std::array<std::uint32_t, 3>& accepted, Counters& counters) {
  counters.block_walker.tiles_rejected += ones(rejected);
  counters.tile_walker.tiles_accepted += ones(whole);
  counters.tile_walker.tiles_partial += ones(partial);
  std::uint64_t skipped = 0;
  for (const std::uint32_t edge : accepted) {
    skipped += ones(edge & partial);
  }
  EdgeEvaluatorCounters& evaluator = counters.edge_evaluator;
  evaluator.tiles_skipped += ones(whole);
  evaluator.tiles += ones(partial);
  evaluator.edges_skipped += skipped;
  evaluator.edges += 3 * ones(partial) - skipped;
}

/// Apart from the draw's own: what is counted all the time must not lie beside what other threads read.
struct Tallies {
  Counters counters;  ///< all but what the following give
  std::uint64_t bursts = 0;
  std::uint64_t fragments = 0;
  std::uint64_t quads = 0;
  std::uint64_t full_quads = 0;
  std::uint64_t survivors = 0;

  /// Adds them to the draw's, and begins again. `tile_quads`: in a tile.
  void add_to(DrawContext& draw, std::uint64_t tile_quads) {
    draw.counters += counters;
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
