// Without a guard that stops a second inclusion: once for each target of Highway.
#if defined(HALFSPACE_FAST_WINDOWS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HALFSPACE_FAST_WINDOWS_INL
#undef HALFSPACE_FAST_WINDOWS_INL
#else
#define HALFSPACE_FAST_WINDOWS_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <iterator>

#include "halfspace/fast/plane-inl.hpp"
#include "halfspace/fast/raster.hpp"
#include "halfspace/fast/tallies.hpp"

HWY_BEFORE_NAMESPACE();
namespace halfspace::fast::HWY_NAMESPACE {
namespace {

/// What is found of small triangles, one a lane, in windows of Side x Side samples. By tile, as `covered`:
/// left, right, and below.
template <int Side>
struct WindowBatch {
  static constexpr int kRows = 4;  ///< in a word of a mask
  static constexpr std::size_t kWords = Side / kRows;

  Vector x;  ///< first pixel of the window
  Vector y;
  std::uint32_t hit = 0;                   ///< windows of which a sample is covered
  std::uint32_t columns_first = 0;         ///< windows whose left tiles are a block apart from the right
  std::array<std::uint32_t, 4> covered{};  ///< and in this tile
  /// In word y / kRows bit Side * (y % kRows) + x.
  alignas(64) std::int32_t mask[4][kWords][kWidth];
  alignas(64) std::int32_t tile[4][kWidth];   ///< its number in the image
  alignas(64) std::int32_t block[4][kWidth];  ///< of its block
  alignas(64) std::int32_t at[4][kWidth];     ///< in SurfaceTiles
  alignas(64) std::int32_t entry[4][kWidth];  ///< in BlockCache

  /// The walker's tile `i` of the window in `lane`.
  [[nodiscard]] std::size_t tile_in_order(std::size_t lane, std::size_t i) const {
    return (columns_first >> lane & 1) != 0 ? (i & 1) << 1 | i >> 1 : i;
  }
};

/// Walkers, edge evaluator and quad generator of small triangles, one a lane: each within a window of
/// Side x Side samples that begins at a quad. A window, no larger than a tile, lies on one, two or four.
template <int TileSize, int Side>
class Windows {
 public:
  using Batch = WindowBatch<Side>;
  static_assert(Side <= TileSize);

  Windows(const RasterTask& task, Tallies& tallies)
      : task_(task),
        counters_(tallies.counters),
        tallies_(tallies),
        block_shift_(std::countr_zero(static_cast<unsigned>(task.walker.block_size))) {}

  /// Bounds as large as a tile, which may be covered whole: windows know partial tiles only.
  static HWY_INLINE hn::Mask<Tag> may_fill_tile(const SetUpTriangles& in, std::size_t at) {
    const Vector width = hn::Sub(field(in.x_last, at), field(in.x_first, at));
    const Vector height = hn::Sub(field(in.y_last, at), field(in.y_first, at));
    return hn::Gt(hn::Min(width, height), set(TileSize - 2));
  }

  /// Which of the kWidth triangles from `at` on are small: with edges so short that 32 bits do in blocks
  /// around them.
  static std::uint32_t among(const SetUpTriangles& in, std::size_t at) {
    constexpr std::int32_t kMostStep = 1 << 14;
    Vector steps = hn::Zero(Tag());
    for (std::size_t k = 0; k < 3; ++k) {
      steps = hn::Or(steps, hn::Or(hn::Abs(field(in.a[k], at)), hn::Abs(field(in.b[k], at))));
    }
    const auto extent = [&](const auto& first, const auto& last) {
      return hn::Sub(field(last, at), hn::AndNot(set(1), field(first, at)));
    };
    const Vector side = hn::Max(extent(in.x_first, in.x_last), extent(in.y_first, in.y_last));
    const auto fits = hn::And(hn::Lt(steps, set(kMostStep)), hn::Lt(side, set(Side)));
    const auto has_vectors = hn::Lt(field(in.kind, at), set(static_cast<std::int32_t>(DepthKind::kUnits)));
    return bits_of(hn::And(hn::And(fits, has_vectors), hn::Not(may_fill_tile(in, at))));
  }

  /// Looks at `count` small triangles from `first` on, at most kWidth.
  void look_at(const SetUpTriangles& in, std::size_t first, std::size_t count) {
    in_ = &in;
    first_ = first;
    all_ = static_cast<std::uint32_t>((std::uint64_t{1} << count) - 1);
    place();
    cover();
    decide();
  }

