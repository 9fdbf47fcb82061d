// Without a guard that stops a second inclusion: once for each target of Highway.
#if defined(HALFSPACE_FAST_WALK_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HALFSPACE_FAST_WALK_INL
#undef HALFSPACE_FAST_WALK_INL
#else
#define HALFSPACE_FAST_WALK_INL
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "halfspace/fast/depth_bounds-inl.hpp"
#include "halfspace/fast/raster.hpp"
#include "halfspace/fast/tallies.hpp"
#include "halfspace/fast/triangle-inl.hpp"
#include "halfspace/fast/visit-inl.hpp"
#include "halfspace/machine/passage/packet_sums.hpp"
#include "halfspace/units/quad_generator.hpp"

HWY_BEFORE_NAMESPACE();
namespace halfspace::fast::HWY_NAMESPACE {
namespace {

/// Walkers, edge evaluator and quad generator: turns triangles into visits, and tells the stream of the jobs.
/// early_z takes the visits later, when what they need has come from memory.
template <int TileSize>
class Walk {
 public:
  static constexpr int kSamples = TileSize * TileSize;
  static constexpr std::uint64_t kAll = ~std::uint64_t{0} >> (64 - kSamples);
  static constexpr std::uint64_t kQuads = kSamples / 4;
  static constexpr std::size_t kMostVisits = 64;
  static constexpr std::size_t kMostTriangles = 16;

  Walk(const RasterTask& task, Tallies& tallies)
      : counters_(tallies.counters),
        tallies_(tallies),
        stream_(task.stream),
        columns_(task.columns),
        sums_(task.draw->sums),
        surface_(task.surface),
        counts_pixels_(task.counts_pixels),
        tiles_(task.tiles),
        func_(task.draw->early_z.func),
        is_float_(task.draw->early_z.format == DepthFormat::kFloat32),
        config_(task.walker),
        block_size_(task.walker.block_size),
        block_tiles_(task.walker.block_size / TileSize),
        block_shift_(std::countr_zero(static_cast<unsigned>(task.walker.block_size))),
        tile_shift_(std::countr_zero(static_cast<unsigned>(block_tiles_))),
        group_rows_(std::min(kLanes / block_tiles_, block_tiles_)),
        groups_(std::max(1, block_tiles_ * block_tiles_ / kLanes)) {}

  /// Calls flush() between two blocks where there may be no room for the visits of the next. Returns the
  /// blocks after the last job.
  template <class Flush>
  HWY_INLINE std::uint32_t triangle(Triangle& t, Flush&& flush) {
    empty_ = 0;
    const PixelRect& bounds = t.bounds;
    const bool one_tile = bounds.x_first / TileSize == bounds.x_last / TileSize &&
                          bounds.y_first / TileSize == bounds.y_last / TileSize;
    const int x_first = bounds.x_first >> block_shift_;
    const int x_last = bounds.x_last >> block_shift_;
    const int y_last = bounds.y_last >> block_shift_;
    for (int y = bounds.y_first >> block_shift_; y <= y_last; ++y) {
      if (one_tile || x_first == x_last) {
        block_alone(t, x_first, y, one_tile, flush);
      } else {
        block_row(t, x_first, x_last, y, flush);
      }
    }
    return empty_;
  }

  [[nodiscard]] std::size_t visits() const { return visit_count_; }
  [[nodiscard]] const Visit& visit(std::size_t i) const { return visits_[i]; }
  [[nodiscard]] const std::uint64_t* masks(const Visit& visit) const {
    return masks_.data() + visit.first_mask;
  }
  void clear() {
    visit_count_ = 0;
    mask_count_ = 0;
  }

 private:
  struct Verdict {
    std::uint32_t rejected = 0;               ///< a bit a square
    std::array<std::uint32_t, 3> accepted{};  ///< by edge
    [[nodiscard]] std::uint32_t whole() const { return accepted[0] & accepted[1] & accepted[2]; }
  };

  // ---- blocks ----

  template <class Flush>
  HWY_INLINE void block_alone(Triangle& t, int x, int y, bool one_tile, Flush&& flush) {
    Verdict verdict;
    if (!one_tile) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int64_t e = t.at(k, x << block_shift_, y << block_shift_);
        verdict.rejected |= e + t.block_reach[k].most < 0 ? 1 : 0;
        verdict.accepted[k] = e + t.block_reach[k].least >= 0 ? 1 : 0;
      }
      verdict = as_configured(verdict, 1);
      if (verdict.rejected != 0) {
        count_rejected(t.bounds, x, y, 1);
        ++empty_;
        return;
      }
    }
    block(t, x, y, verdict.whole() != 0, flush);
  }

