/// The verilated configurations of block_walker that a bench has.
#pragma once

#include <vector>

#include "common/stream_dut.hpp"
#include "reference_walk.hpp"

namespace halfspace::tb {

struct BlockWalkerModel {
  DutModel dut;
  BlockWalkerParameters parameters;
};

[[nodiscard]] std::vector<BlockWalkerModel> block_walker_models();

}  // namespace halfspace::tb
