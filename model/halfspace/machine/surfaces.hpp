/// The surfaces of a frame, and where those of depth lie in memory.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "halfspace/config/config.hpp"
#include "halfspace/machine/frame_result.hpp"
#include "halfspace/machine/packet_observer.hpp"
#include "halfspace/machine/packet_stream.hpp"
#include "halfspace/scene/frame.hpp"
#include "halfspace/units/hi_z.hpp"
#include "halfspace/units/z_codec.hpp"
#include "halfspace/units/z_line.hpp"

namespace halfspace {

ZCacheShape z_cache_shape(const Config& config);

struct SurfaceShape {
  std::optional<std::uint32_t> target{};  ///< see Surface
  DepthFormat format = DepthFormat::kNone;
  int width = 0;
  int height = 0;
  friend bool operator==(const SurfaceShape&, const SurfaceShape&) = default;
};

/// Of the surfaces of a frame, in the order of FrameResult::surfaces.
std::vector<SurfaceShape> surface_shapes(const Frame& frame);

/// By target: the number of its surface, or kNoSurface where it has no depth and nothing is drawn to it.
std::vector<std::uint32_t> surfaces_of_targets(const Frame& frame, const std::vector<Surface>& surfaces);

/// Those that have depth; the others are behind them.
std::span<const Surface> depth_surfaces(const std::vector<Surface>& surfaces);

/// The surfaces before the first command, at depth 1, with the images that `watch` asks for.
std::vector<Surface> make_surfaces(const Frame& frame, const Config& config, const Watch& watch);

/// Those of depth, as a packet stream has them.
std::vector<StreamSurface> stream_surfaces(const std::vector<Surface>& surfaces);

/// Where the tiles of each depth surface lie in memory; by its number. `parts`: lines of a tile.
std::vector<ZSurface> place_surfaces(const std::vector<StreamSurface>& surfaces, int tile_size, int parts);
std::vector<ZSurface> place_surfaces(const std::vector<Surface>& surfaces, const Config& config);

/// Of a line of the surface, for z_codec.
ZCodecShape z_codec_shape(const ZSurface& surface, const Config& config);

HiZConfig hi_z_config(const Config& config);

/// Where the blocks of each depth surface are for hi_z; by its number.
std::vector<HiZSurface> place_blocks(const std::vector<Surface>& surfaces, const Config& config);

/// hi_z as it is before the first command.
HiZ make_hi_z(const std::vector<HiZSurface>& surfaces, const Config& config);

/// Lines of memory that all depth surfaces take.
std::uint32_t memory_lines(const std::vector<ZSurface>& surfaces, const ZCacheShape& shape);

}  // namespace halfspace