  /// Tells the triangles and their jobs.
  void tell(StreamWriter& stream) const {
    for (std::uint32_t left = all_; left != 0; left &= left - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(left));
      stream.drawn(static_cast<std::uint32_t>(in_->order[first_ + lane]));
      stream.walked(tell_jobs(lane, stream));
    }
  }

  /// Adds what was counted in vectors to the tallies.
  void tally() {
    const auto total = [](Vector sum) HWY_ATTR {
      return static_cast<std::uint64_t>(hn::GetLane(hn::SumOfLanes(Tag(), sum)));
    };
    tallies_.fragments += total(sum_[0]);
    tallies_.quads += total(sum_[1]);
    tallies_.full_quads += total(sum_[2]);
    std::fill(std::begin(sum_), std::end(sum_), hn::Zero(Tag()));
  }

  /// Of triangles `at` and the next ones.
  static HWY_INLINE Vector field(const SetUpTriangles::Field<std::int32_t>& values, std::size_t at) {
    return hn::LoadU(Tag(), values.data() + at);
  }

  Batch found;

 private:
  static constexpr std::size_t kWords = Batch::kWords;
  static constexpr int kRows = Batch::kRows;
  /// Of a word: the first column, and the samples that begin a quad.
  static constexpr std::int32_t kFirstColumn = Side == 8 ? 0x01010101 : 0x1111;
  static constexpr std::int32_t kCorners = Side == 8 ? 0x00550055 : 0x0505;

  void place() {
    const Vector even = set(~1);
    x_first_ = field(in_->x_first, first_);
    y_first_ = field(in_->y_first, first_);
    x_last_ = field(in_->x_last, first_);
    y_last_ = field(in_->y_last, first_);
    found.x = hn::And(x_first_, even);
    found.y = hn::And(y_first_, even);
    for (std::size_t k = 0; k < 3; ++k) {
      a_[k] = field(in_->a[k], first_);
      b_[k] = field(in_->b[k], first_);
      e_[k] = hn::Add(low_half(in_->e[k], first_), hn::Add(hn::Mul(a_[k], found.x), hn::Mul(b_[k], found.y)));
    }
  }

  /// 64-bit numbers that are close enough to 0, or modulo 2^32.
  static HWY_INLINE Vector low_half(const SetUpTriangles::Field<std::int64_t>& values, std::size_t at) {
    const WideTag wide;
    const auto* const from = values.data() + at;
    return narrow(hn::LoadU(wide, from), hn::LoadU(wide, from + (kWidth > 1 ? kWideWidth : 0)));
  }

  /// The samples of the windows that are covered.
  void cover() {
    for (std::size_t word = 0; word < kWords; ++word) {
      inside_[word] = hn::AndNot(outside(static_cast<int>(word) * kRows), bounds(word));
    }
  }

  /// Of the rows from `first` on.
  HWY_INLINE Vector outside(int first) const {
    const Tag tag;
    Vector outside = hn::Zero(tag);
    for (int row = first + kRows - 1; row >= first; --row) {
      Vector at[3];
      for (std::size_t k = 0; k < 3; ++k) {
        at[k] = hn::Add(e_[k], hn::Add(hn::Mul(b_[k], set(row)), hn::Mul(a_[k], set(Side - 1))));
      }
      for (int column = Side - 1; column >= 0; --column) {
        const Vector any = hn::Or(at[0], hn::Or(at[1], at[2]));
        const Vector sign =
            hn::BitCast(tag, hn::ShiftRight<31>(hn::BitCast(hn::RebindToUnsigned<Tag>(), any)));
        outside = hn::Or(hn::ShiftLeft<1>(outside), sign);
        for (std::size_t k = 0; k < 3; ++k) {
          at[k] = hn::Sub(at[k], a_[k]);
        }
      }
    }
    return outside;
  }

  /// Bits before `end`.
  static HWY_INLINE Vector upto(Vector end) { return hn::Sub(hn::Shl(set(1), end), set(1)); }

