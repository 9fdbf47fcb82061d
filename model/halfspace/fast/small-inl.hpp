// Without a guard that stops a second inclusion: once for each target of Highway.
#if defined(HALFSPACE_FAST_SMALL_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HALFSPACE_FAST_SMALL_INL
#undef HALFSPACE_FAST_SMALL_INL
#else
#define HALFSPACE_FAST_SMALL_INL
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "halfspace/fast/block_cache.hpp"
#include "halfspace/fast/codes-inl.hpp"
#include "halfspace/fast/raster.hpp"
#include "halfspace/fast/tallies.hpp"
#include "halfspace/fast/window_depth-inl.hpp"
#include "halfspace/fast/windows-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace halfspace::fast::HWY_NAMESPACE {
namespace {

/// Draws whose small triangles Small takes: what watches is shown fragments that are tested, and neither sums
/// nor accesses are kept.
HWY_INLINE bool takes_small(const RasterTask& task) {
  const EarlyZState& state = task.draw->early_z;
  const bool watches = task.counts_pixels || task.draw->keeps_visible;
  const bool keeps_more =
      task.draw->sums != nullptr || (task.stream != nullptr && task.stream->wants_accesses());
  return task.tile_cache == nullptr && task.z_parts == 1 && !keeps_more &&
         (!watches || (state.test && state.func != DepthFunc::kNever));
}

/// Small triangles, one a lane: all stages of the pipe at once. Each is within a window of Side x Side
/// samples.
template <int TileSize, int Side>
class Small {
 public:
  explicit Small(const RasterTask& task, Tallies& tallies)
      : task_(task),
        state_(task.draw->early_z),
        counters_(tallies.counters),
        tallies_(tallies),
        windows_(task, tallies),
        found_(windows_.found),
        depth_(task.draw->early_z),
        touches_depth_(touches_depth(task.draw->early_z)) {}

  /// Adds what was counted in vectors to the tallies.
  void tally() { windows_.tally(); }

  /// Draws `count` small triangles, at most kWidth.
  void triangles(const SetUpTriangles& in, std::size_t first, std::size_t count) {
    in_ = &in;
    first_ = first;
    windows_.look_at(in, first, count);
    if (task_.stream != nullptr) {
      windows_.tell(*task_.stream);
    }
    if (found_.hit == 0) {
      return;
    }
    list_bursts();
    if (state_.func == DepthFunc::kNever && state_.test) {
      alive_ = 0;
    } else if (state_.test) {
      depth_.load(in, first);
      test();
    } else {
      pass_all();
    }
    finish();
  }

 private:
  // ---- early_z ----

  /// Calls visit(id, tile of the window, lane) for bits of bursts.
  template <class Visit>
  static HWY_INLINE void for_bursts(std::uint64_t bits, Visit&& visit) {
    for (std::uint64_t left = bits; left != 0; left &= left - 1) {
      const auto id = static_cast<std::size_t>(std::countr_zero(left));
      visit(id, id % 4, id / 4);
    }
  }

  /// A burst is a tile of a triangle of which a sample is covered.
  void list_bursts() {
    const Tag tag;
    fragments_ = 0;
    burst_bits_ = 0;
    for (unsigned q = 0; q < 4; ++q) {
      burst_bits_ |= every_fourth(found_.covered[q]) << q;
    }
    const Vector iota = hn::Iota(tag, 0);
    for_bursts(burst_bits_, [&](std::size_t id, std::size_t q, std::size_t lane) HWY_ATTR {
      // Its samples, with the burst.
      const Vector tagged = hn::Add(iota, set(static_cast<std::int32_t>(id << kSampleBits)));
      const std::uint64_t mask = mask_of_burst(q, lane);
      for (int i = 0; i < kSamples; i += kWidth) {
        const auto bits = static_cast<std::uint32_t>(mask >> i & ((1u << kWidth) - 1));
        hn::StoreU(hn::Compress(hn::Add(tagged, set(i)), mask_of(bits)), tag, fragment_ + fragments_);
        fragments_ += static_cast<std::size_t>(std::popcount(bits));
      }
      if (state_.test) {
        task_.tiles->open(static_cast<std::uint32_t>(found_.block[q][lane]));
        const int y = in_->y_first[first_ + lane] & ~1;
        const auto tile = static_cast<std::size_t>(found_.tile[q][lane]);
        const int first_y = y + std::countr_zero(mask) / Side;
        const int last_y = y + (63 - std::countl_zero(mask)) / Side;
        const auto at = static_cast<std::size_t>(found_.at[q][lane]);
        hwy::Prefetch(task_.tiles->plane.get() + at);
        hwy::Prefetch(task_.tiles->z_min.get() + at);
        hwy::Prefetch(task_.tiles->z_max.get() + at);
        prefetch(task_.surface->codes.tile(tile), first_y, last_y);
        if (task_.counts_pixels) {
          task_.tiles->open_counts(static_cast<std::uint32_t>(found_.block[q][lane]));
          hwy::Prefetch(task_.tiles->fragments.first_word(at));
          hwy::Prefetch(task_.tiles->survivors.first_word(at));
        }
      }
    });
  }

