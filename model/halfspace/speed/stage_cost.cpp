#include "halfspace/speed/stage_cost.hpp"

#include <array>
#include <chrono>
#include <deque>
#include <optional>
#include <span>

#include "halfspace/core/functional.hpp"
#include "halfspace/machine/draw_state.hpp"
#include "halfspace/machine/frame_source.hpp"
#include "halfspace/machine/passage/block_walker.hpp"
#include "halfspace/machine/passage/edge_evaluator.hpp"
#include "halfspace/machine/passage/quad_generator.hpp"
#include "halfspace/machine/passage/setup.hpp"
#include "halfspace/machine/passage/sink.hpp"
#include "halfspace/machine/passage/tile_walker.hpp"
#include "halfspace/machine/passage/z_lookup.hpp"
#include "halfspace/machine/passage/z_test.hpp"
#include "halfspace/machine/surfaces.hpp"
#include "halfspace/machine/tile_size.hpp"
#include "halfspace/units/z_cache.hpp"

namespace halfspace {
namespace {

/// The last stage of a prefix.
enum class Last : std::size_t {
  kSurfaces,
  kFrontEnd,
  kSetup,
  kBlockWalker,
  kTileWalker,
  kEdgeEvaluator,
  kQuadGenerator,
  kZTest,
  kPixelCounts,
  kZCache
};
constexpr std::size_t kPrefixes = static_cast<std::size_t>(Last::kZCache) + 1;

/// The compiler must compute `packet`, and put it in memory.
template <class Packet>
void drop(const Packet& packet) {
  asm volatile("" : : "r"(&packet) : "memory");
}

/// run_in_order() without observers and streams, up to a stage.
template <int TileSize, Last kLast>
class PrefixRun {
 public:
  PrefixRun(const Frame& frame, const Config& config)
      : frame_(frame), config_(config), walk_(walker_config(config)), walker_(walk_) {
    result_.surfaces = make_surfaces(frame, config, Watch{});
    places_ = place_surfaces(result_.surfaces, config);
    const ZCacheShape shape = z_cache_shape(config);
    z_cache_ = ZCache(shape, memory_lines(places_, shape));
  }

  Counters run() {
    FrameSource source(frame_, config_, nullptr, result_.surfaces, result_, draws_);
    for (std::uint32_t i = 0; i < frame_.commands.size(); ++i) {
      draw_ = source.begin(i);
      if (draw_ != nullptr && kLast < Last::kFrontEnd) {
        continue;
      }
      surface_ = draw_ == nullptr ? nullptr : &result_.surfaces[draw_->drawn_on];
      while (const std::optional<SourceItem> item = source.next()) {
        if (item->draw == nullptr) {
          clear_surface(result_.surfaces[item->surface], item->code);
          z_cache_.clear(places_[item->surface]);
        } else {
          set_up(item->triangles);
        }
      }
    }
    collect_draws(draws_, result_);
    return result_.counters;
  }

 private:
  void set_up(std::span<const ScreenTriangle> triangles) {
    if constexpr (kLast < Last::kSetup) {
      return drop(triangles);
    } else {
      for (const ScreenTriangle& triangle : triangles) {
        if (!passage::setup(triangle, *draw_, triangle_)) {
          continue;
        }
        if constexpr (kLast < Last::kBlockWalker) {
          drop(triangle_);
        } else {
          walker_.walk<TileSize>(triangle_, *draw_, [this](const BlockJob& block, std::uint32_t /*empty*/) {
            this->block(block);
          });
        }
      }
    }
  }

  void block(const BlockJob& block) {
    if constexpr (kLast < Last::kTileWalker) {
      drop(block);
    } else {
      passage::tile_walker<TileSize>(block, walk_, *draw_,
                                     [this](const TileJob& job, bool whole) { this->job(job, whole); });
    }
  }

  void job(const TileJob& job, bool whole) {
    if constexpr (kLast < Last::kEdgeEvaluator) {
      return drop(job);
    } else {
      const Coverage coverage = passage::edge_evaluator<TileSize>(job, whole, *draw_);
      if constexpr (kLast < Last::kQuadGenerator) {
        return drop(coverage);
      } else if (any(coverage.mask)) {
        burst(passage::quad_generator<TileSize>(coverage, *draw_));
      }
    }
  }

