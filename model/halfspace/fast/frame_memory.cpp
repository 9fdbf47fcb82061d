#include "halfspace/fast/frame_memory.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "halfspace/fast/raster.hpp"
#include "halfspace/machine/frame_source.hpp"

namespace halfspace::fast {
namespace {

int block_shift_of(const Config& config) {
  const int tiles = config.block_walker.block_size / config.tile_walker.tile_size;
  return std::countr_zero(static_cast<unsigned>(tiles));
}

void reset(Surface& surface, SurfaceTiles& tiles) {
  surface.counters = {};
  const PixelRect all{.x_last = surface.codes.width() - 1, .y_last = surface.codes.height() - 1};
  surface.codes.fill(all, largest_code(surface.format));
  tiles.clear(largest_code(surface.format));
  tiles.begin_frame();
  if (!surface.fragments.empty()) {
    surface.fragments.fill(all, 0);
    surface.survivors.fill(all, 0);
  }
  if (!surface.visible.empty()) {
    surface.visible.fill(all, kNothingVisible);
  }
  if (!surface.sums.empty()) {
    surface.sums.clear();
  }
}

}  // namespace

std::uint32_t FrameMemory::useful_threads(const Config& config, const Watch& watch) {
  const ZCacheShape shape = z_cache_shape(config);
  const int shift = block_shift_of(config);
  if (!BlockCache::takes(shape, shift) || watch.keep_sums) {
    return 1;
  }
  return std::bit_floor(std::min({static_cast<std::uint32_t>(std::max(watch.threads, 1)), Columns::kMost,
                                  BlockCache::columns(shape, shift)}));
}

FrameMemory::FrameMemory(const Config& on, const Watch& seen, std::uint32_t drawing)
    : config(on),
      watch(seen),
      threads(drawing),
      block_shift(block_shift_of(on)),
      by_blocks(BlockCache::takes(z_cache_shape(on), block_shift)) {}

void FrameMemory::begin(const Frame& frame) {
  std::vector<SurfaceShape> shape = surface_shapes(frame);
  if (shape == shape_) {
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      reset(surfaces[i], tiles[i]);
    }
  } else {
    shape_.clear();  // until all of it is there
    tiles.clear();
    surfaces = make_surfaces(frame, config, watch);
    for (const Surface& surface : surfaces) {
      tiles.emplace_back(surface.codes, 1 << block_shift, largest_code(surface.format), threads);
    }
    shape_ = std::move(shape);
  }
  make_cache();
}

void FrameMemory::make_cache() {
  places = place_surfaces(surfaces, config);
  const ZCacheShape shape = z_cache_shape(config);
  if (!by_blocks) {
    tile_cache = ZCache(shape, memory_lines(places, shape));
    return;
  }
  std::vector<BlockSurface> cached;
  std::uint32_t first = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    cached.push_back({.first = first, .blocks = tiles[i].blocks, .line_bytes = places[i].line_bytes});
    first += tiles[i].blocks;
  }
  cached.push_back({.first = first});
  cache = BlockCache(shape, block_shift, std::move(cached));
}

void FrameMemory::clear(std::uint32_t surface, std::uint32_t code) {
  clear_surface(surfaces[surface], code);
  tiles[surface].clear(code);
  if (by_blocks) {
    cache.clear(cache.surfaces[surface]);
  } else {
    tile_cache.clear(places[surface]);
  }
}

std::vector<ZFlush> FrameMemory::flush() {
  if (by_blocks) {
    return cache.flush();
  }
  std::vector<ZFlush> dirty;
  tile_cache.flush([&](std::uint32_t slot, std::uint32_t /*line*/, std::uint32_t bytes) {
    dirty.push_back({.slot = slot, .bytes = bytes});
  });
  return dirty;
}

std::uint32_t FrameMemory::lines() const {
  return by_blocks ? cache.memory_lines() : memory_lines(places, z_cache_shape(config));
}

std::vector<Surface> FrameMemory::take() {
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    resolve(config.tile_walker.tile_size, config.raster.sub_pixel_bits, {}, surfaces[i], tiles[i]);
    if (!surfaces[i].fragments.empty()) {
      put_counts(config.tile_walker.tile_size, tiles[i], surfaces[i]);
    }
  }
  tiles.clear();
  shape_.clear();
  return std::move(surfaces);
}

}  // namespace halfspace::fast
