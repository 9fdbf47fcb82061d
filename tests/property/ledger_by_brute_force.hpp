/// The accounts of a frame by definition: coverage by exact edge functions, sample by sample; a naive depth
/// buffer; and tiles that are outside an edge because each of their samples is.
#pragma once

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "halfspace/ledger/accounts.hpp"
#include "halfspace/machine/draw_state.hpp"
#include "halfspace/machine/in_order.hpp"
#include "halfspace/machine/surfaces.hpp"
#include "halfspace/reference/exact_triangle.hpp"
#include "halfspace/scene/front_end.hpp"

namespace halfspace::testing {

using ledger::Accounts;
using reference::Int128;

/// An edge by definition, its sign at the centres of pixels.
struct ExactEdge {
  Int128 a = 0;
  Int128 b = 0;
  Int128 c = 0;  ///< at the origin of the window
  int sub_pixel_bits = 8;
  bool owns = false;

  [[nodiscard]] bool inside(int x, int y) const {
    const reference::GridPoint p = reference::pixel_centre(x, y, sub_pixel_bits);
    const Int128 e = a * p.x + b * p.y + c;
    return e > 0 || (e == 0 && owns);
  }
};

inline std::array<ExactEdge, 3> exact_edges(const ScreenTriangle& triangle, int sub_pixel_bits,
                                            reference::TieRule rule) {
  reference::GridTriangle corners;
  for (std::size_t i = 0; i < 3; ++i) {
    corners[i] = {.x = triangle.v[i].x, .y = triangle.v[i].y};
  }
  corners = reference::clockwise(corners);
  std::array<ExactEdge, 3> edges;
  for (std::size_t i = 0; i < 3; ++i) {
    const reference::GridPoint& from = corners[i];
    const reference::GridPoint& to = corners[(i + 1) % 3];
    const Int128 a = from.y - to.y;
    const Int128 b = to.x - from.x;
    edges[i] = {.a = a,
                .b = b,
                .c = -(a * from.x + b * from.y),
                .sub_pixel_bits = sub_pixel_bits,
                .owns = reference::owns_samples(a, b, rule)};
  }
  return edges;
}

using Pixel = std::pair<int, int>;
using Sample = std::tuple<std::uint32_t, std::uint32_t, int, int>;  ///< draw, triangle, x, y

/// Depth codes of all samples that come to early_z, by what covers them.
class Samples final : public PacketObserver {
 public:
  [[nodiscard]] bool wants_quads() const override { return true; }
  void quad(const QuadEvent& quad) override {
    for (int i = 0; i < 4; ++i) {
      if ((quad.mask >> i & 1) != 0) {
        codes[{quad.draw, quad.triangle, static_cast<int>(quad.x) + i % 2,
               static_cast<int>(quad.y) + i / 2}] = quad.depth[static_cast<std::size_t>(i)];
      }
    }
  }
  std::map<Sample, std::uint32_t> codes;
};

/// The tiles of each drawn piece, in order, that come to the edge evaluator.
class Jobs final : public PacketObserver {
 public:
  [[nodiscard]] bool wants_walk() const override { return true; }
  [[nodiscard]] bool wants_tile_jobs() const override { return true; }
  void set_up(const SetupEvent& event) override {
    if (event.verdict == SetupVerdict::kDrawn) {
      pieces.emplace_back();
    }
  }
  void tile_job(const TileJob& job) override { pieces.back().insert({job.tile_x, job.tile_y}); }
  std::vector<std::set<Pixel>> pieces;
};

inline bool passes_by_definition(DepthFunc func, std::uint32_t code, std::uint32_t stored) {
  switch (func) {
    case DepthFunc::kNever:
      return false;
    case DepthFunc::kLess:
      return code < stored;
    case DepthFunc::kEqual:
      return code == stored;
    case DepthFunc::kLequal:
      return code <= stored;
    case DepthFunc::kGreater:
      return code > stored;
    case DepthFunc::kNotEqual:
      return code != stored;
    case DepthFunc::kGequal:
      return code >= stored;
    case DepthFunc::kAlways:
      return true;
  }
  return false;
}

/// The accounts of a frame by brute force. Two things come from runs of the model: which depth a sample has,
/// from one without hi_z; and which tiles were evaluated, from one as configured.
class BruteForce {
 public:
  BruteForce(const Frame& frame, const Config& config) : frame_(frame), config_(config) {
    Config no_hi_z = config;
    no_hi_z.hi_z.enabled = false;
    run_in_order(frame, no_hi_z, {.observer = &samples_}, nullptr);
    run_in_order(frame, config, {.observer = &jobs_}, nullptr);
    for (const SurfaceShape& shape : surface_shapes(frame)) {
      shapes_.push_back(shape);
      depth_.emplace_back(static_cast<std::size_t>(shape.width) * static_cast<std::size_t>(shape.height),
                          largest_code(shape.format));
    }
  }

