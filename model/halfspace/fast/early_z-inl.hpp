// Without a guard that stops a second inclusion: once for each target of Highway.
#if defined(HALFSPACE_FAST_EARLY_Z_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HALFSPACE_FAST_EARLY_Z_INL
#undef HALFSPACE_FAST_EARLY_Z_INL
#else
#define HALFSPACE_FAST_EARLY_Z_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "halfspace/fast/block_cache-inl.hpp"
#include "halfspace/fast/codes-inl.hpp"
#include "halfspace/fast/raster.hpp"
#include "halfspace/fast/tallies.hpp"
#include "halfspace/fast/walk-inl.hpp"
#include "halfspace/machine/passage/z_lookup.hpp"
#include "halfspace/units/z_test.hpp"

HWY_BEFORE_NAMESPACE();
namespace halfspace::fast::HWY_NAMESPACE {
namespace {

/// early_z and what follows it.
template <int TileSize>
class EarlyZ {
 public:
  static constexpr int kSamples = TileSize * TileSize;
  static constexpr std::uint64_t kAll = ~std::uint64_t{0} >> (64 - kSamples);
  static constexpr int kBands = stream_bands(TileSize);

  EarlyZ(const RasterTask& task, Tallies& tallies)
      : task_(task),
        draw_(*task.draw),
        state_(task.draw->early_z),
        counters_(tallies.counters),
        tallies_(tallies),
        tiles_(task.tiles),
        block_size_(task.walker.block_size),
        block_tiles_(task.walker.block_size / TileSize),
        tile_shift_(std::countr_zero(static_cast<unsigned>(block_tiles_))),
        group_rows_(std::min(kLanes / block_tiles_, block_tiles_)),
        groups_(block_tiles_ / group_rows_),
        all_tiles_(static_cast<std::uint16_t>((1u << block_tiles_ * group_rows_) - 1)),
        is_float_(task.draw->early_z.format == DepthFormat::kFloat32),
        fraction_(vertex_depth_fraction(task.draw->early_z.format)),
        ordered_(is_ordered(task.draw->early_z.func)),
        flip_(state_.func == DepthFunc::kGreater || state_.func == DepthFunc::kGequal ? -1 : 0),
        inclusive_(state_.func == DepthFunc::kLequal || state_.func == DepthFunc::kGequal ? 1 : 0),
        touches_depth_(touches_depth(task.draw->early_z)),
        tells_accesses_(touches_depth_ && task.stream != nullptr && task.stream->wants_accesses()),
        counts_parts_(touches_depth_ && (task.z_parts > 1 || task.tile_cache != nullptr)) {}

  /// `masks`: of the partial tiles.
  HWY_INLINE void visit(const Visit& visit, const std::uint64_t* masks) {
    if (visit.blocks == 0) {
      tiles(visit, masks);
    } else {
      blocks(visit);
    }
  }

 private:
  /// Blocks that are covered whole. Those all of whose samples die, or pass, need no tile.
  HWY_NOINLINE void blocks(const Visit& row) {
    Triangle& t = *row.triangle;
    const std::uint32_t x = row.block_x + static_cast<std::uint32_t>(std::countr_zero(row.blocks));
    const int stride = static_cast<int>(task_.columns.mask + 1);
    Visit visit;
    visit.triangle = row.triangle;
    visit.block_y = row.block_y;
    visit.partial = 0;
    Outcome sure;
    CodeRange range;
    if (t.kind != DepthKind::kNone) {
      const std::uint32_t first = tiles_->block(x, row.block_y);
      for (std::uint32_t i = 0; i < ones(row.blocks); ++i) {
        bound(first + i);
      }
      block_code_range(t, static_cast<int>(x) * block_size_, static_cast<int>(row.block_y) * block_size_,
                       stride * block_size_, is_float_, range);
      sure = outcome(state_.func, hn::Load(Tag(), range.low), hn::Load(Tag(), range.high),
                     tiles_->block_min.get() + first, tiles_->block_max.get() + first);
      sure.passed = can_pass_whole(t) ? sure.passed & ~sure.killed : 0;
    }
    for (std::uint32_t i = 0; i < ones(row.blocks); ++i) {
      visit.block_x = x + i * static_cast<std::uint32_t>(stride);
      const bool passes = (sure.passed >> i & 1) != 0;
      if (passes && state_.write) {
        tiles_->become_plane(tiles_->block(visit.block_x, visit.block_y), plane_number(t), range.low[i],
                             range.high[i]);
      }
      const bool is_sure = passes || (sure.killed >> i & 1) != 0;
      for (int group = 0; group < groups_; ++group) {
        visit.group = static_cast<std::uint32_t>(group);
        visit.whole = all_tiles_;
        if (is_sure) {
          sure_tiles(visit, passes ? all_tiles_ : 0);
        } else {
          open_tiles(visit);
        }
      }
    }
  }