  /// Samples in a word of a mask, given columns and rows of the window, a bit each.
  static HWY_INLINE Vector rectangle(Vector columns, Vector rows, std::size_t word) {
    const Vector here =
        hn::And(hn::ShiftRightSame(rows, static_cast<int>(word) * kRows), set((1 << kRows) - 1));
    // Bit i goes to row i, in two steps.
    const Vector pairs = hn::And(hn::Or(here, hn::ShiftLeft<2 * (Side - 1)>(here)), set(3 | 3 << 2 * Side));
    const Vector begins = hn::And(hn::Or(pairs, hn::ShiftLeft<Side - 1>(pairs)), set(kFirstColumn));
    return hn::And(hn::Mul(begins, set((1 << Side) - 1)), hn::Mul(columns, set(kFirstColumn)));
  }

  /// Samples within the bounds.
  HWY_INLINE Vector bounds(std::size_t word) const {
    const auto between = [](Vector first, Vector last, Vector begin) HWY_ATTR {
      return hn::AndNot(upto(hn::Sub(first, begin)), upto(hn::Add(hn::Sub(last, begin), set(1))));
    };
    return rectangle(between(x_first_, x_last_, found.x), between(y_first_, y_last_, found.y), word);
  }

  /// The corners of the squares of which (x, y) are the first samples.
  HWY_INLINE void corners(Vector x, Vector y, int size, std::uint32_t& rejected,
                          std::array<std::uint32_t, 3>& accepted) const {
    const Tag tag;
    const Vector zero = hn::Zero(tag);
    const Vector far = set(size - 1);
    const Vector dx = hn::Sub(x, found.x);
    const Vector dy = hn::Sub(y, found.y);
    Vector outside = zero;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector at = hn::Add(e_[k], hn::Add(hn::Mul(a_[k], dx), hn::Mul(b_[k], dy)));
      const Vector far_x = hn::Mul(a_[k], far);
      const Vector far_y = hn::Mul(b_[k], far);
      outside = hn::Or(outside, hn::Add(at, hn::Add(hn::Max(far_x, zero), hn::Max(far_y, zero))));
      accepted[k] = task_.walker.trivial_accept
                        ? ~negative(hn::Add(at, hn::Add(hn::Min(far_x, zero), hn::Min(far_y, zero))))
                        : 0;
    }
    rejected = task_.walker.trivial_reject ? negative(outside) : 0;
  }

  /// The decisions of the walker, and what is covered of each tile.
  void decide() {
    const Tag tag;
    const auto square = [](Vector v, int shift) { return hn::ShiftRightSame(v, shift); };
    constexpr int kTileShift = TileSize == 8 ? 3 : 2;
    const Vector tile_x = square(x_first_, kTileShift);
    const Vector tile_y = square(y_first_, kTileShift);
    const std::uint32_t wide = all_ & bits_of(hn::Gt(square(x_last_, kTileShift), tile_x));
    const std::uint32_t tall = all_ & bits_of(hn::Gt(square(y_last_, kTileShift), tile_y));
    own_columns();
    find_blocks();
    // Columns and rows on the first tile and on the second.
    const auto split = [&](Vector tile, Vector begin, std::uint32_t lanes, Vector* parts) HWY_ATTR {
      const Vector border = hn::Sub(hn::ShiftLeft<kTileShift>(hn::Add(tile, set(1))), begin);
      const Vector all = set((1 << Side) - 1);
      parts[0] = hn::IfThenElse(mask_of(lanes), upto(hn::Min(border, set(Side))), all);
      parts[1] = hn::AndNot(parts[0], all);
    };
    Vector columns[2];
    Vector rows[2];
    split(tile_x, found.x, wide, columns);
    split(tile_y, found.y, tall, rows);
    found.hit = 0;
    for (unsigned q = 0; q < 4; ++q) {
      std::uint32_t there = all_ & ((q & 1) != 0 ? wide : ~0u) & ((q & 2) != 0 ? tall : ~0u);
      there &= (q & 1) != 0 ? (two_x_ & own_[1]) | (own_[0] & ~two_x_) : own_[0];
      found.covered[q] = 0;
      decided_[q] = there;
      jobs_[q] = 0;
      if (there == 0) {
        continue;
      }
      std::uint32_t rejected = 0;
      std::array<std::uint32_t, 3> accepted{};
      corners(hn::ShiftLeft<kTileShift>(hn::Add(tile_x, set(static_cast<std::int32_t>(q & 1)))),
              hn::ShiftLeft<kTileShift>(hn::Add(tile_y, set(static_cast<std::int32_t>(q >> 1)))), TileSize,
              rejected, accepted);
      count_tiles(there & rejected, 0, there & ~rejected, accepted, counters_);
      there &= ~rejected;
      jobs_[q] = there;
      Vector masks[kWords];
      Vector some = hn::Zero(tag);
      for (std::size_t word = 0; word < kWords; ++word) {
        const Vector part = rectangle(columns[q & 1], rows[q >> 1], word);
        masks[word] = hn::IfThenElseZero(mask_of(there), hn::And(inside_[word], part));
        some = hn::Or(some, masks[word]);
        hn::Store(masks[word], tag, found.mask[q][word]);
      }
      const std::uint32_t covered = bits_of(hn::Ne(some, hn::Zero(tag)));
      counters_.edge_evaluator.tiles_empty += ones(there & ~covered);
      tallies_.bursts += ones(covered);
      count_quads(q, masks);
      found.covered[q] = covered;
      found.hit |= covered;
      if (covered != 0 && task_.tiles != nullptr) {
        locate(q, hn::Add(tile_x, set(static_cast<std::int32_t>(q & 1))),
               hn::Add(tile_y, set(static_cast<std::int32_t>(q >> 1))));
      }
    }
    count_blocks();
  }

