/// A configuration as Verilator's arguments: the defines of raster_pkg.sv and the parameters of
/// raster_pipeline.sv.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "halfspace/config/config.hpp"

namespace halfspace::rtl {

/// Tiles of all depth surfaces that the verilated pipelines have flags for: of each sample of a pixel.
inline constexpr std::uint32_t kMemoryTiles = 65536;
/// Of all samples.
[[nodiscard]] std::uint32_t memory_tiles(const Config& config);
/// Blocks of all depth surfaces that their hi_z has words for.
inline constexpr std::uint32_t kMemoryBlocks = 16384;

/// "-DHALFSPACE_TILE_SIZE=8", "-GSetupQueue=8" and so on: the defines, then the parameters, one for every key
/// that the RTL knows, in the order of the keys; then MemoryTiles and
/// MemoryBlocks. The same arguments mean the same RTL.
[[nodiscard]] std::vector<std::string> pipeline_arguments(const Config& machine);

}  // namespace halfspace::rtl