  /// Tiles of a block that is covered whole, of which it is known that those in `passed` pass and the others
  /// die.
  HWY_INLINE void sure_tiles(const Visit& visit, std::uint32_t passed) {
    begin(visit);
    tallies_.survivors += ones(passed) * kSamples;
    decided_whole(visit.whole, passed);
    finish(visit.whole, passed);
  }

  /// Tiles of a block that is covered whole, of which nothing is known.
  HWY_INLINE void open_tiles(Visit& visit) {
    if (visit.triangle->kind != DepthKind::kNone) {
      code_range(*visit.triangle, static_cast<int>(visit.block_x) * block_size_,
                 static_cast<int>(visit.block_y) * block_size_ +
                     static_cast<int>(visit.group) * group_rows_ * TileSize,
                 is_float_, visit.range);
    }
    tiles(visit, nullptr);
  }

  /// Makes sure that the bounds of a block hold.
  HWY_INLINE void bound(std::uint32_t block) {
    if (tiles_->is_bounded(block)) {
      return;
    }
    if (!tiles_->is_open(block)) {
      tiles_->become_plane(block, kResolved, tiles_->cleared_to, tiles_->cleared_to);
      return;
    }
    const Tag tag;
    const std::int32_t* const z_min = tiles_->z_min.get() + block * tiles_->entries;
    const std::int32_t* const z_max = tiles_->z_max.get() + block * tiles_->entries;
    Vector least = hn::LoadU(tag, z_min);
    Vector most = hn::LoadU(tag, z_max);
    // Entries behind the last tile of a small block are what it began with.
    for (std::size_t i = kWidth; i < tiles_->entries; i += kWidth) {
      least = hn::Min(least, hn::LoadU(tag, z_min + i));
      most = hn::Max(most, hn::LoadU(tag, z_max + i));
    }
    tiles_->bound(block, hn::GetLane(hn::MinOfLanes(tag, least)), hn::GetLane(hn::MaxOfLanes(tag, most)));
  }

  HWY_INLINE void tiles(const Visit& visit, const std::uint64_t* masks) {
    const std::uint32_t touched = visit.whole | visit.partial;
    begin(visit);
    if (tiles_ != nullptr) {
      tiles_->open(block_);
      if (task_.counts_pixels) {
        tiles_->open_counts(block_);
      }
    }
    Passed passed;
    if (visit.triangle->kind == DepthKind::kNone) {
      decided_whole(visit.whole, visit.whole);
      tallies_.survivors += ones(visit.whole) * kSamples;
      passed.some =
          visit.whole | partial_tiles(visit.partial, masks, [](int, std::uint64_t mask) { return mask; });
    } else {
      passed = test(*visit.triangle, visit, masks);
      if (passed.some != 0 && state_.write) {
        tiles_->change(block_);
      }
    }
    finish(touched, passed.some);
  }

  /// `passed`: tiles of which a sample did.
  HWY_INLINE void finish(std::uint32_t touched, std::uint32_t passed) {
    if (touches_depth_) {
      look_up(touched, state_.write ? passed : 0);
      if (tells_accesses_) {
        tell_accesses(touched);
      }
    }
    counters_.early_z.tiles_killed += ones(touched & ~passed);
  }

  struct Passed {
    std::uint32_t whole = 0;  ///< tiles all of whose samples passed, of those that are covered whole
    std::uint32_t some = 0;   ///< tiles of which a sample passed
  };

