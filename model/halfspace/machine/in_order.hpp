/// A frame through the units, one packet after the other: what the machine makes of it, and the stream of its
/// packets for those who have time.
#pragma once

#include "halfspace/config/config.hpp"
#include "halfspace/machine/frame_result.hpp"
#include "halfspace/machine/packet_observer.hpp"
#include "halfspace/machine/packet_stream.hpp"

namespace halfspace {

/// Whether such a run asks `reader` for the cycles of bursts: to show them with the quads.
bool shows_cycles(const Watch& watch, const StreamReader& reader);

/// Runs `frame`, which must be valid (scene/validate.hpp), on the machine of `config`, which must be valid
/// too. `reader` may be null. Where it has time, quads are shown with the
/// cycle that it gives their burst. Takes no more threads than the one that calls.
FrameResult run_in_order(const Frame& frame, const Config& config, const Watch& watch, StreamReader* reader);

}  // namespace halfspace
