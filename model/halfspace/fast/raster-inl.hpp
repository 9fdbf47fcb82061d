// Without a guard that stops a second inclusion: once for each target of Highway.
#if defined(HALFSPACE_FAST_RASTER_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HALFSPACE_FAST_RASTER_INL
#undef HALFSPACE_FAST_RASTER_INL
#else
#define HALFSPACE_FAST_RASTER_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "halfspace/fast/early_z-inl.hpp"
#include "halfspace/fast/raster.hpp"
#include "halfspace/fast/small-inl.hpp"
#include "halfspace/fast/tallies.hpp"
#include "halfspace/fast/walk-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace halfspace::fast::HWY_NAMESPACE {
namespace {

template <int TileSize>
class Raster {
 public:
  explicit Raster(const RasterTask& task)
      : task_(task),
        walk_(task, tallies_),
        early_z_(task, tallies_),
        small_(task, tallies_),
        middle_(task, tallies_),
        takes_small_(takes_small(task)) {}

  void triangles(const SetUpTriangles& in) {
    const auto flush = [this] { test(true); };
    for (std::size_t i = 0; i < in.count;) {
      const std::size_t room = std::min(static_cast<std::size_t>(kWidth), in.count - i);
      const auto run = [&](std::uint32_t lanes) {
        return std::min(static_cast<std::size_t>(std::countr_one(lanes)), room);
      };
      const std::size_t small = takes_small_ ? run(Windows<TileSize, TileSize>::among(in, i)) : 0;
      if (small >= kFewSmall) {
        test(false);
        if (run(Windows<TileSize, 4>::among(in, i)) >= small) {
          small_.triangles(in, i, small);
        } else {
          middle_.triangles(in, i, small);
        }
        i += small;
        continue;
      }
      for (const std::size_t end = i + std::max<std::size_t>(small, 1); i < end; ++i) {
        one(in, i, flush);
      }
    }
    test(false);
    small_.tally();
    middle_.tally();
    tallies_.add_to(*task_.draw, Walk<TileSize>::kSamples / 4);
  }

 private:
  /// Fewer in a row are drawn one by one.
  static constexpr std::size_t kFewSmall = std::min(4, kWidth);

  template <class Flush>
  HWY_INLINE void one(const SetUpTriangles& in, std::size_t i, Flush&& flush) {
    if (triangle_count_ == triangles_.size()) {
      test(false);
      triangle_count_ = 0;
    }
    Triangle& t = triangles_[triangle_count_++];
    load_edges<TileSize>(in, i, task_.walker.block_size, t);
    load_depth<TileSize>(in, i, task_, t);
    StreamWriter* const stream = task_.stream;
    if (stream != nullptr) {
      stream->drawn(static_cast<std::uint32_t>(in.order[i]));
    }
    const std::uint32_t empty_after = walk_.triangle(t, flush);
    if (stream != nullptr) {
      stream->walked(empty_after);
    }
  }

  /// early_z of all visits: then what the stream says of jobs and of accesses belongs together.
  void test(bool in_triangle) {
    for (std::size_t i = 0; i < walk_.visits(); ++i) {
      early_z_.visit(walk_.visit(i), walk_.masks(walk_.visit(i)));
    }
    walk_.clear();
    if (task_.stream != nullptr && task_.stream->full()) {
      task_.stream->give(in_triangle, nullptr);
    }
  }

  const RasterTask& task_;
  Walk<TileSize> walk_;
  Tallies tallies_;
  EarlyZ<TileSize> early_z_;
  Small<TileSize, 4> small_;
  Small<TileSize, TileSize> middle_;  ///< the same where tiles are as small
  bool takes_small_;
  std::array<Triangle, Walk<TileSize>::kMostTriangles> triangles_;
  std::size_t triangle_count_ = 0;
};

inline void raster_4(const RasterTask& task, const SetUpTriangles& triangles) {
  Raster<4>(task).triangles(triangles);
}
inline void raster_8(const RasterTask& task, const SetUpTriangles& triangles) {
  Raster<8>(task).triangles(triangles);
}

template <int TileSize>
void resolve_tiles(int sub_pixel_bits, Columns columns, Surface& surface, SurfaceTiles& tiles) {
  const int side = 1 << tiles.block_shift;
  for (std::uint32_t block = 0; block < tiles.blocks; ++block) {
    block = std::min(tiles.next_used(tiles.opened.get(), block), tiles.next_used(tiles.bounded.get(), block));
    if (block == tiles.blocks) {
      break;
    }
    const SurfaceTiles::Tile first = tiles.first_tile(block);
    const bool is_cleared = !tiles.is_open(block) && !tiles.is_bounded(block);
    if (is_cleared || !columns.has(static_cast<std::uint32_t>(first.x / side))) {
      continue;
    }
    tiles.open(block);
    for (int i = 0; i < side * side; ++i) {
      std::uint32_t& plane = tiles.plane[block * tiles.entries + static_cast<std::size_t>(i)];
      if (plane != kResolved) {
        const int x = first.x + i % side;
        const int y = first.y + i / side;
        make_codes<TileSize>(tiles.plane_of(plane), tiles, surface.format, sub_pixel_bits, x, y,
                             surface.codes.tile(x, y));
        plane = kResolved;
      }
    }
  }
}

inline void resolve_4(int sub_pixel_bits, Columns columns, Surface& surface, SurfaceTiles& tiles) {
  resolve_tiles<4>(sub_pixel_bits, columns, surface, tiles);
}
inline void resolve_8(int sub_pixel_bits, Columns columns, Surface& surface, SurfaceTiles& tiles) {
  resolve_tiles<8>(sub_pixel_bits, columns, surface, tiles);
}

}  // namespace
}  // namespace halfspace::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