  /// Bit Side * y + x, of the window.
  [[nodiscard]] HWY_INLINE std::uint64_t mask_of_burst(std::size_t q, std::size_t lane) const {
    std::uint64_t mask = 0;
    for (std::size_t word = 0; word < WindowBatch<Side>::kWords; ++word) {
      mask |= std::uint64_t{static_cast<std::uint32_t>(found_.mask[q][word][lane])}
              << (word * WindowBatch<Side>::kRows * Side);
    }
    return mask;
  }

  /// The lines of the processor's cache that hold rows of a tile.
  template <class Value>
  static HWY_INLINE void prefetch(const Value* tile, int first_y, int last_y) {
    constexpr int kLineSamples = 64 / static_cast<int>(sizeof(Value));
    const int last = (last_y & (TileSize - 1)) * TileSize / kLineSamples;
    for (int line = (first_y & (TileSize - 1)) * TileSize / kLineSamples; line <= last; ++line) {
      hwy::Prefetch(tile + line * kLineSamples);
    }
  }

  /// Bit i becomes bit 4 i, of 16.
  static HWY_INLINE std::uint64_t every_fourth(std::uint64_t bits) {
    bits = (bits | bits << 24) & 0x000000FF000000FFu;
    bits = (bits | bits << 12) & 0x000F000F000F000Fu;
    bits = (bits | bits << 6) & 0x0303030303030303u;
    return (bits | bits << 3) & 0x1111111111111111u;
  }

  /// Without a test.
  void pass_all() {
    tallies_.survivors += fragments_;
    alive_ = burst_bits_;
  }

  /// `fragment`: the samples' numbers.
  HWY_INLINE WindowDepth::Fragments located(Vector fragment) const {
    const Tag tag;
    const Vector lane = hn::ShiftRight<kSampleBits + 2>(fragment);
    const auto of_lane = hn::IndicesFromVec(tag, lane);
    const Vector first_x = hn::TableLookupLanes(found_.x, of_lane);
    const Vector first_y = hn::TableLookupLanes(found_.y, of_lane);
    const Vector x = hn::Add(first_x, hn::And(fragment, set(Side - 1)));
    const Vector y = hn::Add(first_y, hn::And(hn::ShiftRight<kSampleBits / 2>(fragment), set(Side - 1)));
    const auto crosses = [&](Vector at, Vector first) HWY_ATTR {
      return hn::Ne(hn::And(hn::Xor(at, first), set(kAnchorSize)), hn::Zero(tag));
    };
    return {.lane = lane, .x = x, .y = y, .right = crosses(x, first_x), .below = crosses(y, first_y)};
  }

  /// Tests the fragments of all bursts, kWidth at a time.
  void test() {
    resolve_tiles();
    alive_ = 0;
    for (std::size_t i = 0; i < fragments_; i += static_cast<std::size_t>(kWidth)) {
      test_vector(i, std::min(static_cast<std::size_t>(kWidth), fragments_ - i));
    }
  }

  void resolve_tiles() {
    SurfaceTiles& tiles = *task_.tiles;
    for_bursts(burst_bits_, [&](std::size_t /*id*/, std::size_t q, std::size_t lane) HWY_ATTR {
      const auto at = static_cast<std::size_t>(found_.at[q][lane]);
      if (tiles.plane[at] != kResolved) [[unlikely]] {
        const int number = found_.tile[q][lane];
        const int across = task_.surface->codes.tiles_x();
        make_codes<TileSize>(tiles.plane_of(tiles.plane[at]), tiles, state_.format, state_.sub_pixel_bits,
                             number % across, number / across,
                             task_.surface->codes.tile(static_cast<std::size_t>(number)));
        tiles.plane[at] = kResolved;
      }
    });
  }

