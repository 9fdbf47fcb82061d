#include "halfspace/timing/rtl/pipeline_arguments.hpp"

#include <fmt/format.h>

#include "halfspace/numerics/error.hpp"

namespace halfspace::rtl {

Widths widths(const Config& config) {
  return {.SubPixelBits = config.sub_pixel_bits,
          .TileSize = config.tile_size,
          .QuadWidth = config.quad_width,
          .TestWidth = config.early_z_width,
          .ZParts = config.z_parts};
}

std::vector<std::string> pipeline_arguments(const Config& config) {
  if (config.interpolator != DepthInterpolator::kBarycentric) {
    throw InputError("configuration key 'depth.interpolator' is 'plane'; legal for the RTL: barycentric");
  }
  std::vector<std::string> arguments;
  const auto number = [&](const char* name, int value) {
    arguments.push_back(fmt::format("{}={}", name, value));
  };
  // A bit must be written as one: Verilator warns of a wider number.
  const auto flag = [&](const char* name, bool on) {
    arguments.push_back(fmt::format("{}=1'b{}", name, on ? 1 : 0));
  };
  number("-DHALFSPACE_SUB_PIXEL_BITS", config.sub_pixel_bits);
  number("-DHALFSPACE_TILE_SIZE", config.tile_size);
  number("-DHALFSPACE_QUAD_WIDTH", config.quad_width);
  number("-DHALFSPACE_TEST_WIDTH", config.early_z_width);
  number("-DHALFSPACE_Z_PARTS", config.z_parts);
  number("-GSetupQueue", config.setup_queue);
  number("-GSetupFifo", config.setup_fifo);
  number("-GSetupInterval", config.setup_interval);
  number("-GWalkerFifo", config.walker_fifo);
  number("-GBlockSize", config.block_size);
  flag("-GBlockLevel", config.block_level);
  flag("-GTrivialReject", config.trivial_reject);
  flag("-GTrivialAccept", config.trivial_accept);
  number("-GStepInterval", config.walker_step_interval);
  number("-GPipeStages", config.edge_pipe_stages);
  number("-GEdgeFifo", config.edge_fifo);
  number("-GQuadFifo", config.quad_fifo);
  number("-GPendingDepth", config.early_z_pending);
  number("-GEarlyZFifo", config.early_z_fifo);
  number("-GLines", config.z_lines);
  number("-GWays", config.z_ways);
  number("-GMissesInFlight", config.z_misses_in_flight);
  number("-GWriteBuffers", config.z_write_buffers);
  number("-GReadBytes", config.memory_read_bytes);
  number("-GWriteBytes", config.memory_write_bytes);
  number("-GClearTiles", config.z_clear_tiles);
  number("-GMemoryTiles", static_cast<int>(kMemoryTiles));
  return arguments;
}

}  // namespace halfspace::rtl
