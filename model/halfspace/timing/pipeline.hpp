/// A frame through the units, one packet after the other. Fidelities that take the packets in this order are
/// this traversal with a clock.
///
/// A Clock is told what passes; it may keep time, record, or do nothing (NoClock):
///
///     void start(std::uint32_t lines)      the lines of memory that all surfaces take
///     void draw(std::uint32_t index)       the triangles that follow are of this draw, or of no draw
///     void dropped()                       setup dropped a triangle
///     void drawn()                         setup gave a triangle to the walker, whose tile jobs follow
///     void job(const JobWork&)             a tile job, all the way through early_z
///     void walked(std::uint32_t steps)     the triangle is done, with so many steps after its last job
///     std::uint64_t quad_cycle(int quad)   when quad number `quad` of the last job leaves early_z
///     void fast_clear(std::uint32_t tiles) a clear by the z cache
///     void flush(const std::vector<ZFlush>&)  the end of the frame
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "halfspace/scene/front_end.hpp"
#include "halfspace/timing/draw_state.hpp"
#include "halfspace/timing/frame_result.hpp"
#include "halfspace/timing/tally.hpp"
#include "halfspace/units/early_z.hpp"
#include "halfspace/units/edge_evaluator.hpp"
#include "halfspace/units/quad_generator.hpp"
#include "halfspace/units/setup.hpp"
#include "halfspace/units/z_cache.hpp"

namespace halfspace {

/// Draw number of what belongs to no draw: clears that are drawn.
inline constexpr std::uint32_t kNoDraw = 0xFFFFFFFFu;

/// What a tile job costs.
struct JobWork {
  std::uint32_t steps = 0;   ///< of the walker, since the job before, its own included
  int quads = 0;             ///< 0: no sample is covered, and nothing leaves the quad generator
  std::uint32_t tile_x = 0;  ///< in tiles, where touched is not 0
  std::uint32_t tile_y = 0;
  std::uint8_t touched = 0;         ///< bit i: part i of the tile has to do with stored depth
  std::uint8_t written = 0;         ///< bit i: some fragment wrote to part i
  std::span<const ZMiss> misses{};  ///< the touched parts that the z cache did not have
};

/// A dirty line at the end of the frame.
struct ZFlush {
  std::uint32_t slot = 0;
  std::uint32_t bytes = 0;
};

struct NoClock {
  void start(std::uint32_t /*memory_lines*/) {}
  void draw(std::uint32_t /*index*/) {}
  void dropped() {}
  void drawn() {}
  void job(const JobWork& /*work*/) {}
  void walked(std::uint32_t /*steps*/) {}
  [[nodiscard]] std::uint64_t quad_cycle(int /*quad*/) const { return 0; }
  void fast_clear(std::uint32_t /*tiles*/) {}
  void flush(const std::vector<ZFlush>& /*lines*/) {}
};

/// The units of one machine, working on one draw at a time. `config` and `clock` must outlive it.
template <int TileSize, class Clock>
class Pipeline {
 public:
  Pipeline(const Frame& frame, const Config& config, bool keep_visible, PacketObserver* observer,
           Clock& clock)
      : frame_(frame), config_(config), walker_(walker_config(config)), clock_(clock), observer_(observer) {
    result_.surfaces = make_surfaces(frame, TileSize, keep_visible);
    places_ = place_surfaces(result_.surfaces, config);
    const ZCacheShape shape = z_cache_shape(config);
    z_cache_ = ZCache(shape, memory_lines(places_, shape));
    clock.start(memory_lines(places_, shape));
    find_written_surfaces();
  }

  FrameResult run() {
    const auto draw_count = static_cast<std::size_t>(
        std::count_if(frame_.commands.begin(), frame_.commands.end(),
                      [](const Command& command) { return command.kind == CommandKind::kDraw; }));
    for (std::uint32_t i = 0; i < frame_.commands.size(); ++i) {
      const Command& command = frame_.commands[i];
      if (command.kind == CommandKind::kClear) {
        clear(command);
        continue;
      }
      draw(command, i);
      if (observer_ != nullptr) {
        observer_->draw_done(result_.draws.size(), draw_count);
      }
    }
    flush();
    return std::move(result_);
  }

