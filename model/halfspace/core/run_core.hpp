/// A frame through the units' function, by the core that is asked for.
#pragma once

#include "halfspace/config/config.hpp"
#include "halfspace/machine/frame_result.hpp"
#include "halfspace/machine/packet_observer.hpp"
#include "halfspace/machine/packet_stream.hpp"

namespace halfspace {

/// The core that runs it: `watch.core`, or for kAuto the fast one where it covers the run. Throws InputError
/// where the fast one is asked for and does not.
Core core_of(const Config& config, const Watch& watch, const StreamReader* reader);

/// As run_in_order (machine/in_order.hpp), on core_of(). With `watch.threads` above 1 a reader that has time
/// reads in a thread of its own, unless it is asked for the cycles of bursts.
FrameResult run_core(const Frame& frame, const Config& config, const Watch& watch, StreamReader* reader);

}  // namespace halfspace