  /// Windows whose first column of blocks, and whose second, are the task's.
  void own_columns() {
    const Vector column = hn::ShiftRightSame(x_first_, block_shift_);
    const Vector mask = set(task_.columns.mask);
    const Vector own = set(task_.columns.own);
    own_[0] = bits_of(hn::Eq(hn::And(column, mask), own));
    own_[1] = bits_of(hn::Eq(hn::And(hn::Add(column, set(1)), mask), own));
  }

  /// The blocks that the windows lie on.
  void find_blocks() {
    const auto crosses = [&](Vector first, Vector last) HWY_ATTR {
      return all_ &
             bits_of(hn::Gt(hn::ShiftRightSame(last, block_shift_), hn::ShiftRightSame(first, block_shift_)));
    };
    two_x_ = crosses(x_first_, x_last_);
    two_y_ = crosses(y_first_, y_last_);
    found.columns_first = two_x_ & ~two_y_;
  }

  /// Blocks, and those without a job. A border of tiles that is not one of blocks is inside a block.
  void count_blocks() {
    BlockWalkerCounters& counters = counters_.block_walker;
    for (unsigned block = 0; block < 4; ++block) {
      const std::uint32_t there =
          all_ & ((block & 1) != 0 ? two_x_ : ~0u) & ((block & 2) != 0 ? two_y_ : ~0u) & own_[block & 1];
      if (there == 0) {
        continue;
      }
      std::uint32_t with_job = 0;
      for (unsigned tile = 0; tile < 4; ++tile) {
        const std::uint32_t same_x = (tile & 1) == (block & 1) ? ~0u : (tile & 1) != 0 ? ~two_x_ : 0;
        const std::uint32_t same_y = (tile & 2) == (block & 2) ? ~0u : (tile & 2) != 0 ? ~two_y_ : 0;
        with_job |= jobs_[tile] & same_x & same_y;
      }
      counters.blocks += ones(there);
      counters.blocks_empty += ones(there & ~with_job);
    }
  }

  void count_quads(unsigned q, const Vector* masks) {
    const hn::RebindToUnsigned<Tag> plain;
    const auto population = [&](Vector bits) HWY_ATTR {
      return hn::BitCast(Tag(), hn::PopulationCount(hn::BitCast(plain, bits)));
    };
    Vector quads = hn::Zero(Tag());
    for (std::size_t word = 0; word < kWords; ++word) {
      const Vector mask = masks[word];
      const Vector any_pairs = hn::Or(mask, hn::ShiftRight<1>(mask));
      const Vector all_pairs = hn::And(mask, hn::ShiftRight<1>(mask));
      const Vector any = hn::And(hn::Or(any_pairs, hn::ShiftRight<Side>(any_pairs)), set(kCorners));
      const Vector full = hn::And(hn::And(all_pairs, hn::ShiftRight<Side>(all_pairs)), set(kCorners));
      quads = hn::Add(quads, population(any));
      sum_[0] = hn::Add(sum_[0], population(mask));
      sum_[2] = hn::Add(sum_[2], population(full));
    }
    sum_[1] = hn::Add(sum_[1], quads);
    if (task_.stream != nullptr) {
      hn::Store(quads, Tag(), quads_[q]);
    }
  }

