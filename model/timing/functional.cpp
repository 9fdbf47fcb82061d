#include "halfspace/timing/functional.hpp"

#include <algorithm>

#include "halfspace/scene/front_end.hpp"
#include "halfspace/units/edge_evaluator.hpp"
#include "halfspace/units/quad_generator.hpp"
#include "halfspace/units/setup.hpp"

namespace halfspace {
namespace {

/// Triangles that pass from the front end to setup in one go: enough to amortise, few enough to stay in the
/// cache.
constexpr std::uint32_t kBatch = 256;

/// scissor and target, in pixels.
PixelRect drawable_rect(const Scissor& scissor, const Target& target) {
  const auto last = [](std::int32_t first, std::int32_t extent, std::uint32_t size) {
    return static_cast<std::int32_t>(std::clamp<std::int64_t>(std::int64_t{first} + extent, 0, size)) - 1;
  };
  return {.x_first = std::max(scissor.x, 0),
          .y_first = std::max(scissor.y, 0),
          .x_last = last(scissor.x, scissor.width, target.width),
          .y_last = last(scissor.y, scissor.height, target.height)};
}

/// A draw whose fragments only the shader can judge, so that hardware tests them after it.
bool tests_late(const Command& draw) {
  return !draw.has(Flag::kEarlyTestsForced) &&
         (draw.has(Flag::kShaderDiscards) || draw.has(Flag::kShaderWritesDepth) ||
          draw.has(Flag::kShaderSideEffects) || draw.has(Flag::kAlphaToCoverage));
}

/// Adds 1 where the mask is set, up to the largest value.
template <int TileSize>
void count_samples(const TileMask& mask, std::uint16_t* counts) {
  constexpr std::size_t kBits = std::min(TileSize * TileSize, 64);
  constexpr std::uint64_t kAll = ~std::uint64_t{0} >> (64 - kBits);
  const auto add = [&](std::size_t i) {
    counts[i] = static_cast<std::uint16_t>(counts[i] + (counts[i] != 0xFFFF ? 1 : 0));
  };
  for (std::size_t i = 0; i < kMaskWords<TileSize>; ++i) {
    if (mask.word[i] == kAll) {  // most words: a loop without branches
      for (std::size_t k = 0; k < kBits; ++k) {
        add(i * 64 + k);
      }
      continue;
    }
    for (std::uint64_t left = mask.word[i]; left != 0; left &= left - 1) {
      add(i * 64 + static_cast<std::size_t>(std::countr_zero(left)));
    }
  }
}

/// The units of one machine, working on one draw at a time.
template <int TileSize>
class Pipeline {
 public:
  Pipeline(const Frame& frame, const Config& config, bool keep_visible, PacketObserver* observer)
      : frame_(frame),
        config_(config),
        walker_{.sub_pixel_bits = config.sub_pixel_bits,
                .block_size = config.block_size,
                .block_level = config.block_level,
                .trivial_reject = config.trivial_reject,
                .trivial_accept = config.trivial_accept},
        observer_(observer),
        record_quads_(observer != nullptr && observer->wants_quads()),
        record_decisions_(observer != nullptr && observer->wants_decisions()),
        record_jobs_(observer != nullptr && observer->wants_tile_jobs()) {
    make_surfaces(keep_visible);
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
    return std::move(result_);
  }

  // What TileWalker calls.

  void decision(int x, int y, int size, TileVerdict verdict) {
    TileWalkerCounters& counters = stats_->tile_walker;
    const bool block = size != TileSize;
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
    EdgeEvaluatorCounters& counters = stats_->edge_evaluator;
    stats_->tile_walker.tiles_by_block += work == TileWork::kWholeByBlock ? 1 : 0;
    if (work != TileWork::kEvaluate) {
      ++counters.tiles_skipped;  // every edge is accepted: the evaluator has none to look at
    } else {
      ++counters.tiles;
      const int skipped = std::popcount(job.accept);
      counters.edges_skipped += static_cast<std::uint64_t>(skipped);
      counters.edges += static_cast<std::uint64_t>(3 - skipped);
    }
    if (record_jobs_) {
      observer_->tile_job(job);
    }
    const Coverage coverage = edge_evaluator<TileSize>(job, config_.sub_pixel_bits);
    if (!any(coverage.mask)) {
      ++counters.tiles_empty;
      return;
    }
    quads(quad_generator<TileSize>(coverage));
  }

