/// A block job's passage through tile_walker: the unit, its counters and events.
#pragma once

#include "halfspace/machine/draw_context.hpp"
#include "halfspace/machine/packet_observer.hpp"
#include "halfspace/units/tile_walker.hpp"

namespace halfspace::passage {

/// Calls emit(job, whole) for every tile job of `block`.
template <int TileSize, class Emit>
void tile_walker(const BlockJob& block, const WalkerConfig& config, DrawContext& draw, Emit&& emit) {
  struct Sink {
    DrawContext& draw;
    Emit& emit;

    void tile(const TileJob& job, bool whole) {
      TileWalkerCounters& counters = draw.counters.tile_walker;
      ++(whole ? counters.tiles_accepted : counters.tiles_partial);
      if (draw.record_jobs) {
        draw.observer->tile_job(job);
      }
      emit(job, whole);
    }
  };
  Sink sink{.draw = draw, .emit = emit};
  halfspace::tile_walker<TileSize>(block, config, sink);
}

}  // namespace halfspace::passage