  /// Where the tiles are: in the image, in SurfaceTiles and in the z cache.
  HWY_INLINE void locate(unsigned q, Vector tile_x, Vector tile_y) {
    const Tag tag;
    const SurfaceTiles& tiles = *task_.tiles;
    const BlockCache& cache = *task_.cache;
    const auto number = [](auto value) { return set(static_cast<std::int32_t>(value)); };
    const Vector block_x = hn::ShiftRightSame(tile_x, tiles.block_shift);
    const Vector block_y = hn::ShiftRightSame(tile_y, tiles.block_shift);
    const Vector in_block = number((1u << tiles.block_shift) - 1);
    const Vector inside =
        hn::Add(hn::ShiftLeftSame(hn::And(tile_y, in_block), tiles.block_shift), hn::And(tile_x, in_block));
    const Vector thread = hn::And(block_x, number((1u << tiles.thread_shift) - 1));
    const Vector block =
        hn::Add(hn::Add(hn::Mul(thread, number(tiles.of_thread)), hn::Mul(block_y, number(tiles.across))),
                hn::ShiftRightSame(block_x, tiles.thread_shift));
    const Vector set_of_block =
        hn::Or(hn::ShiftLeftSame(hn::And(block_x, number(cache.x_mask)), cache.y_bits),
               hn::And(block_y, number(cache.y_mask)));
    hn::Store(hn::Add(hn::Mul(tile_y, set(task_.surface->codes.tiles_x())), tile_x), tag, found.tile[q]);
    hn::Store(block, tag, found.block[q]);
    hn::Store(hn::Add(hn::Mul(block, number(tiles.entries)), inside), tag, found.at[q]);
    hn::Store(
        hn::Add(hn::Mul(set_of_block, number(cache.of_block)), hn::Add(inside, number(BlockCache::kGap))),
        tag, found.entry[q]);
  }

  /// Returns the blocks after the last job.
  std::uint32_t tell_jobs(std::size_t lane, StreamWriter& stream) const {
    const auto is_set = [lane](std::uint32_t lanes) { return (lanes >> lane & 1) != 0; };
    std::uint32_t empty = 0;
    std::size_t last_block = 4;
    bool has_job = true;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t q = found.tile_in_order(lane, i);
      if (!is_set(decided_[q])) {
        continue;
      }
      const std::size_t block = (is_set(two_x_) ? q & 1 : 0) | (is_set(two_y_) ? q & 2 : 0);
      if (block != last_block) {
        empty += has_job ? 0 : 1;
        has_job = false;
        last_block = block;
      }
      if (is_set(jobs_[q])) {
        if (!has_job) {
          stream.block(empty);
          empty = 0;
          has_job = true;
        }
        stream.job(is_set(found.covered[q]) ? quads_[q][lane] : 0);
      }
    }
    return empty + (has_job ? 0 : 1);
  }

  const RasterTask& task_;
  Counters& counters_;
  Tallies& tallies_;
  const int block_shift_;

  const SetUpTriangles* in_ = nullptr;
  std::size_t first_ = 0;
  std::uint32_t all_ = 0;
  Vector x_first_;
  Vector y_first_;
  Vector x_last_;
  Vector y_last_;
  Vector a_[3];
  Vector b_[3];
  Vector e_[3];  ///< at the window's first sample
  Vector inside_[kWords];

  std::array<std::uint32_t, 2> own_{};
  // Of the walk, for the stream: bits of lanes.
  std::uint32_t two_x_ = 0;                 ///< with two blocks in a row
  std::uint32_t two_y_ = 0;                 ///< and in a column
  std::array<std::uint32_t, 4> decided_{};  ///< tiles within bounds
  std::array<std::uint32_t, 4> jobs_{};     ///< of these, not rejected
  alignas(64) std::int32_t quads_[4][kWidth];

  // Since the last tally(): fragments, quads, full quads.
  Vector sum_[3] = {hn::Zero(Tag()), hn::Zero(Tag()), hn::Zero(Tag())};
};

}  // namespace
}  // namespace halfspace::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
