/// The verilated configurations of edge_evaluator that this build has.
#pragma once

#include <vector>

#include "common/stream_dut.hpp"

namespace halfspace::tb {

[[nodiscard]] std::vector<DutModel> edge_evaluator_models();

}  // namespace halfspace::tb
