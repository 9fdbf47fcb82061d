/// What every engine that has time takes beside frame and machine, and what it gives.
#pragma once

#include "halfspace/machine/frame_result.hpp"
#include "halfspace/machine/packet_observer.hpp"
#include "halfspace/timing/cycle_observer.hpp"
#include "halfspace/timing/cycle_stats.hpp"
#include "halfspace/timing/stall_plan.hpp"

namespace halfspace {

struct EngineOptions {
  Watch watch;
  StallPlan stalls;                   ///< injected
  bool packet_times = false;          ///< fill TimedResult::times
  CycleObserver* observer = nullptr;  ///< sees where the cycles go; of the recurrence only
};

struct TimedResult {
  FrameResult frame;
  FrameCycles cycles;
  PacketTimes times;  ///< on request
};

}  // namespace halfspace
