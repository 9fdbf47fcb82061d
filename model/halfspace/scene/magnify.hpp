/// Frames drawn larger than they are, for supersampling.
#pragma once

#include "halfspace/scene/frame.hpp"

namespace halfspace {

inline constexpr int kMostMagnified = 16;

/// Makes the frame so many times as wide and high: targets, viewports, scissors, lines, stipples and points.
/// Each pixel becomes times x times pixels that see the same of the scene. Polygon offset keeps its depth:
/// its slope is by pixel, so its factor grows too. `times`: 1 to kMostMagnified. Throws InputError, naming
/// the frame and the target or command, where the larger frame is not legal.
void magnify(Frame& frame, int times);

}  // namespace halfspace