  HWY_INLINE void begin(const Visit& visit) {
    first_x_ = static_cast<int>(visit.block_x) << tile_shift_;
    first_y_ = (static_cast<int>(visit.block_y) << tile_shift_) + static_cast<int>(visit.group) * group_rows_;
    number_ = visit.triangle->number;
    if (tiles_ == nullptr) {
      return;
    }
    block_ = tiles_->block(visit.block_x, visit.block_y);
    at_ = block_ * tiles_->entries + visit.group * kLanes;
    if (task_.cache == nullptr) {
      return;
    }
    place_ = task_.cache->place(task_.cached, block_, visit.block_x, visit.block_y, visit.group);
  }

  [[nodiscard]] int tile_x(int lane) const { return first_x_ + (lane & (block_tiles_ - 1)); }
  [[nodiscard]] int tile_y(int lane) const { return first_y_ + (lane >> tile_shift_); }

  /// Calls test(lane, mask) for partial tiles, which returns what passed. Returns the tiles of which some
  /// did.
  template <class Test>
  HWY_INLINE std::uint32_t partial_tiles(std::uint32_t partial, const std::uint64_t* masks, Test&& test) {
    std::uint32_t some = 0;
    for (std::uint32_t left = partial; left != 0; left &= left - 1, ++masks) {
      const int lane = std::countr_zero(left);
      const std::uint64_t passed = test(lane, *masks);
      tested(lane, *masks, passed);
      some |= (passed != 0 ? 1u : 0u) << lane;
    }
    return some;
  }

  /// A tile has been tested.
  HWY_INLINE void tested(int lane, std::uint64_t mask, std::uint64_t passed) {
    tallies_.survivors += ones(passed);
    note(lane, mask, passed);
    if (task_.counts_pixels) {
      const std::size_t at = at_ + static_cast<std::size_t>(lane);
      tiles_->fragments.add(at, mask);
      if (passed != 0) {
        tiles_->survivors.add(at, passed);
      }
    }
  }

  /// What the z cache and who watches must know of a tile.
  HWY_INLINE void note(int lane, std::uint64_t mask, std::uint64_t passed) {
    if (counts_parts_) {
      touched_parts_[static_cast<std::size_t>(lane)] = parts_of_mask<TileSize>({{mask}}, task_.z_parts);
      written_parts_[static_cast<std::size_t>(lane)] = parts_of_mask<TileSize>({{passed}}, task_.z_parts);
    }
    if (tells_accesses_) {
      const std::uint64_t written = state_.write ? passed : 0;
      touched_bands_[static_cast<std::size_t>(lane)] = parts_of_mask<TileSize>({{mask}}, kBands);
      written_bands_[static_cast<std::size_t>(lane)] = parts_of_mask<TileSize>({{written}}, kBands);
    }
    if (draw_.keeps_visible && passed != 0) {
      show(lane, passed);
    }
  }

  // ---- test ----

  HWY_INLINE Passed test(Triangle& t, const Visit& visit, const std::uint64_t* masks) {
    const CodeRange& range = visit.range;
    const Outcome sure = outcome(state_.func, range, *tiles_, at_);
    const std::uint32_t killed = sure.killed;
    const std::uint32_t passed = sure.passed;
    const std::uint32_t whole = visit.whole;
    Passed result;
    result.whole = can_pass_whole(t) ? whole & passed & ~killed : 0;
    if (result.whole != 0 && state_.write) {
      become_plane(t, result.whole, range);
    }
    tallies_.survivors += ones(result.whole) * kSamples;
    decided_whole(whole & (killed | result.whole), result.whole);
    result.some = result.whole;
    for (std::uint32_t open = whole & ~(killed | result.whole); open != 0; open &= open - 1) {
      const std::uint64_t all = kAll;
      result.some |=
          partial_tiles(open & -open, &all, [&](int lane, std::uint64_t mask) HWY_ATTR HALFSPACE_INLINED {
            return test_tile(t, lane, mask, range);
          });
    }
    const std::uint32_t passed_unwritten = state_.write ? 0 : passed;
    result.some |= partial_tiles(
        visit.partial, masks, [&](int lane, std::uint64_t mask) HWY_ATTR HALFSPACE_INLINED -> std::uint64_t {
          if ((killed >> lane & 1) != 0) {
            return 0;
          }
          return (passed_unwritten >> lane & 1) != 0 ? mask : test_tile(t, lane, mask, range);
        });
    return result;
  }