  std::vector<Accounts> run() {
    for (const Command& command : frame_.commands) {
      command.kind == CommandKind::kDraw ? draw(command) : clear(command);
    }
    REQUIRE(next_piece_ == jobs_.pieces.size());
    return std::move(draws_);
  }

 private:
  std::uint32_t& stored(std::uint32_t surface, int x, int y) {
    return depth_[surface][static_cast<std::size_t>(y) * static_cast<std::size_t>(shapes_[surface].width) +
                           static_cast<std::size_t>(x)];
  }

  void clear(const Command& command) {
    const Target& target = frame_.targets[command.target];
    const std::uint32_t surface = target.depth_surface;
    if (!command.has(Flag::kClearDepth) || surface == kNoSurface) {
      return;
    }
    const PixelRect rect = drawable_rect(command.scissor, target);
    for (int y = rect.y_first; y <= rect.y_last; ++y) {
      for (int x = rect.x_first; x <= rect.x_last; ++x) {
        stored(surface, x, y) = code_of_depth(shapes_[surface].format, command.clear_depth);
      }
    }
  }

  void draw(const Command& command) {
    const Target& target = frame_.targets[command.target];
    surface_ = target.depth_surface;
    const DepthFormat format = surface_ == kNoSurface ? DepthFormat::kNone : shapes_[surface_].format;
    state_ = early_z_state(command, format, config_);
    a_ = &draws_.emplace_back();
    a_->triangles.all = command.index_count / 3;
    if (command.has(Flag::kNotFilled)) {
      a_->triangles.not_filled = a_->triangles.all;
      return;
    }
    const PixelRect on_target = intersect(drawable_rect(command.scissor, target),
                                          viewport_rect(command.viewport, fill_rule(command, config_)));
    const FrontEnd front_end(frame_, command, format, config_.raster.sub_pixel_bits);
    for (std::uint32_t i = 0; i < a_->triangles.all; ++i) {
      std::vector<ScreenTriangle> pieces;
      FrontEndCounters counters;
      front_end.process(i, pieces, counters);
      a_->triangles.non_finite += counters.non_finite;
      a_->triangles.clipped_away += counters.clipped_away;
      a_->triangles.degenerate += counters.degenerate;
      const bool dropped = counters.non_finite + counters.clipped_away + counters.degenerate != 0;
      ++(dropped ? dropped_ : pieces.empty() ? a_->triangles.no_piece : a_->triangles.set_up);
      for (const ScreenTriangle& each : pieces) {
        piece(command, each, intersect(on_target, each.within));
      }
    }
  }

  void piece(const Command& command, const ScreenTriangle& triangle, const PixelRect& rect) {
    ledger::PieceAccount& pieces = a_->pieces;
    ++pieces.all;
    const Int128 area =
        reference::twice_area({triangle.v[0].x, triangle.v[0].y}, {triangle.v[1].x, triangle.v[1].y},
                              {triangle.v[2].x, triangle.v[2].y});
    if (area == 0) {
      ++pieces.zero_area;
      return;
    }
    const bool front = (area > 0) == command.has(Flag::kFrontPositiveArea);
    if (command.has(front ? Flag::kCullFront : Flag::kCullBack)) {
      ++pieces.culled;
      return;
    }
    const PixelRect box = centres_in_box(triangle);
    if (box.empty()) {
      ++pieces.no_sample;
      return;
    }
    const PixelRect bounds = intersect(box, rect);
    if (bounds.empty()) {
      ++pieces.outside;
      return;
    }
    drawn(triangle, bounds,
          exact_edges(triangle, config_.raster.sub_pixel_bits,
                      reference::kTieRules[static_cast<std::size_t>(fill_rule(command, config_))].rule),
          jobs_.pieces.at(next_piece_++));
  }

