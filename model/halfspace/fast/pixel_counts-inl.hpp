// Without a guard that stops a second inclusion: once for each target of Highway.
#if defined(HALFSPACE_FAST_PIXEL_COUNTS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HALFSPACE_FAST_PIXEL_COUNTS_INL
#undef HALFSPACE_FAST_PIXEL_COUNTS_INL
#else
#define HALFSPACE_FAST_PIXEL_COUNTS_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>

#include "halfspace/fast/lanes-inl.hpp"
#include "halfspace/fast/surface_tiles.hpp"

HWY_BEFORE_NAMESPACE();
namespace halfspace::fast::HWY_NAMESPACE {
namespace {

/// Adds what was counted of a tile, and `whole` for all its pixels, to their values in an image.
template <int TileSize>
void put_counts(const PixelCounts& counts, std::size_t tile, std::int32_t whole,
                TiledImage<std::uint16_t>& image, int x, int y) {
  constexpr int kSamples = TileSize * TileSize;
  const hn::CappedTag<std::uint16_t, kSamples> tag;
  constexpr int kStep = static_cast<int>(hn::MaxLanes(tag));
  if (counts.used(tile) == 0 && whole == 0) {
    return;
  }
  std::uint16_t* const pixels = image.tile(x, y);
  const auto all = hn::Set(tag, static_cast<std::uint16_t>(std::min(whole, std::int32_t{0xFFFF})));
  for (int i = 0; i < kSamples; i += kStep) {
    auto sum = hn::SaturatedAdd(hn::LoadU(tag, pixels + i), all);
    for (std::size_t k = 0; k < counts.used(tile); ++k) {
      const std::uint64_t bits = counts.word(tile, k) >> i;
      const auto lanes = hn::LoadMaskBits(tag, reinterpret_cast<const std::uint8_t*>(&bits));
      const auto value = hn::Set(tag, static_cast<std::uint16_t>(1u << k));
      sum = hn::SaturatedAdd(sum, hn::IfThenElseZero(lanes, value));
    }
    hn::StoreU(sum, tag, pixels + i);
  }
}

/// See put_counts (raster.hpp).
template <int TileSize>
void put_surface_counts(const SurfaceTiles& tiles, Surface& surface) {
  const int side = 1 << tiles.block_shift;
  for (std::uint32_t block = 0; block < tiles.blocks; ++block) {
    block = tiles.next_used(tiles.counted.get(), block);
    if (block == tiles.blocks) {
      break;
    }
    if (!tiles.is_counted(block)) {
      continue;
    }
    const SurfaceTiles::Tile first = tiles.first_tile(block);
    for (int i = 0; i < side * side; ++i) {
      const std::size_t at = block * tiles.entries + static_cast<std::size_t>(i);
      const int x = first.x + i % side;
      const int y = first.y + i / side;
      put_counts<TileSize>(tiles.fragments, at, tiles.whole_fragments[at], surface.fragments, x, y);
      put_counts<TileSize>(tiles.survivors, at, tiles.whole_survivors[at], surface.survivors, x, y);
    }
  }
}

inline void put_counts_4(const SurfaceTiles& tiles, Surface& surface) {
  put_surface_counts<4>(tiles, surface);
}
inline void put_counts_8(const SurfaceTiles& tiles, Surface& surface) {
  put_surface_counts<8>(tiles, surface);
}

}  // namespace
}  // namespace halfspace::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
