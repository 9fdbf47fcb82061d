#include "halfspace/ledger/fates.hpp"

#include <bit>
#include <utility>

#include "halfspace/ledger/covered.hpp"
#include "halfspace/machine/draw_state.hpp"
#include "halfspace/machine/surfaces.hpp"
#include "halfspace/machine/tile_size.hpp"
#include "halfspace/units/edge_evaluator.hpp"
#include "halfspace/units/quad_generator.hpp"
#include "halfspace/units/tile_walker.hpp"

namespace halfspace::ledger {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFFu;

/// Squares of a grid that the bounds touch.
std::uint64_t squares(const PixelRect& bounds, int size) {
  const std::int64_t columns = bounds.x_last / size - bounds.x_first / size + 1;
  const std::int64_t rows = bounds.y_last / size - bounds.y_first / size + 1;
  return static_cast<std::uint64_t>(columns * rows);
}

/// What the tiles of a block cover.
template <int TileSize>
Covered covered_in(const BlockJob& block, const WalkerConfig& config) {
  struct Sink {
    int sub_pixel_bits;
    Covered found;
    void tile(const TileJob& job, bool /*whole*/) {
      const Coverage coverage = edge_evaluator<TileSize>(job, sub_pixel_bits);
      found.samples += static_cast<std::uint64_t>(popcount<TileSize>(coverage.mask));
      found.quads += static_cast<std::uint64_t>(popcount<TileSize>(quad_generator<TileSize>(coverage).quads));
    }
  };
  Sink sink{.sub_pixel_bits = config.sub_pixel_bits, .found = {}};
  tile_walker<TileSize>(block, config, sink);
  return sink.found;
}

}  // namespace

Fates::Fates(const Frame& frame, const Config& config) : config_(config), draw_(kNone) {
  const std::vector<SurfaceShape> surfaces = surface_shapes(frame);
  for (const Command& command : frame.commands) {
    if (command.kind == CommandKind::kDraw) {
      const std::uint32_t surface = frame.targets[command.target].depth_surface;
      const DepthFormat format = surface == kNoSurface ? DepthFormat::kNone : surfaces[surface].format;
      touches_depth_.push_back(touches_depth(early_z_state(command, format, config)));
    }
  }
  draws_.resize(touches_depth_.size());
}

void Fates::set_up(const SetupEvent& event) {
  end_piece();
  accounts_ = &draws_[event.draw];
  const bool first_piece = event.draw != draw_ || event.triangle != triangle_;
  accounts_->triangles.set_up += first_piece ? 1 : 0;
  draw_ = event.draw;
  triangle_ = event.triangle;
  PieceAccount& pieces = accounts_->pieces;
  ++pieces.all;
  switch (event.verdict) {
    case SetupVerdict::kDrawn:
      begin_piece(*event.drawn);
      break;
    case SetupVerdict::kZeroArea:
      ++pieces.zero_area;
      break;
    case SetupVerdict::kCulled:
      ++pieces.culled;
      break;
    case SetupVerdict::kNoSample:
      ++pieces.no_sample;
      break;
    case SetupVerdict::kOutside:
      ++pieces.outside;
      break;
  }
}

void Fates::begin_piece(const SetupTriangle& triangle) {
  const Covered all = covered(triangle, config_.raster.sub_pixel_bits);
  accounts_->fragments.all += all.samples;
  accounts_->quads.all += all.quads;
  accounts_->blocks.all += squares(triangle.bounds, config_.block_walker.block_size);
  accounts_->tiles.all += squares(triangle.bounds, config_.tile_walker.tile_size);
  in_piece_ = true;
  covered_ = all.samples;
  hidden_ = 0;
  tested_ = 0;
  passed_ = 0;
  kept_ = 0;
}

void Fates::block_walked(const BlockJob& job, std::uint64_t touched) {
  const bool live = job.tiles != 0;
  const auto rejected = static_cast<std::uint64_t>(std::popcount(touched & ~job.tiles));
  ++(live ? accounts_->blocks.live : accounts_->blocks.edges);
  (live ? accounts_->tiles.edges_tile : accounts_->tiles.edges_block) += rejected;
}

void Fates::hi_z_decided(const BlockJob& block, std::uint64_t rejected) {
  if (rejected == 0) {
    return;
  }
  const bool whole = rejected == block.tiles;
  accounts_->blocks.hi_z += whole ? 1 : 0;
  accounts_->blocks.live -= whole ? 1 : 0;
  BlockJob dropped = block;
  dropped.tiles = rejected;
  const Covered found = with_tile_size(config_.tile_walker.tile_size, [&](auto size) {
    return covered_in<size()>(dropped, walker_config(config_));
  });
  const auto add = [&](auto& account, std::uint64_t count) {
    (whole ? account.hi_z_block : account.hi_z_tile) += count;
  };
  add(accounts_->tiles, static_cast<std::uint64_t>(std::popcount(rejected)));
  add(accounts_->quads, found.quads);
  add(accounts_->fragments, found.samples);
  hidden_ += found.samples;
}

void Fates::tile_job(const TileJob& /*job*/) {
  end_tile();
  in_tile_ = true;
}

void Fates::quad(const QuadEvent& quad) {
  const auto samples = static_cast<std::uint64_t>(std::popcount(quad.mask));
  const auto passed = static_cast<std::uint64_t>(std::popcount(quad.passed));
  const auto kept = static_cast<std::uint64_t>(std::popcount(quad.kept));
  SampleAccount& quads = accounts_->quads;
  ++(kept != 0 ? quads.survive : passed != 0 ? quads.late : quads.early_z);
  accounts_->fragments.survive += kept;
  accounts_->fragments.late += passed - kept;
  accounts_->fragments.early_z += samples - passed;
  tested_ += samples;
  passed_ += passed;
  kept_ += kept;
  tile_covered_ = true;
  tile_passes_ |= passed != 0;
  tile_survives_ |= kept != 0;
  const auto size = static_cast<std::uint32_t>(config_.tile_walker.tile_size);
  const auto parts = static_cast<std::uint32_t>(config_.z_cache.parts);
  for (std::uint32_t row = 0; row < 2; ++row) {
    if ((quad.mask >> (2 * row) & 3) != 0) {
      tile_parts_ = static_cast<std::uint8_t>(tile_parts_ | 1u << ((quad.y + row) % size * parts / size));
    }
  }
}

void Fates::end_tile() {
  if (!in_tile_) {
    return;
  }
  TileAccount& tiles = accounts_->tiles;
  ++(!tile_covered_   ? tiles.empty
     : tile_survives_ ? tiles.survive
     : tile_passes_   ? tiles.late
                      : tiles.early_z);
  accounts_->lines.all += touches_depth_[draw_] ? static_cast<std::uint64_t>(std::popcount(tile_parts_)) : 0;
  in_tile_ = false;
  tile_covered_ = false;
  tile_passes_ = false;
  tile_survives_ = false;
  tile_parts_ = 0;
}

void Fates::end_piece() {
  end_tile();
  if (!in_piece_) {
    return;
  }
  in_piece_ = false;
  PieceAccount& pieces = accounts_->pieces;
  ++(covered_ == 0  ? pieces.uncovered
     : kept_ != 0   ? pieces.survive
     : passed_ != 0 ? pieces.late
     : tested_ == 0 ? pieces.hi_z
     : hidden_ == 0 ? pieces.early_z
                    : pieces.hi_z_early_z);
}

std::vector<Accounts> Fates::finish() {
  end_piece();
  return std::move(draws_);
}

}  // namespace halfspace::ledger
