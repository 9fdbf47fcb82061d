/// Fidelity `functional`: a frame through the units, one packet after the other, without time.
#pragma once

#include "halfspace/config/config.hpp"
#include "halfspace/machine/frame_result.hpp"
#include "halfspace/machine/packet_observer.hpp"

namespace halfspace {

/// Runs `frame`, which must be valid (scene/validate.hpp), on the machine of `config`, which must be valid
/// too. Memory: 8 bytes a pixel of all depth surfaces at most; pages of it in which no draw touches a tile
/// are reserved only.
FrameResult run_functional(const Frame& frame, const Config& config, const Watch& watch = {});

}  // namespace halfspace
