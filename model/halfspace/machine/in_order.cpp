#include "halfspace/machine/in_order.hpp"

#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "halfspace/machine/draw_state.hpp"
#include "halfspace/machine/frame_source.hpp"
#include "halfspace/machine/passage/block_walker.hpp"
#include "halfspace/machine/passage/edge_evaluator.hpp"
#include "halfspace/machine/passage/hi_z.hpp"
#include "halfspace/machine/passage/interpolator.hpp"
#include "halfspace/machine/passage/quad_generator.hpp"
#include "halfspace/machine/passage/setup.hpp"
#include "halfspace/machine/passage/sink.hpp"
#include "halfspace/machine/passage/tile_walker.hpp"
#include "halfspace/machine/passage/z_lookup.hpp"
#include "halfspace/machine/passage/z_test.hpp"
#include "halfspace/machine/stream_writer.hpp"
#include "halfspace/machine/surfaces.hpp"
#include "halfspace/machine/tile_size.hpp"
#include "halfspace/units/z_cache.hpp"

namespace halfspace {
namespace {

/// Quads wait here for the cycle of their burst.
class QuadQueue {
 public:
  QuadQueue(PacketObserver* observer, const Config& config)
      : observer_(observer),
        leave_together_(config.interpolator.enabled),
        quads_per_cycle_(static_cast<std::uint64_t>(config.early_z.quads_per_cycle)) {}

  /// Quad `number` of the burst that is the next to be counted.
  void add(const QuadEvent& quad, std::size_t number) {
    waiting_.push_back({.quad = quad, .burst = bursts_, .number = number});
  }
  void count_burst() { ++bursts_; }

  /// Shows the quads of the bursts that were counted. `first_beat`: the cycle of each.
  void show(const std::vector<std::uint64_t>& first_beat) {
    for (Waiting& each : waiting_) {
      each.quad.cycle = first_beat[each.burst] + (leave_together_ ? 0 : each.number / quads_per_cycle_);
      observer_->quad(each.quad);
    }
    waiting_.clear();
    bursts_ = 0;
  }

 private:
  struct Waiting {
    QuadEvent quad;
    std::size_t burst;
    std::size_t number;
  };
  PacketObserver* observer_;
  bool leave_together_;
  std::uint64_t quads_per_cycle_;
  std::vector<Waiting> waiting_;
  std::size_t bursts_ = 0;
};

template <int TileSize>
class InOrderRun {
 public:
  InOrderRun(const Frame& frame, const Config& config, const Watch& watch, StreamReader* reader)
      : frame_(frame),
        config_(config),
        observer_(watch.observer),
        reader_(reader),
        walk_(walker_config(config)),
        walker_(walk_),
        quads_(watch.observer, config) {
    result_.surfaces = make_surfaces(frame, config, watch);
    places_ = place_surfaces(result_.surfaces, config);
    const ZCacheShape shape = z_cache_shape(config);
    z_cache_ = ZCache(shape, memory_lines(places_, shape));
    blocks_ = place_blocks(result_.surfaces, config);
    hi_z_ = make_hi_z(blocks_, config);
    if (reader != nullptr) {
      stream_.emplace(*reader);
      wants_tiles_ = reader->wants_tiles();
      wants_live_ = reader->wants_live();
      wants_cycles_ = shows_cycles(watch, *reader);
      reader->begin(stream_surfaces(result_.surfaces), memory_lines(places_, shape));
    }
  }

  FrameResult run() {
    FrameSource source(frame_, config_, observer_, result_.surfaces, result_, draws_);
    for (std::uint32_t i = 0; i < frame_.commands.size(); ++i) {
      DrawContext* const draw = source.begin(i);
      if (draw != nullptr) {
        begin(*draw);
      }
      while (const std::optional<SourceItem> item = source.next()) {
        if (item->draw == nullptr) {
          fast_clear(*item);
          continue;
        }
        for (const ScreenTriangle& triangle : item->triangles) {
          set_up(triangle);
        }
      }
      if (draw != nullptr && stream_) {
        stream_->end_segment(draw->counters.setup.triangles);
      }
    }
    flush();
    collect_draws(draws_, result_);
    return std::move(result_);
  }