  template <class Flush>
  HWY_INLINE void block_row(Triangle& t, int x_first, int x_last, int y, Flush&& flush) {
    const WideTag wide;
    const WideVector lane = hn::Iota(wide, 0);
    for (int x = x_first; x <= x_last; x += kWideWidth) {
      const auto count = std::min(x_last - x + 1, kWideWidth);
      const std::uint32_t all = (1u << count) - 1;
      Verdict verdict;
      WideVector outside = hn::Zero(wide);
      for (std::size_t k = 0; k < 3; ++k) {
        const WideVector step = hn::Set(wide, std::int64_t{t.a[k]} << block_shift_);
        const WideVector e =
            hn::Add(hn::Set(wide, t.at(k, x << block_shift_, y << block_shift_)), times(lane, step));
        outside = hn::Or(outside, hn::Add(e, hn::Set(wide, std::int64_t{t.block_reach[k].most})));
        verdict.accepted[k] = ~wide_negative(hn::Add(e, hn::Set(wide, std::int64_t{t.block_reach[k].least})));
      }
      verdict.rejected = wide_negative(outside);
      verdict = as_configured(verdict, all);
      const std::uint32_t own = all & columns_.lanes(static_cast<std::uint32_t>(x));
      verdict.rejected &= own;
      count_rejected(t.bounds, x, y, verdict.rejected);
      const std::uint32_t whole = verdict.whole();
      const std::uint32_t accepted = own & whole & filled_blocks(t.bounds, x, y);
      int next = 0;
      for (std::uint32_t left = own & ~verdict.rejected; left != 0;) {
        const int i = std::countr_zero(left);
        empty_ += static_cast<std::uint32_t>(i - next);
        if ((accepted >> i & 1) != 0) {
          // They are neighbours: no other comes between.
          accepted_blocks(t, x, y, accepted, flush);
          next = std::bit_width(accepted);
          left &= ~accepted;
          continue;
        }
        block(t, x + i, y, (whole >> i & 1) != 0, flush);
        next = i + 1;
        left &= left - 1;
      }
      empty_ += static_cast<std::uint32_t>(count - next);
    }
  }

  /// Of the blocks from (x, y) on, those that lie within bounds.
  [[nodiscard]] HWY_INLINE std::uint32_t filled_blocks(const PixelRect& bounds, int x, int y) const {
    const int py = y << block_shift_;
    if (bounds.y_first > py || bounds.y_last < py + block_size_ - 1) {
      return 0;
    }
    const int first = std::max(((bounds.x_first + block_size_ - 1) >> block_shift_) - x, 0);
    const int end = std::min(((bounds.x_last + 1) >> block_shift_) - x, kWideWidth);
    return first < end ? (1u << end) - (1u << first) : 0;
  }

  /// Blocks that are covered whole, a bit each from (x, y) on.
  template <class Flush>
  HWY_NOINLINE void accepted_blocks(Triangle& t, int x, int y, std::uint32_t blocks, Flush&& flush) {
    if (visit_count_ == kMostVisits) {
      flush();
    }
    Visit& visit = visits_[visit_count_++];
    visit.triangle = &t;
    visit.block_x = static_cast<std::uint32_t>(x);
    visit.block_y = static_cast<std::uint32_t>(y);
    visit.blocks = blocks;
    count_accepted(ones(blocks));
    if (stream_ == nullptr && sums_ == nullptr) {
      return;
    }
    for (std::uint32_t left = blocks; left != 0; left &= left - 1) {
      const int block = x + std::countr_zero(left);
      tells_block_ = true;
      for (int group = 0; group < groups_; ++group) {
        const std::uint32_t all = all_tiles(group);
        count_decisions(block, y, group, 0, all, 0);
        count_quads(block, y, group, all, 0, nullptr);
        tell_jobs(all, all, nullptr);
      }
    }
  }

  [[nodiscard]] HWY_INLINE Verdict as_configured(Verdict verdict, std::uint32_t all) const {
    verdict.rejected &= config_.trivial_reject ? all : 0;
    for (std::uint32_t& accepted : verdict.accepted) {
      accepted &= config_.trivial_accept ? all : 0;
    }
    return verdict;
  }