  // What TileWalker calls.

  void decision(int x, int y, int size, TileVerdict verdict) {
    ++steps_;
    tally(stats_->tile_walker, verdict, size != TileSize);
    if (record_decisions_) {
      observer_->decision({.draw = draw_index_,
                           .triangle = triangle_.triangle,
                           .surface = surface_number_,
                           .x = static_cast<std::uint32_t>(x),
                           .y = static_cast<std::uint32_t>(y),
                           .size = static_cast<std::uint32_t>(size),
                           .verdict = verdict});
    }
  }

  void tile(const TileJob& job, TileWork work) {
    steps_ += work == TileWork::kWholeByBlock ? 1 : 0;  // no decision came before it
    emitted_ = true;
    if (record_jobs_) {
      observer_->tile_job(job);
    }
    const Coverage coverage = edge_evaluator<TileSize>(job, config_.raster.sub_pixel_bits);
    const bool covered = any(coverage.mask);
    tally(*stats_, job, work, covered);
    if (covered) {
      quads(quad_generator<TileSize>(coverage));
    } else {
      clock_.job({.steps = steps_});
    }
    steps_ = 0;
  }

 private:
  void find_written_surfaces() {
    depth_written_.resize(result_.surfaces.size());
    for (const Command& command : frame_.commands) {
      const std::uint32_t surface = frame_.targets[command.target].depth_surface;
      if (command.kind == CommandKind::kDraw && command.has(Flag::kDepthWrite) && surface != kNoSurface) {
        depth_written_[surface] = true;
      }
    }
  }

  void clear(const Command& command) {
    const Target& target = frame_.targets[command.target];
    if (!command.has(Flag::kClearDepth) || target.depth_surface == kNoSurface) {
      return;
    }
    ++result_.clears;
    Surface& surface = result_.surfaces[target.depth_surface];
    const PixelRect rect = drawable_rect(command.scissor, target);
    const std::uint32_t code = clear_code(surface.format, command.clear_depth);
    if (!surface.visible.empty()) {
      surface.visible.fill(rect, kNothingVisible);
    }
    if (clears_fast(rect, surface, config_)) {
      surface.codes.fill(rect, code);
      z_cache_.clear(places_[target.depth_surface]);
      clock_.fast_clear(places_[target.depth_surface].tiles);
    } else if (!rect.empty()) {
      draw_clear(drawn_clear(rect, code, surface.format, config_), target.depth_surface);
    }
  }

  /// Of a clear nothing is recorded and no pixel counted: only depth and cycles are changed by it.
  void draw_clear(const DrawnClear& clear, std::uint32_t surface) {
    use_surface(surface);
    stats_ = &result_.drawn_clears;
    early_z_ = clear.early_z;
    counts_pixels_ = false;
    keeps_visible_ = false;
    record_quads_ = record_decisions_ = record_jobs_ = false;
    clock_.draw(kNoDraw);
    for (const ScreenTriangle& triangle : clear.triangle) {
      set_up(triangle, clear.setup);
    }
  }

  void use_surface(std::uint32_t number) {
    surface_number_ = number;
    surface_ = number == kNoSurface ? nullptr : &result_.surfaces[number];
  }

  void draw(const Command& command, std::uint32_t command_index) {
    const Target& target = frame_.targets[command.target];
    draw_index_ = static_cast<std::uint32_t>(result_.draws.size());
    DrawStats draw{.command = command_index, .surface = target.depth_surface, .counters = {}};
    stats_ = &draw.counters;
    use_surface(target.depth_surface);
    const DepthFormat format = surface_ == nullptr ? DepthFormat::kNone : surface_->format;
    early_z_ = early_z_state(command, format, config_);
    counts_pixels_ = surface_ != nullptr;
    keeps_visible_ = surface_ != nullptr && !surface_->visible.empty() &&
                     (early_z_.write || !depth_written_[surface_number_]);
    record_quads_ = observer_ != nullptr && observer_->wants_quads();
    record_decisions_ = observer_ != nullptr && observer_->wants_decisions();
    record_jobs_ = observer_ != nullptr && observer_->wants_tile_jobs();
    clock_.draw(draw_index_);
    if (command.has(Flag::kNotFilled)) {
      ++result_.draws_not_filled;
    } else {
      draw_triangles(FrontEnd(frame_, command, format, config_.raster.sub_pixel_bits),
                     command.index_count / 3, setup_state(command, target, format, config_));
    }
    first_triangle_ += command.index_count / 3;
    result_.counters += draw.counters;
    if (surface_ != nullptr) {
      surface_->counters += draw.counters;
    }
    result_.draws.push_back(draw);
  }

