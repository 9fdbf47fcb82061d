/// Fidelity `functional`: a frame through the units, one packet after the other, without time.
#pragma once

#include "halfspace/config/config.hpp"
#include "halfspace/timing/frame_result.hpp"

namespace halfspace {

/// Runs `frame`, which must be valid (scene/validate.hpp), on the machine of `config`, which must be valid
/// too. Memory: 8 bytes a pixel of all depth surfaces, 12 with keep_visible. `observer` may be null.
FrameResult run_functional(const Frame& frame, const Config& config, bool keep_visible,
                           PacketObserver* observer);

}  // namespace halfspace
