/// Fidelity `recurrence`: when every packet moves, computed packet by packet from the timing contract
/// (docs/timing.md), with a queue for each link's credits and no event kernel.
#pragma once

#include "halfspace/config/config.hpp"
#include "halfspace/timing/cycle_stats.hpp"
#include "halfspace/timing/frame_result.hpp"
#include "halfspace/timing/recurrence/cycle_observer.hpp"
#include "halfspace/timing/stall_plan.hpp"

namespace halfspace {

/// What a timed run takes and gives beside the frame.
struct TimedRun {
  StallPlan stalls;                   ///< injected
  FrameCycles cycles;                 ///< result
  PacketTimes* times = nullptr;       ///< result, where it is wanted
  CycleObserver* observer = nullptr;  ///< sees where the cycles go, if there is one; of the recurrence only
};

/// Runs `frame` on the machine of `config`, both valid. The image and all counters are those of
/// run_functional. `observer` may be null.
FrameResult run_recurrence(const Frame& frame, const Config& config, bool keep_visible,
                           PacketObserver* observer, TimedRun& run);

}  // namespace halfspace
