#include "halfspace/whatif/hi_z_study.hpp"

#include <algorithm>
#include <bit>
#include <deque>
#include <optional>

#include "halfspace/machine/draw_state.hpp"
#include "halfspace/machine/frame_source.hpp"
#include "halfspace/machine/passage/block_walker.hpp"
#include "halfspace/machine/passage/edge_evaluator.hpp"
#include "halfspace/machine/passage/quad_generator.hpp"
#include "halfspace/machine/passage/setup.hpp"
#include "halfspace/machine/passage/tile_walker.hpp"
#include "halfspace/machine/passage/z_lookup.hpp"
#include "halfspace/machine/passage/z_test.hpp"
#include "halfspace/machine/surfaces.hpp"
#include "halfspace/machine/tile_size.hpp"
#include "halfspace/units/hi_z.hpp"

namespace halfspace::whatif {
namespace {

/// No code from `codes` passes against anything in `stored`.
bool none_passes(DepthFunc func, const CodeBounds& codes, const CodeBounds& stored) {
  switch (func) {
    case DepthFunc::kNever:
      return true;
    case DepthFunc::kLess:
      return codes.least >= stored.most;
    case DepthFunc::kLequal:
      return codes.least > stored.most;
    case DepthFunc::kEqual:
      return codes.least > stored.most || codes.most < stored.least;
    case DepthFunc::kGreater:
      return codes.most <= stored.least;
    case DepthFunc::kGequal:
      return codes.most < stored.least;
    case DepthFunc::kNotEqual:
    case DepthFunc::kAlways:
      return false;
  }
  return false;
}

template <int TileSize>
class Study {
 public:
  Study(const Frame& frame, const Config& config, const std::vector<HiZChoice>& choices)
      : frame_(frame), config_(config), walk_(walker_config(config)), walker_(walk_) {
    result_.surfaces = make_surfaces(frame, config, Watch{});
    places_ = place_blocks(result_.surfaces, config);
    for (const HiZChoice& choice : choices) {
      Config machine = config;
      machine.hi_z.bits = choice.bits;
      machine.hi_z.lag = choice.lag;
      units_.push_back(make_hi_z(places_, machine));
    }
    rejected_.resize(units_.size());
    kills_.choices.resize(units_.size());
  }

  HiZKills run() {
    FrameSource source(frame_, config_, nullptr, result_.surfaces, result_, draws_);
    for (std::uint32_t i = 0; i < frame_.commands.size(); ++i) {
      draw_ = source.begin(i);
      surface_ =
          draw_ == nullptr || draw_->surface == kNoSurface ? nullptr : &result_.surfaces[draw_->surface];
      while (const std::optional<SourceItem> item = source.next()) {
        if (item->draw == nullptr) {
          clear(item->surface, item->code);
          continue;
        }
        for (const ScreenTriangle& triangle : item->triangles) {
          if (passage::setup(triangle, *draw_, triangle_)) {
            walker_.walk<TileSize>(triangle_, *draw_,
                                   [this](const BlockJob& job, std::uint32_t /*empty*/) { block(job); });
          }
        }
      }
    }
    return std::move(kills_);
  }

 private:
  void clear(std::uint32_t surface, std::uint32_t code) {
    clear_surface(result_.surfaces[surface], code);
    for (HiZ& unit : units_) {
      unit.clear(places_[surface], code);
    }
  }

  [[nodiscard]] HiZSurface place() const {
    return draw_->surface == kNoSurface ? HiZSurface{} : places_[draw_->surface];
  }

  void block(const BlockJob& block) {
    for (std::size_t i = 0; i < units_.size(); ++i) {
      rejected_[i] = units_[i].decide(block, triangle_.depth, draw_->early_z, place()).rejected;
    }
    std::uint64_t left = block.tiles;
    passage::tile_walker<TileSize>(block, walk_, *draw_, [&](const TileJob& job, bool whole) {
      const int number = std::countr_zero(left);
      left &= left - 1;
      tile(block, number, passage::edge_evaluator<TileSize>(job, whole, *draw_));
    });
  }

  void tile(const BlockJob& block, int number, const Coverage& coverage) {
    HiZUpdate update;
    bool dead = false;
    if (any(coverage.mask)) {
      std::uint32_t* const stored =
          surface_ == nullptr ? nullptr : surface_->codes.tile(coverage.tile_x, coverage.tile_y);
      const CodeBounds before = draw_->early_z.test ? bounds(stored) : CodeBounds{};
      const Burst burst = passage::quad_generator<TileSize>(coverage, *draw_);
      const passage::Tested tested = passage::z_test<TileSize>(triangle_, burst, *draw_, stored, codes_);
      if (draw_->early_z.test) {
        dead = !any(tested.passed);
        count(block, number, coverage, before, dead);
      }
      if (touches_depth(draw_->early_z)) {
        const int parts = config_.z_cache.parts;
        update =
            passage::hi_z_update<TileSize>(*draw_, triangle_.depth, stored,
                                           passage::touched_parts<TileSize>(coverage, *draw_, parts), parts);
        passage::write_late<TileSize>(tested, codes_, *draw_, stored);
      }
    }
    for (std::size_t i = 0; i < units_.size(); ++i) {
      if ((rejected_[i] >> number & 1) == 0) {
        units_[i].retire(update);
      } else {
        kills_.choices[i] += dead ? 1 : 0;
      }
    }
  }

  void count(const BlockJob& block, int tile, const Coverage& coverage, const CodeBounds& before, bool dead) {
    ++kills_.bursts;
    if (!dead) {
      return;
    }
    ++kills_.dead;
    CodeBounds burst{.least = ~0u, .most = 0};
    for (std::size_t bit = 0; bit < codes_.size(); ++bit) {
      if ((coverage.mask.word[bit / 64] >> (bit % 64) & 1) != 0) {
        burst = unite(burst, {.least = codes_[bit], .most = codes_[bit]});
      }
    }
    const DepthFunc func = draw_->early_z.func;
    kills_.oracle_samples += none_passes(func, burst, before) ? 1 : 0;
    const HiZOutcome outcome =
        hi_z_outcome(hi_z_config(config_), block, tile, triangle_.depth, draw_->early_z, {.bounds = before});
    kills_.oracle_plane += outcome == HiZOutcome::kNonePasses ? 1 : 0;
  }

  static CodeBounds bounds(const std::uint32_t* stored) {
    const auto [least, most] = std::minmax_element(stored, stored + TileSize * TileSize);
    return {.least = *least, .most = *most};
  }

  const Frame& frame_;
  const Config& config_;
  FrameResult result_;
  std::vector<HiZSurface> places_;
  std::deque<DrawContext> draws_;
  WalkerConfig walk_;
  passage::BlockWalker walker_;
  std::vector<HiZ> units_;
  std::vector<std::uint64_t> rejected_;  ///< of the block at work, by unit
  HiZKills kills_;

  // Of the draw at work.
  DrawContext* draw_ = nullptr;
  Surface* surface_ = nullptr;
  SetupTriangle triangle_;
  TileCodes<TileSize> codes_{};
};

}  // namespace

HiZKills count_hi_z_kills(const Frame& frame, const Config& config, const std::vector<HiZChoice>& choices) {
  Config machine = config;
  machine.hi_z.enabled = true;
  validate(machine);
  return with_tile_size(machine.tile_walker.tile_size,
                        [&](auto size) { return Study<size()>(frame, machine, choices).run(); });
}

}  // namespace halfspace::whatif