  template <class Flush>
  HWY_INLINE void block(Triangle& t, int x, int y, bool covered, Flush&& flush) {
    const PixelRect& bounds = t.bounds;
    const int px = x << block_shift_;
    const int py = y << block_shift_;
    const PixelRect inside{.x_first = std::max(bounds.x_first - px, 0),
                           .y_first = std::max(bounds.y_first - py, 0),
                           .x_last = std::min(bounds.x_last - px, block_size_ - 1),
                           .y_last = std::min(bounds.y_last - py, block_size_ - 1)};
    const bool filled = inside.x_last - inside.x_first == block_size_ - 1 &&
                        inside.y_last - inside.y_first == block_size_ - 1;
    if (covered && filled) {
      accepted_blocks(t, x, y, 1, flush);
      return;
    }
    if (visit_count_ + static_cast<std::size_t>(groups_) > kMostVisits) {
      flush();
    }
    tells_block_ = true;
    std::uint32_t jobs = 0;
    // Saturated: what matters is the sign inside the block.
    constexpr std::int64_t kLimit = std::int64_t{1} << 30;
    std::array<std::int32_t, 3> e{};
    for (std::size_t k = 0; k < 3; ++k) {
      e[k] = static_cast<std::int32_t>(std::clamp(t.at(k, px, py), -kLimit, kLimit - 1));
    }
    for (int group = 0; group < groups_; ++group) {
      jobs |= tiles(t, x, y, group, e, inside, filled);
      for (std::size_t k = 0; k < 3; ++k) {
        e[k] += t.b[k] * group_rows_ * TileSize;
      }
    }
    ++counters_.block_walker.blocks;
    if (jobs == 0) {
      ++counters_.block_walker.blocks_empty;
      ++empty_;
    }
  }

  /// It is a visit when it is counted.
  HWY_INLINE Visit& begin_visit(Triangle& t, int x, int y, int group) {
    Visit& visit = visits_[visit_count_];
    visit.triangle = &t;
    visit.block_x = static_cast<std::uint32_t>(x);
    visit.block_y = static_cast<std::uint32_t>(y);
    visit.blocks = 0;
    visit.group = static_cast<std::uint32_t>(group);
    visit.whole = 0;
    visit.partial = 0;
    visit.first_mask = mask_count_;
    if (tiles_ != nullptr) {
      tiles_->open(tiles_->block(visit.block_x, visit.block_y));
    }
    if (t.kind != DepthKind::kNone) {
      code_range(t, x << block_shift_, (y << block_shift_) + group * group_rows_ * TileSize, is_float_,
                 visit.range);
    }
    return visit;
  }

  // ---- tiles of a block ----

  [[nodiscard]] HWY_INLINE std::uint32_t all_tiles(int group) const {
    return group_lanes(group, 0, block_tiles_ - 1, 0, block_tiles_ - 1);
  }

  /// Lanes of the tiles in columns and rows of a block.
  [[nodiscard]] HWY_INLINE std::uint32_t group_lanes(int group, int x_first, int x_last, int y_first,
                                                     int y_last) const {
    constexpr std::uint32_t kColumns[] = {0xFFFF, 0x5555, 0x1111, 0x0101, 0x0001};
    const int above = group * group_rows_;
    const int first = std::max(y_first - above, 0);
    const int last = std::min(y_last - above, group_rows_ - 1);
    if (first > last || x_first > x_last) {
      return 0;
    }
    const std::uint32_t row = ((2u << x_last) - 1) & ~((1u << x_first) - 1);
    const std::uint32_t rows =
        ((1u << ((last + 1) << tile_shift_)) - 1) & ~((1u << (first << tile_shift_)) - 1);
    return row * kColumns[tile_shift_] & rows;
  }