  void draw_triangles(const FrontEnd& front_end, std::uint32_t count, const SetupState& state) {
    for (std::uint32_t first = 0; first < count; first += kFrontEndBatch) {
      batch_.clear();
      for (std::uint32_t i = first; i < count && i - first < kFrontEndBatch; ++i) {
        front_end.process(i, batch_, stats_->front_end);
      }
      for (const ScreenTriangle& triangle : batch_) {
        set_up(triangle, state);
      }
    }
  }

  void set_up(const ScreenTriangle& triangle, const SetupState& state) {
    const SetupVerdict verdict = setup(triangle, state, triangle_);
    tally(stats_->setup, verdict);
    if (verdict != SetupVerdict::kDrawn) {
      clock_.dropped();
      return;
    }
    clock_.drawn();
    steps_ = 0;
    emitted_ = false;
    tile_walker<TileSize>(triangle_, walker_, slot_, *this);
    slot_ = static_cast<std::uint8_t>(slot_ + (emitted_ ? 1 : 0));
    clock_.walked(steps_);
  }

  void quads(const QuadBurst& burst) {
    const TileMask& mask = burst.coverage.mask;
    const auto fragments = static_cast<std::uint64_t>(popcount(mask));
    const int quad_count = popcount(burst.quads);
    tally<TileSize>(stats_->quad_generator, burst, static_cast<std::uint64_t>(quad_count), fragments);
    const TileMask passed = test(burst, fragments);
    time(burst, passed, quad_count);
    if (record_quads_) {
      record_quads(burst, passed);
    }
  }

  TileMask test(const QuadBurst& burst, std::uint64_t fragments) {
    const int tile_x = burst.coverage.tile_x;
    const int tile_y = burst.coverage.tile_y;
    std::uint32_t* stored = surface_ == nullptr ? nullptr : surface_->codes.tile(tile_x, tile_y);
    const TileMask passed = early_z<TileSize>(triangle_, burst, early_z_, stored, codes_);
    tally(stats_->early_z, early_z_, fragments, static_cast<std::uint64_t>(popcount(passed)));
    if (counts_pixels_) {
      count_samples<TileSize>(burst.coverage.mask, surface_->fragments.tile(tile_x, tile_y));
      count_samples<TileSize>(passed, surface_->survivors.tile(tile_x, tile_y));
      if (keeps_visible_) {
        mark_visible(passed, surface_->visible.tile(tile_x, tile_y));
      }
    }
    return passed;
  }

  /// The z cache, and the clock.
  void time(const QuadBurst& burst, const TileMask& passed, int quad_count) {
    JobWork work{.steps = steps_, .quads = quad_count};
    ZMisses misses;
    if (touches_depth(early_z_)) {
      const ZSurface& place = places_[surface_number_];
      work.tile_x = burst.coverage.tile_x;
      work.tile_y = burst.coverage.tile_y;
      work.touched = parts_of_mask<TileSize>(burst.coverage.mask, config_.z_cache.parts);
      work.written =
          early_z_.write ? parts_of_mask<TileSize>(passed, config_.z_cache.parts) : std::uint8_t{0};
      misses = z_cache_.access(place, work.tile_x, work.tile_y, work.touched, work.written);
      tally(stats_->early_z, std::popcount(work.touched), misses);
      work.misses = misses.parts();
    }
    clock_.job(work);
  }