 private:
  void begin(DrawContext& draw) {
    draw_ = &draw;
    surface_ = &result_.surfaces[draw.drawn_on];
    touches_depth_ = touches_depth(draw.early_z);
    if (stream_) {
      using Kind = StreamSegment::Kind;
      stream_->begin_segment(draw.is_clear() ? Kind::kDrawnClear : Kind::kDraw, draw.surface, touches_depth_);
    }
  }

  void fast_clear(const SourceItem& item) {
    clear_surface(result_.surfaces[item.surface], item.code);
    z_cache_.clear(places_[item.surface]);
    if (config_.hi_z.enabled) {
      hi_z_.clear(blocks_[item.surface], item.code);
    }
    if (stream_) {
      stream_->begin_segment(StreamSegment::Kind::kFastClear, item.surface, false);
      stream_->end_segment(0);
    }
  }

  void set_up(const ScreenTriangle& triangle) {
    if (!passage::setup(triangle, *draw_, triangle_)) {
      return;
    }
    if (stream_) {
      stream_->drawn(static_cast<std::uint32_t>(draw_->counters.setup.triangles - 1));
    }
    const std::uint32_t empty_after = walker_.walk<TileSize>(
        triangle_, *draw_, [this](const BlockJob& block, std::uint32_t empty) { this->block(block, empty); });
    if (stream_) {
      stream_->walked(empty_after);
      if (stream_->full()) {
        give(false);
      }
    }
  }

  void block(BlockJob block, std::uint32_t empty_before) {
    if (config_.hi_z.enabled) {
      passage::hi_z(hi_z_, block, triangle_.depth,
                    draw_->surface == kNoSurface ? HiZSurface{} : blocks_[draw_->surface], *draw_);
    }
    if (stream_) {
      if (stream_->full()) [[unlikely]] {
        give(true);
      }
      stream_->block(empty_before);
    }
    passage::tile_walker<TileSize>(block, walk_, *draw_,
                                   [this](const TileJob& job, bool whole) { this->job(job, whole); });
  }

  void job(const TileJob& job, bool whole) {
    const Coverage coverage = passage::edge_evaluator<TileSize>(job, whole, *draw_);
    int quads = 0;
    update_ = {};
    if (any(coverage.mask)) {
      quads = burst(passage::quad_generator<TileSize>(coverage, *draw_));
    }
    if (config_.hi_z.enabled) {
      hi_z_.retire(update_);
    }
    if (stream_) {
      stream_->job(quads);
      if (wants_tiles_) {
        const std::uint32_t column = job.tile_x / static_cast<std::uint32_t>(config_.raster.samples);
        stream_->tile({.x = column * TileSize, .y = std::uint32_t{job.tile_y} * TileSize});
      }
    }
  }

  /// Returns the burst's quads.
  int burst(const Burst& burst) {
    const Coverage& coverage = burst.packet.coverage;
    std::uint32_t* const stored = passage::stored_codes(*surface_, *draw_, coverage);
    const passage::Tested tested = passage::z_test<TileSize>(triangle_, burst, *draw_, stored, codes_);
    passage::sink<TileSize>(coverage.mask, tested, coverage.tile_x, coverage.tile_y, triangle_.triangle,
                            *draw_, *surface_);
    if (config_.interpolator.enabled) {
      const std::uint64_t live = passage::interpolator<TileSize>(burst, tested, *draw_);
      if (wants_live_) {
        stream_->live(live);
      }
    }
    if (touches_depth_) {
      const int parts = config_.z_cache.parts;
      if (config_.hi_z.enabled) {
        update_ =
            passage::hi_z_update<TileSize>(*draw_, triangle_.depth, stored,
                                           passage::touched_parts<TileSize>(coverage, *draw_, parts), parts);
      }
      passage::write_late<TileSize>(tested, codes_, *draw_, stored);
      look_up(coverage, tested);
    }
    if (draw_->record_quads) {
      show_quads(burst, tested);
    }
    quads_.count_burst();
    return burst.quads;
  }

