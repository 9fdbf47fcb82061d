/// What a frame draws on in the fast core: depth surfaces, what is known of their tiles, and the z cache.
#pragma once

#include <cstdint>
#include <vector>

#include "halfspace/config/config.hpp"
#include "halfspace/fast/block_cache.hpp"
#include "halfspace/fast/surface_tiles.hpp"
#include "halfspace/machine/frame_result.hpp"
#include "halfspace/machine/packet_observer.hpp"
#include "halfspace/machine/surfaces.hpp"
#include "halfspace/units/z_cache.hpp"

namespace halfspace::fast {

struct FrameMemory {
  /// Threads that can draw at once, at most as many as `watch` allows: columns of blocks have nothing in
  /// common only where they have sets of the z cache of their own. A power of two. Sums are kept by one: a
  /// triangle that the units draw is walked in all columns at once.
  static std::uint32_t useful_threads(const Config& config, const Watch& watch);

  FrameMemory(const Config& config, const Watch& watch, std::uint32_t threads);

  /// As it is before the first command of `frame`, in the memory of the frame before where that fits.
  void begin(const Frame& frame);
  /// Marks a surface cleared.
  void clear(std::uint32_t surface, std::uint32_t code);
  /// What is dirty in the z cache at the end of the frame, in order of slots.
  std::vector<ZFlush> flush();
  /// Lines of memory that all surfaces take, as a stream numbers them.
  [[nodiscard]] std::uint32_t lines() const;
  /// Makes the codes and counts of all pixels, and gives the surfaces away.
  std::vector<Surface> take();

  const Config config;
  const Watch watch;
  const std::uint32_t threads;
  const int block_shift;  ///< log2 of the tiles on a side of a block
  const bool by_blocks;   ///< the z cache is `cache`, else `tile_cache`
  std::vector<Surface> surfaces;
  std::vector<SurfaceTiles> tiles;  ///< by surface
  std::vector<ZSurface> places;     ///< by surface
  BlockCache cache;
  ZCache tile_cache;

 private:
  void make_cache();

  std::vector<SurfaceShape> shape_;  ///< that the surfaces have
};

}  // namespace halfspace::fast
