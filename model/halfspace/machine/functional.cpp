#include "halfspace/machine/functional.hpp"

#include "halfspace/machine/in_order.hpp"

namespace halfspace {

FrameResult run_functional(const Frame& frame, const Config& config, const Watch& watch) {
  return run_in_order(frame, config, watch, nullptr);
}

}  // namespace halfspace