  /// A plane that nobody can resolve later is tested like any.
  [[nodiscard]] HWY_INLINE bool can_pass_whole(const Triangle& t) const {
    return !state_.write || t.kind != DepthKind::kUnits || state_.interpolator == DepthInterpolator::kPlane;
  }

  /// Tiles that are covered whole, and all of whose samples die, or pass.
  HWY_INLINE void decided_whole(std::uint32_t tiles, std::uint32_t passed) {
    if (task_.counts_pixels && tiles != 0) {
      tiles_->open_counts(block_);
      count_tiles_whole(tiles, tiles_->whole_fragments.get() + at_);
      count_tiles_whole(passed, tiles_->whole_survivors.get() + at_);
    }
    if (!draw_.keeps_visible && !counts_parts_ && !tells_accesses_) {
      return;
    }
    for (std::uint32_t left = tiles; left != 0; left &= left - 1) {
      const int lane = std::countr_zero(left);
      note(lane, kAll, (passed >> lane & 1) != 0 ? kAll : 0);
    }
  }

  /// Adds 1 to each of the pixels of tiles, when the counts are put together.
  static HWY_INLINE void count_tiles_whole(std::uint32_t lanes, std::int32_t* counts) {
    const Tag tag;
    for (int i = 0; i < kLanes; i += kWidth) {
      const Vector count = hn::Load(tag, counts + i);
      hn::Store(hn::Add(count, hn::IfThenElseZero(mask_of(lanes >> i), set(1))), tag, counts + i);
    }
  }

  /// The codes of tiles are those of the triangle's plane.
  HWY_INLINE void become_plane(Triangle& t, std::uint32_t lanes, const CodeRange& range) {
    const Tag tag;
    const Vector number = set(plane_number(t));
    for (int i = 0; i < kLanes; i += kWidth) {
      const auto mask = mask_of(lanes >> i);
      const std::size_t at = at_ + static_cast<std::size_t>(i);
      hn::BlendedStore(hn::Load(tag, range.low + i), mask, tag, tiles_->z_min.get() + at);
      hn::BlendedStore(hn::Load(tag, range.high + i), mask, tag, tiles_->z_max.get() + at);
      hn::BlendedStore(number, mask, tag, reinterpret_cast<std::int32_t*>(tiles_->plane.get()) + at);
    }
  }

  /// The triangle's number among the planes of the surface.
  std::uint32_t plane_number(Triangle& t) {
    if (t.plane_number == kResolved) {
      const DepthEquation* const equation = t.kind == DepthKind::kUnits ? &t.whole->depth : nullptr;
      t.plane_number = tiles_->add_plane(task_.columns.own, t.plane, equation);
    }
    return t.plane_number;
  }

  HWY_INLINE std::uint64_t test_tile(const Triangle& t, int lane, std::uint64_t mask,
                                     const CodeRange& range) {
    const std::size_t at = at_ + static_cast<std::size_t>(lane);
    const int x = tile_x(lane);
    const int y = tile_y(lane);
    std::uint32_t* const stored = task_.surface->codes.tile(x, y);
    if (tiles_->plane[at] != kResolved) [[unlikely]] {
      make_codes<TileSize>(tiles_->plane_of(tiles_->plane[at]), *tiles_, state_.format, state_.sub_pixel_bits,
                           x, y, stored);
      tiles_->plane[at] = kResolved;
    }
    if (ordered_ && t.kind != DepthKind::kUnits) {
      return state_.write ? in_order(t, lane, mask, stored, range) : by_vectors<false>(t, x, y, mask, stored);
    }
    const std::uint64_t passed = t.kind == DepthKind::kUnits ? by_units(t, x, y, mask, stored)
                                 : state_.write              ? by_vectors<true>(t, x, y, mask, stored)
                                                             : by_vectors<false>(t, x, y, mask, stored);
    if (passed != 0 && state_.write) {
      const auto [least, most] = std::minmax_element(stored, stored + kSamples, is_nearer);
      tiles_->z_min[at] = code_order(*least);
      tiles_->z_max[at] = code_order(*most);
    }
    return passed;
  }