  /// Returns those that are not rejected.
  HWY_INLINE std::uint32_t tiles(Triangle& t, int x, int y, int group, const std::array<std::int32_t, 3>& e,
                                 const PixelRect& inside, bool filled) {
    const Tag tag;
    alignas(64) std::int32_t at[3][kLanes];
    Verdict verdict;
    for (int i = 0; i < kLanes; i += kWidth) {
      Vector outside = hn::Zero(tag);
      for (std::size_t k = 0; k < 3; ++k) {
        const Vector there = hn::Add(set(e[k]), hn::Load(tag, t.tile_steps[k] + i));
        hn::Store(there, tag, at[k] + i);
        outside = hn::Or(outside, hn::Add(there, set(t.tile_reach[k].most)));
        verdict.accepted[k] |= (~negative(hn::Add(there, set(t.tile_reach[k].least))) & ((1u << kWidth) - 1))
                               << i;
      }
      verdict.rejected |= negative(outside) << i;
    }
    std::uint32_t touched = group_lanes(group, inside.x_first / TileSize, inside.x_last / TileSize,
                                        inside.y_first / TileSize, inside.y_last / TileSize);
    verdict = as_configured(verdict, touched);
    touched &= ~verdict.rejected;
    std::uint32_t whole = verdict.whole() & touched;
    if (!filled && whole != 0) {
      whole &=
          group_lanes(group, (inside.x_first + TileSize - 1) / TileSize, (inside.x_last + 1) / TileSize - 1,
                      (inside.y_first + TileSize - 1) / TileSize, (inside.y_last + 1) / TileSize - 1);
    }
    const std::uint32_t partial = touched & ~whole;
    count_tiles(verdict.rejected, whole, partial, verdict.accepted, counters_);
    count_decisions(x, y, group, verdict.rejected, whole, partial);
    if (touched == 0) {
      return 0;
    }
    Visit& visit = begin_visit(t, x, y, group);
    visit.whole = static_cast<std::uint16_t>(whole);
    const std::uint32_t looked_at = t.kind == DepthKind::kNone ? 0 : ~dead(visit);
    const int first_x = x << tile_shift_;
    const int first_y = (y << tile_shift_) + group * group_rows_;
    count_whole(ones(whole));
    std::array<std::uint8_t, kLanes> quads;
    for (std::uint32_t left = partial; left != 0; left &= left - 1) {
      const int i = std::countr_zero(left);
      const int column = i & (block_tiles_ - 1);
      const int row = i >> tile_shift_;
      std::uint64_t mask = inside_edges(t, {at[0][i], at[1][i], at[2][i]});
      if (!filled) {
        mask &= inside_rect(inside, column * TileSize, (group * group_rows_ + row) * TileSize);
      }
      quads[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(count_partial(mask));
      if (mask == 0) {
        continue;
      }
      masks_[mask_count_++] = mask;
      visit.partial = static_cast<std::uint16_t>(visit.partial | 1u << i);
      if ((looked_at >> i & 1) != 0) {
        prefetch(surface_->codes.tile(first_x + column, first_y + row), mask);
      }
      if (counts_pixels_) {
        prefetch_counts(tiles_->block(visit.block_x, visit.block_y) * tiles_->entries + visit.group * kLanes +
                        i);
      }
    }
    counters_.edge_evaluator.tiles_empty +=
        static_cast<std::uint64_t>(std::popcount(partial) - std::popcount(visit.partial));
    visit_count_ += (visit.whole | visit.partial) != 0 ? 1 : 0;
    count_quads(x, y, group, visit.whole, visit.partial, masks(visit));
    tell_jobs(touched, whole, quads.data());
    return touched;
  }

  // ---- what is counted of them ----

  /// Blocks that are covered whole.
  void count_accepted(std::uint64_t blocks) {
    const std::uint64_t tiles = blocks << 2 * tile_shift_;
    counters_.block_walker.blocks += blocks;
    counters_.tile_walker.tiles_accepted += tiles;
    counters_.edge_evaluator.tiles_skipped += tiles;
    count_whole(tiles);
  }

  void count_whole(std::uint64_t tiles) {
    tallies_.bursts += tiles;
    tallies_.fragments += tiles * kSamples;
    tallies_.quads += tiles * kQuads;
    tallies_.full_quads += tiles * kQuads;
  }

  /// Returns the quads.
  HWY_INLINE std::uint64_t count_partial(std::uint64_t mask) {
    constexpr std::uint64_t kCorners = quad_corners<TileSize>();
    const std::uint64_t any_pairs = mask | mask >> 1;
    const std::uint64_t all_pairs = mask & mask >> 1;
    const std::uint64_t quads = ones((any_pairs | any_pairs >> TileSize) & kCorners);
    tallies_.bursts += mask != 0 ? 1 : 0;
    tallies_.fragments += ones(mask);
    tallies_.quads += quads;
    tallies_.full_quads += ones((all_pairs & all_pairs >> TileSize) & kCorners);
    return quads;
  }

  /// Blocks outside one edge, a bit each from (x, y) on.
  HWY_INLINE void count_rejected(const PixelRect& bounds, int x, int y, std::uint32_t blocks) {
    constexpr int kTileShift = TileSize == 8 ? 3 : 2;
    const int first_row = std::max(bounds.y_first, y << block_shift_) >> kTileShift;
    const int last_row = std::min(bounds.y_last, ((y + 1) << block_shift_) - 1) >> kTileShift;
    // Of the first block of the bounds and of the last not all columns count.
    std::uint64_t columns = ones(blocks) << tile_shift_;
    const auto has = [&](int block) {
      return block >= x && block - x < kWideWidth && (blocks >> (block - x) & 1) != 0;
    };
    if (const int first = bounds.x_first >> block_shift_; has(first)) {
      columns -= static_cast<std::uint64_t>((bounds.x_first >> kTileShift) - (first << tile_shift_));
    }
    if (const int last = bounds.x_last >> block_shift_; has(last)) {
      columns -= static_cast<std::uint64_t>(((last + 1) << tile_shift_) - 1 - (bounds.x_last >> kTileShift));
    }
    counters_.block_walker.blocks += ones(blocks);
    counters_.block_walker.blocks_empty += ones(blocks);
    counters_.block_walker.tiles_rejected += columns * static_cast<std::uint64_t>(last_row - first_row + 1);
    for (std::uint32_t left = sums_ == nullptr ? 0 : blocks; left != 0; left &= left - 1) {
      const int px = (x + std::countr_zero(left)) << block_shift_;
      const int last = std::min(bounds.x_last, px + block_size_ - 1) >> kTileShift;
      for (int row = first_row; row <= last_row; ++row) {
        for (int column = std::max(bounds.x_first, px) >> kTileShift; column <= last; ++column) {
          passage::count(sums_->decisions.at(column, row), TileVerdict::kReject);
        }
      }
    }
  }

  /// Of a group of tiles of a block, by lane.
  void count_decisions(int x, int y, int group, std::uint32_t rejected, std::uint32_t whole,
                       std::uint32_t partial) {
    if (sums_ == nullptr) {
      return;
    }
    TileDecisions* const tiles = sums_->decisions.tile(x, y) + group * kLanes;
    const auto count = [tiles](std::uint32_t lanes, TileVerdict verdict) {
      for (std::uint32_t left = lanes; left != 0; left &= left - 1) {
        passage::count(tiles[std::countr_zero(left)], verdict);
      }
    };
    count(rejected, TileVerdict::kReject);
    count(whole, TileVerdict::kAccept);
    count(partial, TileVerdict::kPartial);
  }

  /// `mask`: of the partial tiles.
  void count_quads(int x, int y, int group, std::uint32_t whole, std::uint32_t partial,
                   const std::uint64_t* mask) {
    if (sums_ == nullptr) {
      return;
    }
    const int first_x = x << tile_shift_;
    const int first_y = (y << tile_shift_) + group * group_rows_;
    for (std::uint32_t left = whole | partial; left != 0; left &= left - 1) {
      const int i = std::countr_zero(left);
      const std::uint64_t covered = (whole >> i & 1) != 0 ? kAll : *mask++;
      passage::count_quads<TileSize>(*sums_, first_x + (i & (block_tiles_ - 1)), first_y + (i >> tile_shift_),
                                     {{covered}});
    }
  }

  /// Of a group of tiles the jobs, and of these the ones that are covered whole. `quads`: of the others, by
  /// lane.
  HWY_INLINE void tell_jobs(std::uint32_t jobs, std::uint32_t whole, const std::uint8_t* quads) {
    if (stream_ == nullptr || jobs == 0) {
      return;
    }
    if (tells_block_) {
      stream_->block(empty_);
      empty_ = 0;
      tells_block_ = false;
    }
    for (std::uint32_t left = jobs; left != 0; left &= left - 1) {
      const int i = std::countr_zero(left);
      stream_->job((whole >> i & 1) != 0 ? static_cast<int>(kQuads) : quads[i]);
    }
  }

  /// Tiles of a visit whose samples will all die: what is written until their turn comes does not change
  /// that.
  [[nodiscard]] HWY_INLINE std::uint32_t dead(const Visit& visit) const {
    if (!is_ordered(func_)) {
      return 0;
    }
    const std::size_t at =
        tiles_->block(visit.block_x, visit.block_y) * tiles_->entries + visit.group * kLanes;
    return outcome(func_, visit.range, *tiles_, at).killed;
  }

  /// The lines of the processor's cache, two rows of a tile each, that hold samples of the mask.
  template <class Value>
  static HWY_INLINE void prefetch(const Value* tile, std::uint64_t mask) {
    constexpr int kLineSamples = 64 / static_cast<int>(sizeof(Value));
    const int first = std::countr_zero(mask) / kLineSamples;
    const int last = (63 - std::countl_zero(mask)) / kLineSamples;
    hwy::Prefetch(tile + first * kLineSamples);
    for (int line = first + 1; line <= last; ++line) {
      hwy::Prefetch(tile + line * kLineSamples);
    }
  }

  void prefetch_counts(std::size_t tile) {
    for (const PixelCounts* counts : {&tiles_->fragments, &tiles_->survivors}) {
      hwy::Prefetch(counts->first_word(tile));
      hwy::Prefetch(counts->second_word(tile));
    }
  }

  // ---- samples of a tile ----

  /// Given the edges at its first sample.
  HWY_INLINE std::uint64_t inside_edges(const Triangle& t, const std::array<std::int32_t, 3>& e) const {
    const Tag tag;
    std::uint64_t outside = 0;
    Vector value[3];
    Vector down[3];
    constexpr int kRows = kWidth / TileSize;
    static_assert(kWidth == 1 || kRows >= 1 || kWidth == 4);
    for (std::size_t k = 0; k < 3; ++k) {
      value[k] = hn::Add(set(e[k]), hn::Load(tag, t.sample_steps[k]));
      down[k] = kRows > 0 ? set(t.b[k] * kRows) : set(t.a[k] * kWidth);
    }
    for (int i = 0; i < kSamples; i += kWidth) {
      outside |= std::uint64_t{negative(hn::Or(value[0], hn::Or(value[1], value[2])))} << i;
      for (std::size_t k = 0; k < 3; ++k) {
        value[k] = hn::Add(value[k], down[k]);
        if (kRows == 0 && (i + kWidth) % TileSize == 0) {
          value[k] = hn::Add(value[k], set(t.b[k] - t.a[k] * TileSize));
        }
      }
    }
    return kAll & ~outside;
  }

  /// Samples of the tile at (x, y) that `rect` holds.
  static HWY_INLINE std::uint64_t inside_rect(const PixelRect& rect, int x, int y) {
    constexpr std::uint64_t kColumn = kSamples == 64 ? 0x0101010101010101u : 0x1111u;
    const int x_first = std::max(rect.x_first - x, 0);
    const int x_last = std::min(rect.x_last - x, TileSize - 1);
    const int y_first = std::max(rect.y_first - y, 0);
    const int y_last = std::min(rect.y_last - y, TileSize - 1);
    const std::uint64_t row = ((std::uint64_t{2} << (x_last - x_first)) - 1) << x_first;
    const std::uint64_t upto = kAll >> (TileSize * (TileSize - 1 - y_last));
    return kColumn * row & upto & (kAll << (TileSize * y_first));
  }

  Counters& counters_;
  Tallies& tallies_;
  StreamWriter* const stream_;
  const Columns columns_;
  PacketSums* const sums_;
  Surface* const surface_;
  const bool counts_pixels_;
  SurfaceTiles* const tiles_;
  const DepthFunc func_;
  const bool is_float_;
  const WalkerConfig& config_;
  const int block_size_;
  const int block_tiles_;  ///< on a side
  const int block_shift_;  ///< log2 of its pixels on a side
  const int tile_shift_;   ///< log2 of its tiles
  const int group_rows_;
  const int groups_;
  std::array<Visit, kMostVisits> visits_;
  std::array<std::uint64_t, kMostVisits * kLanes> masks_;
  std::size_t visit_count_ = 0;
  std::uint32_t empty_ = 0;   ///< blocks since the last job; where there is a stream
  bool tells_block_ = false;  ///< with the first job of the block at work
  std::uint32_t mask_count_ = 0;
};

}  // namespace
}  // namespace halfspace::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