  /// Pixels whose centres lie in the closed bounding box.
  [[nodiscard]] PixelRect centres_in_box(const ScreenTriangle& triangle) const {
    const double unit = 1 << config_.raster.sub_pixel_bits;
    const auto range = [&](auto coordinate) {
      const auto [low, high] =
          std::minmax({coordinate(triangle.v[0]), coordinate(triangle.v[1]), coordinate(triangle.v[2])});
      return std::pair{static_cast<int>(std::ceil(low / unit - 0.5)),
                       static_cast<int>(std::floor(high / unit - 0.5))};
    };
    const auto [left, right] = range([](const ScreenVertex& v) { return v.x; });
    const auto [top, bottom] = range([](const ScreenVertex& v) { return v.y; });
    return {.x_first = left, .y_first = top, .x_last = right, .y_last = bottom};
  }

  enum class Fate : std::uint8_t { kEdgesBlock, kEdgesTile, kHiZBlock, kHiZTile, kEvaluated };

  /// What becomes of each tile of the bounds.
  std::map<Pixel, Fate> tile_fates(const PixelRect& bounds, const std::array<ExactEdge, 3>& edges,
                                   const std::set<Pixel>& jobs) {
    const int tile = config_.tile_walker.tile_size;
    const int row = config_.block_walker.block_size / tile;
    struct Block {
      std::vector<Pixel> outside;
      std::vector<Pixel> hidden;
      std::vector<Pixel> evaluated;
    };
    std::map<Pixel, Block> blocks;
    const bool few = config_.block_walker.sample_reject && few_samples(bounds, row);
    for (int y = bounds.y_first / tile; y <= bounds.y_last / tile; ++y) {
      for (int x = bounds.x_first / tile; x <= bounds.x_last / tile; ++x) {
        const bool outside =
            few ? uncovered(x * tile, y * tile, bounds, edges)
                : config_.block_walker.trivial_reject && outside_an_edge(x * tile, y * tile, edges);
        Block& block = blocks[{x / row, y / row}];
        (outside ? block.outside : jobs.contains({x, y}) ? block.evaluated : block.hidden).push_back({x, y});
      }
    }
    std::map<Pixel, Fate> fates;
    for (const auto& [place, block] : blocks) {
      const bool dead = block.evaluated.empty();
      const bool no_tile = dead && block.hidden.empty();
      ++a_->blocks.all;
      ++(no_tile ? a_->blocks.edges : dead ? a_->blocks.hi_z : a_->blocks.live);
      for (const Pixel& each : block.outside) {
        fates[each] = no_tile ? Fate::kEdgesBlock : Fate::kEdgesTile;
      }
      for (const Pixel& each : block.hidden) {
        fates[each] = dead ? Fate::kHiZBlock : Fate::kHiZTile;
      }
      for (const Pixel& each : block.evaluated) {
        fates[each] = Fate::kEvaluated;
      }
    }
    return fates;
  }

  /// The bounds lie in one block, and are no wider and higher in pixels than it is in tiles.
  [[nodiscard]] bool few_samples(const PixelRect& bounds, int row_tiles) const {
    const int block = config_.block_walker.block_size;
    return bounds.x_first / block == bounds.x_last / block &&
           bounds.y_first / block == bounds.y_last / block &&
           bounds.x_last - bounds.x_first + 1 <= row_tiles && bounds.y_last - bounds.y_first + 1 <= row_tiles;
  }

  /// No sample of the tile within the bounds is inside all edges.
  [[nodiscard]] bool uncovered(int left, int top, const PixelRect& bounds,
                               const std::array<ExactEdge, 3>& edges) const {
    const int last = config_.tile_walker.tile_size - 1;
    const PixelRect in =
        intersect(bounds, {.x_first = left, .y_first = top, .x_last = left + last, .y_last = top + last});
    for (int y = in.y_first; y <= in.y_last; ++y) {
      for (int x = in.x_first; x <= in.x_last; ++x) {
        if (std::ranges::all_of(edges, [&](const ExactEdge& edge) { return edge.inside(x, y); })) {
          return false;
        }
      }
    }
    return true;
  }

  [[nodiscard]] bool outside_an_edge(int left, int top, const std::array<ExactEdge, 3>& edges) const {
    const int size = config_.tile_walker.tile_size;
    return std::ranges::any_of(edges, [&](const ExactEdge& edge) {
      for (int i = 0; i < size * size; ++i) {
        if (edge.inside(left + i % size, top + i / size)) {
          return false;
        }
      }
      return true;
    });
  }