  /// An ordered test that writes. Codes are turned, by flip_, so that less passes.
  HWY_INLINE std::uint64_t in_order(const Triangle& t, int lane, std::uint64_t mask, std::uint32_t* codes,
                                    const CodeRange& range) {
    const Tag tag;
    auto* const stored = reinterpret_cast<std::int32_t*>(codes);
    const Vector flip = set(flip_);
    const Vector inclusive = set(inclusive_);
    std::uint64_t passed = 0;
    Vector farthest = set(INT32_MIN);
    for_codes<TileSize>(t, tile_x(lane), tile_y(lane), fraction_, [&](int i, Vector code) HWY_ATTR {
      const Vector old = hn::LoadU(tag, stored + i);
      const Vector turned = hn::Xor(old, flip);
      const auto pass = hn::And(hn::Lt(hn::Xor(code, flip), hn::Add(turned, inclusive)), mask_of(mask >> i));
      const Vector now = hn::IfThenElse(pass, code, old);
      hn::StoreU(now, tag, stored + i);
      farthest = hn::Max(farthest, hn::Xor(now, flip));
      passed |= std::uint64_t{bits_of(pass)} << i;
    });
    if (passed != 0) {
      const std::int32_t far = hn::GetLane(hn::MaxOfLanes(tag, farthest)) ^ flip_;
      const std::size_t at = at_ + static_cast<std::size_t>(lane);
      std::int32_t& least = tiles_->z_min[at];
      std::int32_t& most = tiles_->z_max[at];
      least = flip_ == 0 ? std::min(least, range.low[lane]) : far;
      most = flip_ == 0 ? far : std::max(most, range.high[lane]);
    }
    return passed;
  }

  /// Any test but kNever, on a triangle with vectors for its codes.
  template <bool Write>
  std::uint64_t by_vectors(const Triangle& t, int x, int y, std::uint64_t mask, std::uint32_t* codes) const {
    const Tag tag;
    auto* const stored = reinterpret_cast<std::int32_t*>(codes);
    std::uint64_t passed = 0;
    for_codes<TileSize>(t, x, y, fraction_, [&](int i, Vector code) HWY_ATTR {
      const Vector old = hn::LoadU(tag, stored + i);
      const auto pass = hn::And(compare(state_.func, code, old), mask_of(mask >> i));
      if (Write) {
        hn::StoreU(hn::IfThenElse(pass, code, old), tag, stored + i);
      }
      passed |= std::uint64_t{bits_of(pass)} << i;
    });
    return passed;
  }

  std::uint64_t by_units(const Triangle& t, int x, int y, std::uint64_t mask, std::uint32_t* stored) const {
    QuadBurst burst;
    burst.coverage = {.slot = 0,
                      .tile_x = static_cast<std::uint16_t>(x),
                      .tile_y = static_cast<std::uint16_t>(y),
                      .e = {},
                      .mask = {{mask}}};
    for (std::size_t i = 0; i < 2; ++i) {
      const Edge& edge = t.whole->edge[i + 1];
      burst.coverage.e[i] = edge.c + ((std::int64_t{edge.a} * x + std::int64_t{edge.b} * y) * TileSize
                                      << state_.sub_pixel_bits);
    }
    TileCodes<TileSize> codes;
    return halfspace::z_test<TileSize>(*t.whole, burst, state_, stored, codes).word[0];
  }

  // ---- z cache ----

  HWY_INLINE void look_up(std::uint32_t touched, std::uint32_t written) {
    EarlyZCounters& counters = counters_.early_z;
    if (task_.tile_cache != nullptr) {
      look_up_tiles(touched, written);
      return;
    }
    counters.z_bursts += ones(touched);
    if (!counts_parts_) {
      access_lines(*task_.cache, place_, 0, touched, written, counters, task_.stream);
      if (task_.stream != nullptr) {
        task_.stream->accessed(static_cast<std::uint32_t>(ones(touched)));
      }
      return;
    }
    if (task_.stream != nullptr) {
      tell_parts(touched, written);
      return;
    }
    for (int part = 0; part < task_.z_parts; ++part) {
      std::uint32_t here = 0;
      std::uint32_t changed = 0;
      for (std::uint32_t left = touched; left != 0; left &= left - 1) {
        const int lane = std::countr_zero(left);
        here |= (touched_parts_[static_cast<std::size_t>(lane)] >> part & 1u) << lane;
        changed |= (written_parts_[static_cast<std::size_t>(lane)] >> part & 1u) << lane;
      }
      if (here != 0) {
        access_lines(*task_.cache, place_, part, here, changed & written, counters, nullptr);
      }
    }
  }