  HWY_INLINE void test_vector(std::size_t first, std::size_t count) {
    const Tag tag;
    constexpr int kTileShift = TileSize == 8 ? 3 : 2;
    const Vector inactive = set(fragment_[first]);  // of a tile that is ours to look at
    const auto active = hn::FirstN(tag, count);
    const Vector fragment = hn::IfThenElse(active, hn::LoadU(tag, fragment_ + first), inactive);
    const WindowDepth::Fragments at_samples = located(fragment);
    const auto lane = hn::IndicesFromVec(tag, at_samples.lane);
    const auto lane_field = [&](const SetUpTriangles::Field<std::int32_t>& values) HWY_ATTR {
      return hn::TableLookupLanes(Windows<TileSize, Side>::field(values, first_), lane);
    };
    const Vector any = depth_.codes(at_samples);
    const Vector code = hn::Min(hn::Max(any, lane_field(in_->low)), lane_field(in_->high));
    // Where it is stored.
    const Vector x = at_samples.x;
    const Vector y = at_samples.y;
    const Vector tile =
        hn::Add(hn::Mul(hn::ShiftRightSame(y, kTileShift), set(task_.surface->codes.tiles_x())),
                hn::ShiftRightSame(x, kTileShift));
    const Vector side = set(TileSize - 1);
    const Vector index = hn::Add(hn::ShiftLeftSame(tile, 2 * kTileShift),
                                 hn::Add(hn::ShiftLeftSame(hn::And(y, side), kTileShift), hn::And(x, side)));
    auto* const stored = reinterpret_cast<std::int32_t*>(task_.surface->codes.memory());
    alignas(64) std::int32_t at[kWidth];
    alignas(64) std::int32_t codes[kWidth];
    hn::Store(index, tag, at);
    hn::Store(code, tag, codes);
    if (conflicts(index, count)) {
      one_by_one(first, count, at, codes, stored);
      return;
    }
    const auto pass = hn::And(active, compare(state_.func, code, hn::GatherIndex(tag, stored, index)));
    const std::uint32_t bits = bits_of(pass);
    tallies_.survivors += ones(bits);
    for (std::uint32_t left = bits; left != 0; left &= left - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(left));
      passed(fragment_[first + i], at[i], codes[i], stored);
    }
    watch(first, count, bits, at);
  }

  HWY_INLINE void passed(std::int32_t fragment, std::int32_t at, std::int32_t code, std::int32_t* stored) {
    alive_ |= std::uint64_t{1} << (fragment >> kSampleBits);
    if (state_.write) {
      stored[at] = code;
    }
  }

  /// Whether two of the first lanes are equal.
  static HWY_INLINE bool conflicts(Vector index, std::size_t count) {
    const Tag tag;
    if (kWidth == 1) {
      return false;
    }
    alignas(64) std::int32_t twice[2 * kWidth];
    // Lanes behind the last differ from all others.
    const Vector own =
        hn::IfThenElse(hn::FirstN(tag, count), index, hn::Sub(hn::Zero(tag), hn::Iota(tag, 1)));
    hn::Store(own, tag, twice);
    hn::Store(own, tag, twice + kWidth);
    auto same = hn::FirstN(tag, 0);
    for (int i = 1; i <= kWidth / 2; ++i) {
      same = hn::Or(same, hn::Eq(own, hn::LoadU(tag, twice + i)));
    }
    return bits_of(same) != 0;
  }