  void drawn(const ScreenTriangle& triangle, const PixelRect& bounds, const std::array<ExactEdge, 3>& edges,
             const std::set<Pixel>& jobs) {
    struct Count {
      std::uint64_t covered = 0;
      std::uint64_t passed = 0;
      std::uint64_t kept = 0;
    };
    const int tile = config_.tile_walker.tile_size;
    std::map<Pixel, Fate> fates = tile_fates(bounds, edges, jobs);
    std::map<Pixel, Count> tiles;
    std::map<Pixel, Count> quads;
    Count piece;
    std::uint64_t hidden = 0;
    for (int y = bounds.y_first; y <= bounds.y_last; ++y) {
      for (int x = bounds.x_first; x <= bounds.x_last; ++x) {
        if (!std::ranges::all_of(edges, [&](const ExactEdge& edge) { return edge.inside(x, y); })) {
          continue;
        }
        const Outcome outcome = test(triangle.triangle, x, y);
        for (Count* const count : {&piece, &tiles[{x / tile, y / tile}], &quads[{x / 2, y / 2}]}) {
          ++count->covered;
          count->passed += outcome.passed ? 1 : 0;
          count->kept += outcome.kept ? 1 : 0;
        }
        ++a_->fragments.all;
        const bool killed_by_hi_z = kill(a_->fragments, fates.at({x / tile, y / tile}), outcome);
        hidden += killed_by_hi_z ? 1 : 0;
      }
    }
    for (const auto& [place, count] : quads) {
      ++a_->quads.all;
      kill(a_->quads, fates.at({place.first * 2 / tile, place.second * 2 / tile}),
           {.passed = count.passed != 0, .kept = count.kept != 0});
    }
    for (const auto& [place, fate] : fates) {
      ledger::TileAccount& account = a_->tiles;
      const Count& count = tiles[place];
      ++account.all;
      ++(fate == Fate::kEdgesBlock  ? account.edges_block
         : fate == Fate::kEdgesTile ? account.edges_tile
         : fate == Fate::kHiZBlock  ? account.hi_z_block
         : fate == Fate::kHiZTile   ? account.hi_z_tile
         : count.covered == 0       ? account.empty
         : count.passed == 0        ? account.early_z
         : count.kept == 0          ? account.late
                                    : account.survive);
    }
    ledger::PieceAccount& pieces = a_->pieces;
    ++(piece.covered == 0        ? pieces.uncovered
       : piece.kept != 0         ? pieces.survive
       : piece.passed != 0       ? pieces.late
       : hidden == piece.covered ? pieces.hi_z
       : hidden == 0             ? pieces.early_z
                                 : pieces.hi_z_early_z);
  }

  struct Outcome {
    bool passed = true;
    bool kept = true;
  };

  /// Returns whether hi_z did it.
  static bool kill(ledger::SampleAccount& account, Fate fate, const Outcome& outcome) {
    switch (fate) {
      case Fate::kHiZBlock:
      case Fate::kHiZTile:
        CHECK(!outcome.passed);
        ++(fate == Fate::kHiZBlock ? account.hi_z_block : account.hi_z_tile);
        return true;
      case Fate::kEvaluated:
        ++(outcome.kept ? account.survive : outcome.passed ? account.late : account.early_z);
        return false;
      default:
        FAIL("a covered sample in a tile outside an edge");
        return false;
    }
  }

  /// The depth test of one sample of the draw at work.
  Outcome test(std::uint32_t triangle, int x, int y) {
    if (!state_.test) {
      return {};
    }
    const std::uint32_t code =
        samples_.codes.at({static_cast<std::uint32_t>(draws_.size() - 1), triangle, x, y});
    std::uint32_t& depth = stored(surface_, x, y);
    const bool passed = passes_by_definition(state_.func, code, depth);
    const bool kept =
        passed &&
        !(state_.late && discard_.discards(static_cast<std::uint32_t>(draws_.size() - 1), triangle, x, y));
    depth = kept && state_.write ? code : depth;
    return {.passed = passed, .kept = kept};
  }

  const Frame& frame_;
  const Config& config_;
  Samples samples_;
  Jobs jobs_;
  std::vector<SurfaceShape> shapes_;
  std::vector<std::vector<std::uint32_t>> depth_;
  std::vector<Accounts> draws_;
  std::size_t next_piece_ = 0;
  std::uint64_t dropped_ = 0;

  // Of the draw at work.
  Accounts* a_ = nullptr;
  std::uint32_t surface_ = kNoSurface;
  EarlyZState state_;
  ShaderDiscard discard_ = shader_discard(config_);
};

}  // namespace halfspace::testing