  void mark_visible(const TileMask& passed, std::uint32_t* visible) {
    for (std::size_t i = 0; i < kMaskWords<TileSize>; ++i) {
      for (std::uint64_t left = passed.word[i]; left != 0; left &= left - 1) {
        visible[i * 64 + static_cast<std::size_t>(std::countr_zero(left))] =
            first_triangle_ + triangle_.triangle;
      }
    }
  }

  void record_quads(const QuadBurst& burst, const TileMask& passed) {
    if (!early_z_.test && surface_ != nullptr) {
      interpolate_tile<TileSize>(triangle_, burst, early_z_, codes_);
    }
    int number = 0;
    for_each_quad<TileSize>(burst, [&](const Quad& quad) {
      QuadEvent event{.draw = draw_index_,
                      .triangle = triangle_.triangle,
                      .surface = surface_number_,
                      .x = static_cast<std::uint32_t>(burst.coverage.tile_x * TileSize + quad.x),
                      .y = static_cast<std::uint32_t>(burst.coverage.tile_y * TileSize + quad.y),
                      .mask = quad.mask,
                      .passed = quad_bits<TileSize>(passed, quad.x, quad.y),
                      .depth = {},
                      .cycle = clock_.quad_cycle(number++)};
      for (int i = 0; surface_ != nullptr && i < 4; ++i) {
        const int sample = (quad.y + i / 2) * TileSize + quad.x + i % 2;
        const bool covered = (quad.mask >> i & 1) != 0;
        event.depth[static_cast<std::size_t>(i)] = covered ? codes_[static_cast<std::size_t>(sample)] : 0;
      }
      observer_->quad(event);
    });
  }

  void flush() {
    std::vector<ZFlush> lines;
    z_cache_.flush([&](std::uint32_t slot, std::uint32_t /*line*/, std::uint32_t bytes) {
      lines.push_back({.slot = slot, .bytes = bytes});
      ++result_.flushed_lines;
      result_.flushed_bytes += bytes;
    });
    clock_.flush(lines);
  }

  /// Triangles that pass from the front end to setup in one go: enough to amortise, few enough to stay in the
  /// processor's cache.
  static constexpr std::uint32_t kFrontEndBatch = 256;

  const Frame& frame_;
  const Config& config_;
  WalkerConfig walker_;
  Clock& clock_;
  PacketObserver* observer_;
  FrameResult result_;
  std::vector<ZSurface> places_;  ///< by surface
  ZCache z_cache_;
  std::vector<bool> depth_written_;  ///< by surface: some draw of the frame writes its depth

  // Of the draw at work.
  Counters* stats_ = nullptr;
  Surface* surface_ = nullptr;  ///< null where the target has no depth
  std::uint32_t surface_number_ = kNoSurface;
  std::uint32_t draw_index_ = 0;
  std::uint32_t first_triangle_ = 0;  ///< triangles of the draws before this one
  EarlyZState early_z_;
  bool counts_pixels_ = false;
  bool keeps_visible_ = false;  ///< its survivors go into Surface::visible
  bool record_quads_ = false;
  bool record_decisions_ = false;
  bool record_jobs_ = false;
  std::vector<ScreenTriangle> batch_;
  SetupTriangle triangle_;
  std::uint32_t steps_ = 0;  ///< of the walker since the last job
  std::uint8_t slot_ = 0;    ///< of the triangle: the next after each that emitted a job
  bool emitted_ = false;     ///< the triangle has a job
  TileCodes<TileSize> codes_{};
};

/// Runs `frame` on the machine of `config` with `clock`.
template <class Clock>
FrameResult run_pipeline(const Frame& frame, const Config& config, bool keep_visible,
                         PacketObserver* observer, Clock& clock) {
  switch (config.tile_walker.tile_size) {
    case 4:
      return Pipeline<4, Clock>(frame, config, keep_visible, observer, clock).run();
    case 16:
      return Pipeline<16, Clock>(frame, config, keep_visible, observer, clock).run();
    default:
      return Pipeline<8, Clock>(frame, config, keep_visible, observer, clock).run();
  }
}

}  // namespace halfspace
