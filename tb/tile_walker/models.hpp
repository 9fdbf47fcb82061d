/// The verilated configurations of tile_walker that a bench has.
#pragma once

#include <vector>

#include "common/stream_dut.hpp"
#include "parameters.hpp"

namespace halfspace::tb {

struct TileWalkerModel {
  DutModel dut;
  TileWalkerParameters parameters;
};

[[nodiscard]] std::vector<TileWalkerModel> tile_walker_models();

}  // namespace halfspace::tb
