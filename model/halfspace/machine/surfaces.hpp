/// The depth surfaces of a frame, and where they lie in memory.
#pragma once

#include <cstdint>
#include <vector>

#include "halfspace/config/config.hpp"
#include "halfspace/machine/frame_result.hpp"
#include "halfspace/machine/packet_stream.hpp"
#include "halfspace/scene/frame.hpp"
#include "halfspace/units/z_line.hpp"

namespace halfspace {

ZCacheShape z_cache_shape(const Config& config);

/// The surfaces before the first command, at depth 1.
std::vector<Surface> make_surfaces(const Frame& frame, int tile_size, bool keep_visible);

/// As a packet stream has them.
std::vector<StreamSurface> stream_surfaces(const std::vector<Surface>& surfaces);

/// Where the tiles of each surface lie in memory; by surface number. `parts`: lines of a tile.
std::vector<ZSurface> place_surfaces(const std::vector<StreamSurface>& surfaces, int tile_size, int parts);
std::vector<ZSurface> place_surfaces(const std::vector<Surface>& surfaces, const Config& config);

/// Lines of memory that all surfaces take.
std::uint32_t memory_lines(const std::vector<ZSurface>& surfaces, const ZCacheShape& shape);

}  // namespace halfspace
