/// A coverage's passage through quad_generator: the unit and its counters.
#pragma once

#include <cstdint>

#include "halfspace/machine/draw_context.hpp"
#include "halfspace/units/quad_generator.hpp"
#include "halfspace/units/tile_mask.hpp"

namespace halfspace {

/// A burst and how much it holds.
struct Burst {
  QuadBurst packet;
  int quads = 0;
  int fragments = 0;  ///< covered samples
};

}  // namespace halfspace

namespace halfspace::passage {

/// `coverage` must hold a sample: nothing leaves the unit for one that is empty.
template <int TileSize>
Burst quad_generator(const Coverage& coverage, DrawContext& draw) {
  Burst burst{.packet = halfspace::quad_generator<TileSize>(coverage),
              .fragments = popcount<TileSize>(coverage.mask)};
  burst.quads = popcount<TileSize>(burst.packet.quads);
  const auto quads = static_cast<std::uint64_t>(burst.quads);
  const auto fragments = static_cast<std::uint64_t>(burst.fragments);
  QuadGeneratorCounters& counters = draw.counters.quad_generator;
  ++counters.tiles;
  counters.fragments += fragments;
  counters.quads += quads;
  counters.quads_full += static_cast<std::uint64_t>(popcount<TileSize>(full_quads<TileSize>(burst.packet)));
  counters.quads_empty += TileSize * TileSize / 4 - quads;
  counters.helpers += 4 * quads - fragments;
  return burst;
}

}  // namespace halfspace::passage
