/// The options and the result that all engines with cycles share.
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
  CycleObserver* observer = nullptr;  ///< sees where the cycles go, of the recurrence only; with more threads
                                      ///< than one it is called in another than watch.observer
};

struct TimedResult {
  FrameResult frame;
  FrameCycles cycles;
  PacketTimes times;  ///< on request
};

}  // namespace halfspace
