/// Frames for tests, built from window coordinates.
#pragma once

#include "halfspace/scene/frame_builder.hpp"

namespace halfspace::testing {

using halfspace::bits;
using halfspace::FrameBuilder;

}  // namespace halfspace::testing