  void one_by_one(std::size_t first, std::size_t count, const std::int32_t* at, const std::int32_t* codes,
                  std::int32_t* stored) {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (depth_passes(state_.func, static_cast<std::uint32_t>(codes[i]),
                       static_cast<std::uint32_t>(stored[at[i]]))) {
        bits |= 1u << i;
        passed(fragment_[first + i], at[i], codes[i], stored);
      }
    }
    tallies_.survivors += ones(bits);
    watch(first, count, bits, at);
  }

  // ---- what follows ----

  HWY_INLINE void watch(std::size_t first, std::size_t count, std::uint32_t bits, const std::int32_t* at) {
    if (task_.counts_pixels) {
      count_pixels(first, count, bits, at);
    }
    for (std::uint32_t left = task_.draw->keeps_visible ? bits : 0; left != 0; left &= left - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(left));
      const auto number = static_cast<std::uint32_t>(
          in_->number[first_ + static_cast<std::size_t>(fragment_[first + i] >> (kSampleBits + 2))]);
      task_.surface->visible.tile(static_cast<std::size_t>(at[i]) / (TileSize * TileSize))[sample_of(at[i])] =
          task_.draw->is_clear() ? kNothingVisible : task_.draw->first_triangle + number;
    }
  }

  /// Fragments of a burst lie together.
  void count_pixels(std::size_t first, std::size_t count, std::uint32_t bits, const std::int32_t* at) {
    SurfaceTiles& tiles = *task_.tiles;
    for (std::size_t i = 0; i < count;) {
      const std::int32_t burst = fragment_[first + i] >> kSampleBits;
      std::uint64_t covered = 0;
      std::uint64_t passed = 0;
      for (; i < count && fragment_[first + i] >> kSampleBits == burst; ++i) {
        const int sample = sample_of(at[i]);
        covered |= std::uint64_t{1} << sample;
        passed |= std::uint64_t{bits >> i & 1} << sample;
      }
      const auto tile = static_cast<std::size_t>(found_.at[burst % 4][burst / 4]);
      tiles.fragments.add(tile, covered);
      tiles.survivors.add(tile, passed);
    }
  }

  /// In its tile, given its place in the image.
  static int sample_of(std::int32_t at) { return at & (TileSize * TileSize - 1); }

  void finish() {
    counters_.early_z.tiles_killed += ones(burst_bits_ & ~alive_);
    if (!touches_depth_) {
      return;
    }
    counters_.early_z.z_bursts += ones(burst_bits_);
    SurfaceTiles& tiles = *task_.tiles;
    BlockCache& cache = *task_.cache;
    const auto look_up = [&](std::size_t id, std::size_t q, std::size_t lane) HWY_ATTR {
      const bool written = state_.write && (alive_ >> id & 1) != 0;
      if (written) {
        const auto at = static_cast<std::size_t>(found_.at[q][lane]);
        tiles.z_min[at] = std::min(tiles.z_min[at], in_->low[first_ + lane]);
        tiles.z_max[at] = std::max(tiles.z_max[at], in_->high[first_ + lane]);
        tiles.change(static_cast<std::uint32_t>(found_.block[q][lane]));
      }
      const std::uint32_t block = task_.cached.first + static_cast<std::uint32_t>(found_.block[q][lane]);
      const auto entry = static_cast<std::size_t>(found_.entry[q][lane]);
      const CachePlace place{.block = block,
                             .line_bytes = task_.cached.line_bytes,
                             .entry = entry & ~std::size_t{kLanes - 1},
                             .word = block * cache.groups + (entry / kLanes & (cache.groups - 1))};
      access_parts(cache, place, static_cast<int>(entry % kLanes), 1, written ? 1 : 0, counters_.early_z,
                   task_.stream);
    };
    if (task_.stream == nullptr || found_.columns_first == 0) {
      for_bursts(burst_bits_, look_up);
      return;
    }
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(kWidth); ++lane) {
      for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t q = found_.tile_in_order(lane, i);
        if (const std::size_t id = 4 * lane + q; (burst_bits_ >> id & 1) != 0) {
          look_up(id, q, lane);
        }
      }
    }
  }

  static constexpr int kSamples = Side * Side;
  static constexpr int kSampleBits = std::countr_zero(static_cast<unsigned>(kSamples));

  const RasterTask& task_;
  const EarlyZState& state_;
  Counters& counters_;
  Tallies& tallies_;
  Windows<TileSize, Side> windows_;
  const WindowBatch<Side>& found_;
  WindowDepth depth_;
  const bool touches_depth_;

  // Of the batch.
  const SetUpTriangles* in_ = nullptr;
  std::size_t first_ = 0;
  // Bursts are numbered 4 * lane + tile, their samples kSamples * burst + bit.
  std::uint64_t burst_bits_ = 0;
  std::uint64_t alive_ = 0;  ///< bursts of which a sample passed
  alignas(64) std::int32_t fragment_[kSamples * kLanes + kLanes];
  std::size_t fragments_ = 0;
};

}  // namespace
}  // namespace halfspace::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