  void burst(const Burst& burst) {
    if constexpr (kLast < Last::kZTest) {
      return drop(burst);
    } else {
      const Coverage& coverage = burst.packet.coverage;
      std::uint32_t* const stored = passage::stored_codes(*surface_, *draw_, coverage);
      const passage::Tested tested = passage::z_test<TileSize>(triangle_, burst, *draw_, stored, codes_);
      passage::write_late<TileSize>(tested, codes_, *draw_, stored);
      if constexpr (kLast < Last::kPixelCounts) {
        return drop(tested);
      }
      passage::sink<TileSize>(coverage.mask, tested, coverage.tile_x, coverage.tile_y, triangle_.triangle,
                              *draw_, *surface_);
      if (kLast >= Last::kZCache && touches_depth(draw_->early_z)) {
        const ZSurface& place = places_[draw_->surface];
        drop(passage::z_cache(z_cache_, place, coverage,
                              passage::z_access<TileSize>(coverage, tested, stored, *draw_, place, config_),
                              *draw_));
      }
    }
  }

  const Frame& frame_;
  const Config& config_;
  FrameResult result_;
  std::vector<ZSurface> places_;
  std::deque<DrawContext> draws_;
  WalkerConfig walk_;
  passage::BlockWalker walker_;
  ZCache z_cache_;

  // Of the draw at work.
  DrawContext* draw_ = nullptr;
  Surface* surface_ = nullptr;
  SetupTriangle triangle_;
  TileCodes<TileSize> codes_{};
};

template <Last kLast>
Counters run_prefix(const Frame& frame, const Config& config) {
  return with_tile_size(config.tile_walker.tile_size,
                        [&](auto size) { return PrefixRun<size(), kLast>(frame, config).run(); });
}

constexpr std::array<Counters (*)(const Frame&, const Config&), kPrefixes> kRunPrefix{
    run_prefix<Last::kSurfaces>,      run_prefix<Last::kFrontEnd>,   run_prefix<Last::kSetup>,
    run_prefix<Last::kBlockWalker>,   run_prefix<Last::kTileWalker>, run_prefix<Last::kEdgeEvaluator>,
    run_prefix<Last::kQuadGenerator>, run_prefix<Last::kZTest>,      run_prefix<Last::kPixelCounts>,
    run_prefix<Last::kZCache>};

std::vector<StageCost> stages_of(const Frame& frame, const Counters& c) {
  std::uint64_t pixels = 0;
  for (const Target& target : frame.targets) {
    pixels += target.depth_surface == kNoSurface ? 0 : std::uint64_t{target.width} * target.height;
  }
  return {
      {.stage = "surfaces", .item = "pixel", .items = pixels, .milliseconds = {}},
      {.stage = "front_end", .item = "triangle", .items = c.front_end.triangles, .milliseconds = {}},
      {.stage = "setup", .item = "triangle", .items = c.setup.triangles, .milliseconds = {}},
      {.stage = "block_walker", .item = "block", .items = c.block_walker.blocks, .milliseconds = {}},
      {.stage = "tile_walker",
       .item = "job",
       .items = c.tile_walker.tiles_accepted + c.tile_walker.tiles_partial,
       .milliseconds = {}},
      {.stage = "edge_evaluator",
       .item = "job",
       .items = c.edge_evaluator.tiles + c.edge_evaluator.tiles_skipped,
       .milliseconds = {}},
      {.stage = "quad_generator", .item = "burst", .items = c.quad_generator.tiles, .milliseconds = {}},
      {.stage = "z_test", .item = "fragment", .items = c.quad_generator.fragments, .milliseconds = {}},
      {.stage = "pixel_counts", .item = "fragment", .items = c.quad_generator.fragments, .milliseconds = {}},
      {.stage = "z_cache", .item = "burst", .items = c.early_z.z_bursts, .milliseconds = {}}};
}

template <class Action>
double time_of(const Action& action) {
  const auto start = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

StageCosts stage_costs(const Frame& frame, const Config& config, int repeat) {
  StageCosts costs{.stages = stages_of(frame, kRunPrefix.back()(frame, config)), .functional = {}};
  for (int pass = 0; pass <= repeat; ++pass) {
    std::array<double, kPrefixes> times{};
    kRunPrefix.front()(frame, config);  // the shortest must not pay for what the longest left in the caches
    for (std::size_t i = 0; i < kPrefixes; ++i) {
      times[i] = time_of([&] { kRunPrefix[i](frame, config); });
    }
    const double functional = time_of([&] { run_functional(frame, config, {.core = Core::kReadable}); });
    if (pass == 0) {  // warms caches and page tables
      continue;
    }
    costs.functional.push_back(functional);
    for (std::size_t i = 0; i < kPrefixes; ++i) {
      costs.stages[i].milliseconds.push_back(times[i] - (i == 0 ? 0 : times[i - 1]));
    }
  }
  return costs;
}

}  // namespace halfspace
