/// Fidelity `recurrence`: when every packet moves, computed packet by packet from the timing contract
/// (docs/timing.md), with a queue for each link's credits and no event kernel.
#pragma once

#include "halfspace/config/config.hpp"
#include "halfspace/timing/engine.hpp"

namespace halfspace {

/// Runs `frame` on the machine of `config`, both valid. The image and all counters are those of
/// run_functional.
TimedResult run_recurrence(const Frame& frame, const Config& config, const EngineOptions& options = {});

}  // namespace halfspace
