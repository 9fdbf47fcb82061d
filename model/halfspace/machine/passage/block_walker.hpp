/// A triangle's passage through block_walker: the unit, its counters, sums and events, and the slot that its
/// jobs carry.
#pragma once

#include <bit>
#include <cstdint>

#include "halfspace/machine/draw_context.hpp"
#include "halfspace/machine/passage/packet_sums.hpp"
#include "halfspace/units/block_walker.hpp"
#include "halfspace/units/tile_walker.hpp"

namespace halfspace::passage {

/// The block walker of one machine.
class BlockWalker {
 public:
  BlockWalker() = default;
  explicit BlockWalker(const WalkerConfig& config) : config_(config) {}

  /// Walks `triangle`, and calls emit(block, empty) for every block job, with the steps that gave out none
  /// since the job before. Returns those after the last job.
  template <int TileSize, class Emit>
  std::uint32_t walk(const SetupTriangle& triangle, DrawContext& draw, Emit&& emit) {
    Sink<TileSize, Emit> sink{.config = config_, .triangle = triangle, .draw = draw, .emit = emit};
    block_walker<TileSize>(triangle, config_, slot_, sink);
    // A slot is taken again only after 256 triangles with jobs, so that none is while its triangle is under
    // way to hi_z, or where the machine has none, to early_z.
    slot_ = static_cast<std::uint8_t>(slot_ + (sink.emitted ? 1 : 0));
    return sink.empty;
  }

  /// The slot of the next triangle.
  [[nodiscard]] std::uint8_t slot() const { return slot_; }
  /// As after a reset.
  void reset() { slot_ = 0; }

 private:
  /// What the unit calls.
  template <int TileSize, class Emit>
  struct Sink {
    const WalkerConfig& config;
    const SetupTriangle& triangle;
    DrawContext& draw;
    Emit& emit;
    std::uint32_t empty = 0;  ///< steps since the last job
    bool emitted = false;

    void block(const BlockJob& job, std::uint64_t touched) {
      const std::uint64_t rejected = touched & ~job.tiles;
      BlockWalkerCounters& counters = draw.counters.block_walker;
      ++counters.blocks;
      counters.tiles_rejected += static_cast<std::uint64_t>(std::popcount(rejected));
      if (draw.sums != nullptr || draw.record_decisions) {
        show_decisions(job, touched);
      }
      if (draw.record_walk) {
        draw.observer->block_walked(job, touched);
      }
      if (job.tiles == 0) {
        ++counters.blocks_empty;
        ++empty;
        return;
      }
      emitted = true;
      const std::uint32_t before = empty;
      empty = 0;
      emit(job, before);
    }

    void pass(const GridPlace& cell, int side) {
      ++draw.counters.block_walker.passes;
      ++empty;
      if (draw.record_walk) {
        draw.observer->walk_led({.x = cell.x * side, .y = cell.y * side}, side);
      }
    }

    /// All of a block, in row order: also those that tile_walker makes of its tiles, later on.
    void show_decisions(const BlockJob& job, std::uint64_t touched) {
      struct Whole {
        std::uint64_t tiles =
            ~std::uint64_t{0};  ///< those with all samples covered, as far as they were seen
        int row_tiles;
        int samples;
        void tile(const TileJob& tile_job, bool whole) {
          const int column = tile_job.tile_x / samples;
          tiles &= ~(std::uint64_t{!whole} << (tile_job.tile_y % row_tiles * row_tiles + column % row_tiles));
        }
      };
      const int row_tiles = config.block_size / TileSize;
      Whole whole{.row_tiles = row_tiles, .samples = config.samples.count};
      tile_walker<TileSize>(job, config, whole);
      for (std::uint64_t left = touched; left != 0; left &= left - 1) {
        const int tile = std::countr_zero(left);
        const TileVerdict verdict = (job.tiles >> tile & 1) == 0     ? TileVerdict::kReject
                                    : (whole.tiles >> tile & 1) != 0 ? TileVerdict::kAccept
                                                                     : TileVerdict::kPartial;
        show_decision(job.block_x * row_tiles + tile % row_tiles, job.block_y * row_tiles + tile / row_tiles,
                      verdict, triangle.triangle, draw);
      }
    }
  };

  WalkerConfig config_;
  std::uint8_t slot_ = 0;
};

}  // namespace halfspace::passage
