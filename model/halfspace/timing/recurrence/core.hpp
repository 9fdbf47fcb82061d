/// The recurrence for one machine: see core-inl.hpp and replay-inl.hpp.
#pragma once

#include "halfspace/timing/recurrence/core-inl.hpp"
#include "halfspace/timing/recurrence/replay-inl.hpp"

namespace halfspace {

using HWY_NAMESPACE::NoProbe;
using HWY_NAMESPACE::NoStalls;
using HWY_NAMESPACE::RecurrenceCore;
using HWY_NAMESPACE::replay;
using HWY_NAMESPACE::ReplayHooks;

}  // namespace halfspace
