#include "halfspace/whatif/hi_z_study.hpp"

#include <algorithm>
#include <bit>
#include <memory>
#include <stdexcept>

#include "halfspace/machine/passage/edge_evaluator.hpp"
#include "halfspace/machine/passage/tile_walker.hpp"
#include "halfspace/machine/passage/z_lookup.hpp"
#include "halfspace/machine/surfaces.hpp"
#include "halfspace/machine/tile_size.hpp"
#include "halfspace/units/hi_z.hpp"
#include "halfspace/whatif/frame_walk.hpp"
#include "halfspace/whatif/hi_z_in_time.hpp"

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

/// A choice at work: hi_z alone, or with the recurrence.
struct Unit {
  HiZ hi_z;
  std::unique_ptr<HiZInTime> timed;
  HiZ::Verdict verdict;  ///< of the block at work
};

template <int TileSize>
class Study {
 public:
  Study(const Frame& frame, const Config& config, const std::vector<HiZChoice>& choices)
      : frame_(frame), config_(config), walk_(walker_config(config)) {
    result_.surfaces = make_surfaces(frame, config, Watch{});
    blocks_ = place_blocks(result_.surfaces, config);
    places_ = place_surfaces(result_.surfaces, config);
    for (const HiZChoice& choice : choices) {
      Unit& unit = units_.emplace_back();
      if (choice.timed || !choice.lag) {
        unit.timed = std::make_unique<HiZInTime>(config, choice.bits, choice.lag, blocks_, places_);
      } else {
        Config machine = config;
        machine.hi_z.bits = choice.bits;
        machine.hi_z.lag = *choice.lag;
        unit.hi_z = make_hi_z(blocks_, machine);
      }
    }
    kills_.choices.resize(units_.size());
  }

  HiZKills run() {
    walk_frame<TileSize>(frame_, config_, result_, at_, *this);
    for (Unit& unit : units_) {
      kills_.cycles.push_back(unit.timed ? unit.timed->finish() : 0);
    }
    return std::move(kills_);
  }

  // See walk_frame().
  void clear(std::uint32_t surface, std::uint32_t code) {
    for (Unit& unit : units_) {
      if (unit.timed) {
        unit.timed->clear(places_[surface], blocks_[surface], code);
      } else {
        unit.hi_z.clear(blocks_[surface], code);
      }
    }
  }

  void dropped() {
    each_timed([](HiZInTime& timed) { timed.dropped(); });
  }
  void drawn() {
    each_timed([](HiZInTime& timed) { timed.drawn(); });
  }
  void walked(std::uint32_t empty_after) {
    each_timed([&](HiZInTime& timed) { timed.walked(empty_after); });
  }

  void block(const BlockJob& block, std::uint32_t empty_before) {
    const DrawContext& draw = *at_.draw;
    const HiZSurface place = draw.surface == kNoSurface ? HiZSurface{} : blocks_[draw.surface];
    for (Unit& unit : units_) {
      unit.verdict = unit.timed
                         ? unit.timed->block(block, empty_before, at_.triangle.depth, draw.early_z, place)
                         : unit.hi_z.decide(block, at_.triangle.depth, draw.early_z, place);
    }
    std::uint64_t left = block.tiles;
    passage::tile_walker<TileSize>(block, walk_, *at_.draw, [&](const TileJob& job, bool whole) {
      const int number = std::countr_zero(left);
      left &= left - 1;
      tile(block, number, passage::edge_evaluator<TileSize>(job, whole, *at_.draw));
    });
    for (Unit& unit : units_) {
      if (unit.timed && unit.verdict.rejected != block.tiles) {
        unit.timed->block_done();
      }
    }
  }

 private:
  template <class Act>
  void each_timed(const Act& act) {
    for (Unit& unit : units_) {
      if (unit.timed) {
        act(*unit.timed);
      }
    }
  }

  void tile(const BlockJob& block, int number, const Coverage& coverage) {
    const bool tests = any(coverage.mask) && at_.draw->early_z.test;
    const CodeBounds before = tests ? bounds(at_.stored(coverage)) : CodeBounds{};
    const WalkedTile done = draw_tile<TileSize>(at_, coverage, config_, codes_);
    const bool dead = tests && !any(done.tested.passed);
    if (tests) {
      count(block, number, coverage, before, dead);
    }
    for (std::size_t i = 0; i < units_.size(); ++i) {
      Unit& unit = units_[i];
      if ((unit.verdict.rejected >> number & 1) != 0) {
        if (done.quads != 0 && !dead) {
          throw std::logic_error("hi_z: a tile was rejected in which a sample passes");
        }
        kills_.choices[i] += dead ? 1 : 0;
      } else if (unit.timed) {
        go_on(*unit.timed, (unit.verdict.sure >> number & 1) != 0, coverage, done);
      } else {
        unit.hi_z.retire(done.update);
      }
    }
  }

  /// `sure`: hi_z knew that every sample passes.
  void go_on(HiZInTime& timed, bool sure, Coverage coverage, const WalkedTile& done) const {
    coverage.sure = sure ? 1 : 0;
    const ZSurface* const place = done.touches ? &places_[at_.draw->surface] : nullptr;
    const ZAccess access = done.touches
                               ? passage::z_access<TileSize>(coverage, done.tested, at_.stored(coverage),
                                                             *at_.draw, *place, config_)
                               : ZAccess{};
    timed.job(done.quads, coverage, place, access, done.update);
  }

  void count(const BlockJob& block, int tile, const Coverage& coverage, const CodeBounds& before, bool dead) {
    ++kills_.bursts;
    if (!dead) {
      return;
    }
    ++kills_.dead;
    if (at_.draw->early_z.unrestricted) {
      return;  // hi_z does not look at it
    }
    CodeBounds burst{.least = ~0u, .most = 0};
    for (std::size_t bit = 0; bit < codes_.size(); ++bit) {
      if ((coverage.mask.word[bit / 64] >> (bit % 64) & 1) != 0) {
        burst = unite(burst, {.least = codes_[bit], .most = codes_[bit]});
      }
    }
    const DepthFunc func = at_.draw->early_z.func;
    kills_.oracle_samples += none_passes(func, burst, before) ? 1 : 0;
    const HiZOutcome outcome = hi_z_outcome(hi_z_config(config_), block, tile, at_.triangle.depth,
                                            at_.draw->early_z, {.bounds = before});
    kills_.oracle_plane += outcome == HiZOutcome::kNonePasses ? 1 : 0;
  }

  static CodeBounds bounds(const std::uint32_t* stored) {
    const auto [least, most] = std::minmax_element(stored, stored + TileSize * TileSize);
    return {.least = *least, .most = *most};
  }

  const Frame& frame_;
  const Config& config_;
  FrameResult result_;
  std::vector<HiZSurface> blocks_;  ///< by surface
  std::vector<ZSurface> places_;
  WalkerConfig walk_;
  WalkedDraw at_;
  std::vector<Unit> units_;
  HiZKills kills_;
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
