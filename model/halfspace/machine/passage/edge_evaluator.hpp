/// A tile job's passage through edge_evaluator: the unit and its counters.
#pragma once

#include <bit>
#include <cstdint>

#include "halfspace/machine/draw_context.hpp"
#include "halfspace/units/edge_evaluator.hpp"

namespace halfspace::passage {

/// `whole`: all samples of the tile are covered.
template <int TileSize>
Coverage edge_evaluator(const TileJob& job, bool whole, DrawContext& draw) {
  const Coverage coverage = halfspace::edge_evaluator<TileSize>(job, draw.setup.sub_pixel_bits);
  EdgeEvaluatorCounters& counters = draw.counters.edge_evaluator;
  if (whole) {
    ++counters.tiles_skipped;  // every edge is accepted: there is none to look at
  } else {
    ++counters.tiles;
    const int skipped = std::popcount(job.accept);
    counters.edges_skipped += static_cast<std::uint64_t>(skipped);
    counters.edges += static_cast<std::uint64_t>(3 - skipped);
  }
  counters.tiles_empty += any(coverage.mask) ? 0 : 1;
  return coverage;
}

}  // namespace halfspace::passage