  void look_up(const Coverage& coverage, const passage::Tested& tested) {
    const ZSurface& place = places_[draw_->surface];
    const ZAccess access = passage::z_access<TileSize>(
        coverage, tested, surface_->codes.tile(coverage.tile_x, coverage.tile_y), *draw_, place, config_);
    const ZMisses misses = passage::z_cache(z_cache_, place, coverage, access, *draw_);
    if (stream_) {
      stream_->late(misses.late_done, access.late_write);
      stream_->accessed(misses.parts());
      if (stream_->wants_accesses()) {
        constexpr int kBands = stream_bands(TileSize);
        stream_->access(
            {coverage.tile_x, coverage.tile_y, passage::touched_parts<TileSize>(coverage, *draw_, kBands),
             passage::written_parts<TileSize>(tested.kept, *draw_, kBands),
             sure_parts<TileSize>(coverage, kBands), access.shifts, access.late, access.late_write});
      }
    }
  }

  void show_quads(const Burst& burst, const passage::Tested& tested) {
    passage::show_quads<TileSize>(burst.packet, tested, codes_.data(), triangle_, *draw_,
                                  [this](const QuadEvent& quad, std::size_t number) {
                                    if (wants_cycles_) {
                                      quads_.add(quad, number);
                                    } else {
                                      observer_->quad(quad);
                                    }
                                  });
  }

  void give(bool in_triangle) {
    stream_->give(in_triangle, wants_cycles_ ? &burst_cycles_ : nullptr);
    if (wants_cycles_) {
      quads_.show(burst_cycles_);
      burst_cycles_.clear();
    }
  }

  void flush() {
    std::vector<ZFlush> lines;
    z_cache_.flush([&](std::uint32_t slot, std::uint32_t /*line*/, std::uint32_t bytes) {
      lines.push_back({.slot = slot, .bytes = bytes});
      ++result_.flushed_lines;
      result_.flushed_bytes += bytes;
    });
    if (stream_) {
      give(false);
      reader_->end(lines);
    }
  }

  const Frame& frame_;
  const Config& config_;
  PacketObserver* observer_;
  StreamReader* reader_;
  FrameResult result_;
  std::vector<ZSurface> places_;  ///< by surface
  std::deque<DrawContext> draws_;
  WalkerConfig walk_;
  passage::BlockWalker walker_;
  ZCache z_cache_;
  std::vector<HiZSurface> blocks_;  ///< by surface
  HiZ hi_z_;

  std::optional<StreamWriter> stream_;  ///< where somebody reads
  bool wants_tiles_ = false;
  bool wants_live_ = false;
  bool wants_cycles_ = false;
  QuadQueue quads_;
  std::vector<std::uint64_t> burst_cycles_;

  // Of the draw at work.
  DrawContext* draw_ = nullptr;
  Surface* surface_ = nullptr;
  bool touches_depth_ = false;
  SetupTriangle triangle_;
  HiZUpdate update_;  ///< of the job at work
  TileCodes<TileSize> codes_{};
};

}  // namespace

bool shows_cycles(const Watch& watch, const StreamReader& reader) {
  return reader.has_time() && watch.observer != nullptr && watch.observer->wants_quads();
}

FrameResult run_in_order(const Frame& frame, const Config& config, const Watch& watch, StreamReader* reader) {
  return with_tile_size(config.tile_walker.tile_size,
                        [&](auto size) { return InOrderRun<size()>(frame, config, watch, reader).run(); });
}

}  // namespace halfspace