  /// Part by part, in the order of the stream.
  void tell_parts(std::uint32_t touched, std::uint32_t written) {
    for (std::uint32_t left = touched; left != 0; left &= left - 1) {
      const int lane = std::countr_zero(left);
      const auto i = static_cast<std::size_t>(lane);
      const unsigned changed = (written >> lane & 1) != 0 ? written_parts_[i] : 0;
      access_parts(*task_.cache, place_, lane, touched_parts_[i], changed, counters_.early_z, task_.stream);
    }
  }

  /// In a cache whose sets the tiles of a block compete for.
  void look_up_tiles(std::uint32_t touched, std::uint32_t written) {
    for (std::uint32_t left = touched; left != 0; left &= left - 1) {
      const int lane = std::countr_zero(left);
      const std::uint8_t parts = touched_parts_[static_cast<std::size_t>(lane)];
      const std::uint8_t changed =
          (written >> lane & 1) != 0 ? written_parts_[static_cast<std::size_t>(lane)] : std::uint8_t{0};
      const ZMisses misses = task_.tile_cache->access(task_.place, static_cast<std::uint32_t>(tile_x(lane)),
                                                      static_cast<std::uint32_t>(tile_y(lane)),
                                                      {.touched = parts, .written = changed});
      passage::count_z_cache(counters_.early_z, parts, misses);
      if (task_.stream != nullptr) {
        task_.stream->accessed(misses.parts());
      }
    }
  }

  /// Of the visit's bursts, in the order of their jobs.
  void tell_accesses(std::uint32_t touched) {
    for (std::uint32_t left = touched; left != 0; left &= left - 1) {
      const int lane = std::countr_zero(left);
      task_.stream->access(
          {static_cast<std::uint32_t>(tile_x(lane)), static_cast<std::uint32_t>(tile_y(lane)),
           touched_bands_[static_cast<std::size_t>(lane)], written_bands_[static_cast<std::size_t>(lane)]});
    }
  }

  // ---- who watches ----

  /// The triangle is seen at samples.
  void show(int lane, std::uint64_t passed) {
    const std::uint32_t shown = draw_.is_clear() ? kNothingVisible : draw_.first_triangle + number_;
    auto* const visible =
        reinterpret_cast<std::int32_t*>(task_.surface->visible.tile(tile_x(lane), tile_y(lane)));
    for (int i = 0; i < kSamples; i += kWidth) {
      hn::BlendedStore(set(shown), mask_of(passed >> i), Tag(), visible + i);
    }
  }

  const RasterTask& task_;
  const DrawContext& draw_;
  const EarlyZState& state_;
  Counters& counters_;
  Tallies& tallies_;
  SurfaceTiles* const tiles_;
  const int block_size_;
  const int block_tiles_;
  const int tile_shift_;
  const int group_rows_;
  const int groups_;
  const std::uint16_t all_tiles_;  ///< of a group
  const bool is_float_;
  const int fraction_;
  const bool ordered_;
  const std::int32_t flip_;
  const std::int32_t inclusive_;
  const bool touches_depth_;
  const bool tells_accesses_;
  const bool counts_parts_;  ///< of a tile, where it is not one line of a BlockCache

  // Of the visit.
  int first_x_ = 0;  ///< tile of lane 0
  int first_y_ = 0;
  std::uint32_t block_ = 0;
  std::size_t at_ = 0;  ///< of lane 0, in SurfaceTiles
  CachePlace place_;
  std::uint32_t number_ = 0;  ///< of the triangle
  std::array<std::uint8_t, kLanes> touched_parts_{};
  std::array<std::uint8_t, kLanes> written_parts_{};
  std::array<std::uint8_t, kLanes> touched_bands_{};  ///< of StreamAccess
  std::array<std::uint8_t, kLanes> written_bands_{};
};

}  // namespace
}  // namespace halfspace::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
