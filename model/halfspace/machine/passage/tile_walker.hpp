/// A triangle's passage through tile_walker: the unit, its steps, its counters, sums and events, and the slot
/// that its jobs carry.
#pragma once

#include <cstdint>

#include "halfspace/machine/draw_context.hpp"
#include "halfspace/machine/packet_observer.hpp"
#include "halfspace/machine/passage/packet_sums.hpp"
#include "halfspace/units/tile_walker.hpp"

namespace halfspace::passage {

/// The walker of one machine.
class TileWalker {
 public:
  TileWalker() = default;
  explicit TileWalker(const WalkerConfig& config) : config_(config) {}

  /// Walks `triangle`, and calls emit(job, work, steps) for every tile job, with the walker's steps since the
  /// job before, its own included. Returns the steps after the last job.
  template <int TileSize, class Emit>
  std::uint32_t walk(const SetupTriangle& triangle, DrawContext& draw, Emit&& emit) {
    Sink<TileSize, Emit> sink{.triangle = triangle, .draw = draw, .emit = emit};
    tile_walker<TileSize>(triangle, config_, slot_, sink);
    // A slot is taken again only after 256 triangles with jobs, so that none is while its triangle is under
    // way.
    slot_ = static_cast<std::uint8_t>(slot_ + (sink.emitted ? 1 : 0));
    return sink.steps;
  }

  /// The slot of the next triangle.
  [[nodiscard]] std::uint8_t slot() const { return slot_; }
  /// As after a reset.
  void reset() { slot_ = 0; }

 private:
  /// What the unit calls.
  template <int TileSize, class Emit>
  struct Sink {
    const SetupTriangle& triangle;
    DrawContext& draw;
    Emit& emit;
    std::uint32_t steps = 0;  ///< since the last job
    bool emitted = false;

    void decision(int x, int y, int size, TileVerdict verdict) {
      ++steps;
      count(draw.counters.tile_walker, verdict, size != TileSize);
      if (draw.sums != nullptr) {
        count_decision<TileSize>(*draw.sums, x, y, size, verdict);
      }
      if (draw.record_decisions) {
        draw.observer->decision({.draw = draw.draw,
                                 .triangle = triangle.triangle,
                                 .surface = draw.surface,
                                 .x = static_cast<std::uint32_t>(x),
                                 .y = static_cast<std::uint32_t>(y),
                                 .size = static_cast<std::uint32_t>(size),
                                 .verdict = verdict});
      }
    }

    void tile(const TileJob& job, TileWork work) {
      const bool by_block = work == TileWork::kWholeByBlock;
      steps += by_block ? 1 : 0;  // no decision came before it
      draw.counters.tile_walker.tiles_by_block += by_block ? 1 : 0;
      emitted = true;
      if (draw.record_jobs) {
        draw.observer->tile_job(job);
      }
      const std::uint32_t taken = steps;
      steps = 0;
      emit(job, work, taken);
    }
  };

  static void count(TileWalkerCounters& counters, TileVerdict verdict, bool block) {
    switch (verdict) {
      case TileVerdict::kReject:
        ++(block ? counters.blocks_rejected : counters.tiles_rejected);
        break;
      case TileVerdict::kAccept:
        ++(block ? counters.blocks_accepted : counters.tiles_accepted);
        break;
      case TileVerdict::kPartial:
        ++(block ? counters.blocks_partial : counters.tiles_partial);
        break;
    }
  }

  WalkerConfig config_;
  std::uint8_t slot_ = 0;
};

}  // namespace halfspace::passage
