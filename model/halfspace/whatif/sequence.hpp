/// Frames that follow each other on one machine.
#pragma once

#include <vector>

#include "halfspace/scene/frame.hpp"

namespace halfspace::whatif {

/// All commands, frame after frame, on the targets of the first: depth surfaces and what the z cache holds go
/// on. Throws InputError where a frame has other targets than the first, or where they have more than 2^32
/// vertices or indices together. `frames` holds at least one.
[[nodiscard]] Frame join(std::vector<Frame> frames);

}  // namespace halfspace::whatif