 private:
  void make_surfaces(bool keep_visible) {
    for (const Target& target : frame_.targets) {
      if (target.depth_surface == kNoSurface) {
        continue;
      }
      if (target.depth_surface >= result_.surfaces.size()) {
        result_.surfaces.resize(target.depth_surface + 1);
      }
      Surface& surface = result_.surfaces[target.depth_surface];
      const int width = std::max(surface.codes.width(), static_cast<int>(target.width));
      const int height = std::max(surface.codes.height(), static_cast<int>(target.height));
      if (width == surface.codes.width() && height == surface.codes.height()) {
        continue;
      }
      surface.format = target.depth_format;
      surface.codes = {width, height, TileSize, clear_code(target.depth_format, 1)};
      surface.fragments = {width, height, TileSize, 0};
      surface.survivors = {width, height, TileSize, 0};
      if (keep_visible) {
        surface.visible = {width, height, TileSize, kNothingVisible};
      }
    }
  }

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
    surface.codes.fill(rect, clear_code(surface.format, command.clear_depth));
    if (!surface.visible.empty()) {
      surface.visible.fill(rect, kNothingVisible);
    }
  }

  void draw(const Command& command, std::uint32_t command_index) {
    const Target& target = frame_.targets[command.target];
    draw_index_ = static_cast<std::uint32_t>(result_.draws.size());
    DrawStats draw{.command = command_index, .surface = target.depth_surface, .counters = {}};
    stats_ = &draw.counters;
    surface_number_ = target.depth_surface;
    surface_ = surface_number_ == kNoSurface ? nullptr : &result_.surfaces[surface_number_];
    const DepthFormat format = surface_ == nullptr ? DepthFormat::kNone : surface_->format;
    const SetupState setup_state{.sub_pixel_bits = config_.sub_pixel_bits,
                                 .front_positive_area = command.has(Flag::kFrontPositiveArea),
                                 .cull_front = command.has(Flag::kCullFront),
                                 .cull_back = command.has(Flag::kCullBack),
                                 .bottom_left_rule = command.has(Flag::kBottomLeftRule),
                                 .bounds = drawable_rect(command.scissor, target),
                                 .depth_format = format,
                                 .interpolator = config_.interpolator};
    const bool test = command.has(Flag::kDepthTest) && surface_ != nullptr;
    early_z_ = {.test = test,
                .write = test && command.has(Flag::kDepthWrite) &&
                         (config_.late_z == LateZ::kOpaque || !tests_late(command)),
                .func = command.depth_func,
                .format = format,
                .interpolator = config_.interpolator,
                .sub_pixel_bits = config_.sub_pixel_bits};

    keeps_visible_ = surface_ != nullptr && !surface_->visible.empty() &&
                     (early_z_.write || !depth_written_[surface_number_]);
    if (command.has(Flag::kNotFilled)) {
      ++result_.draws_not_filled;
    } else {
      draw_triangles(FrontEnd(frame_, command, format, config_.sub_pixel_bits), command.index_count / 3,
                     setup_state);
    }
    first_triangle_ += command.index_count / 3;
    result_.counters += draw.counters;
    if (surface_ != nullptr) {
      surface_->counters += draw.counters;
    }
    result_.draws.push_back(draw);
  }

  void draw_triangles(const FrontEnd& front_end, std::uint32_t count, const SetupState& setup_state) {
    for (std::uint32_t first = 0; first < count; first += kBatch) {
      batch_.clear();
      for (std::uint32_t i = first; i < count && i - first < kBatch; ++i) {
        front_end.process(i, batch_, stats_->front_end);
      }
      for (const ScreenTriangle& triangle : batch_) {
        set_up(triangle, setup_state);
      }
    }
  }

  void set_up(const ScreenTriangle& triangle, const SetupState& state) {
    SetupCounters& counters = stats_->setup;
    ++counters.triangles;
    switch (setup(triangle, state, triangle_)) {
      case SetupVerdict::kZeroArea:
        ++counters.zero_area;
        return;
      case SetupVerdict::kCulled:
        ++counters.culled;
        return;
      case SetupVerdict::kNoSample:
        ++counters.no_sample;
        return;
      case SetupVerdict::kOutside:
        ++counters.outside;
        return;
      case SetupVerdict::kDrawn:
        ++counters.drawn;
        break;
    }
    const auto slot = static_cast<std::uint8_t>(counters.drawn);
    tile_walker<TileSize>(triangle_, walker_, slot, *this);
  }

  void quads(const QuadBurst& burst) {
    const TileMask& mask = burst.coverage.mask;
    const auto fragments = static_cast<std::uint64_t>(popcount(mask));
    const auto quad_count = static_cast<std::uint64_t>(popcount(burst.quads));
    QuadGeneratorCounters& counters = stats_->quad_generator;
    ++counters.tiles;
    counters.fragments += fragments;
    counters.quads += quad_count;
    counters.quads_full += static_cast<std::uint64_t>(popcount(full_quads<TileSize>(burst)));
    counters.quads_empty += TileSize * TileSize / 4 - quad_count;
    counters.helpers += 4 * quad_count - fragments;
    test(burst, fragments);
  }

  void test(const QuadBurst& burst, std::uint64_t fragments) {
    const int tile_x = burst.coverage.tile_x;
    const int tile_y = burst.coverage.tile_y;
    std::uint32_t* stored = surface_ == nullptr ? nullptr : surface_->codes.tile(tile_x, tile_y);
    const TileMask passed = early_z<TileSize>(triangle_, burst, early_z_, stored, codes_);
    const auto survivors = static_cast<std::uint64_t>(popcount(passed));
    EarlyZCounters& counters = stats_->early_z;
    (early_z_.test ? counters.tested : counters.untested) += fragments;
    counters.survivors += survivors;
    counters.written += early_z_.write ? survivors : 0;
    counters.tiles_killed += survivors == 0 ? 1 : 0;
    if (surface_ != nullptr) {
      count_samples<TileSize>(burst.coverage.mask, surface_->fragments.tile(tile_x, tile_y));
      count_samples<TileSize>(passed, surface_->survivors.tile(tile_x, tile_y));
      if (keeps_visible_) {
        mark_visible(passed, surface_->visible.tile(tile_x, tile_y));
      }
    }
    if (record_quads_) {
      record_quads(burst, passed);
    }
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
    for_each_quad<TileSize>(burst, [&](const Quad& quad) {
      QuadEvent event{.draw = draw_index_,
                      .triangle = triangle_.triangle,
                      .surface = surface_number_,
                      .x = static_cast<std::uint32_t>(burst.coverage.tile_x * TileSize + quad.x),
                      .y = static_cast<std::uint32_t>(burst.coverage.tile_y * TileSize + quad.y),
                      .mask = quad.mask,
                      .passed = quad_bits<TileSize>(passed, quad.x, quad.y),
                      .depth = {}};
      for (int i = 0; surface_ != nullptr && i < 4; ++i) {
        const int sample = (quad.y + i / 2) * TileSize + quad.x + i % 2;
        const bool covered = (quad.mask >> i & 1) != 0;
        event.depth[static_cast<std::size_t>(i)] = covered ? codes_[static_cast<std::size_t>(sample)] : 0;
      }
      observer_->quad(event);
    });
  }

  const Frame& frame_;
  const Config& config_;
  WalkerConfig walker_;
  PacketObserver* observer_;
  bool record_quads_;
  bool record_decisions_;
  bool record_jobs_;
  FrameResult result_;
  std::vector<bool> depth_written_;  ///< by surface: some draw of the frame writes its depth

  // Of the draw at work.
  Counters* stats_ = nullptr;
  Surface* surface_ = nullptr;  ///< null where the target has no depth
  std::uint32_t surface_number_ = kNoSurface;
  std::uint32_t draw_index_ = 0;
  std::uint32_t first_triangle_ = 0;  ///< triangles of the draws before this one
  EarlyZState early_z_;
  bool keeps_visible_ = false;  ///< its survivors go into Surface::visible
  std::vector<ScreenTriangle> batch_;
  SetupTriangle triangle_;
  TileCodes<TileSize> codes_{};
};

}  // namespace

FrameResult run_functional(const Frame& frame, const Config& config, bool keep_visible,
                           PacketObserver* observer) {
  switch (config.tile_size) {
    case 4:
      return Pipeline<4>(frame, config, keep_visible, observer).run();
    case 16:
      return Pipeline<16>(frame, config, keep_visible, observer).run();
    default:
      return Pipeline<8>(frame, config, keep_visible, observer).run();
  }
}

}  // namespace halfspace
