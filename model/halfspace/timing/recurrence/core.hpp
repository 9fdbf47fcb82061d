/// The recurrence for one machine: see core-inl.hpp.
#pragma once

#include "halfspace/timing/recurrence/core-inl.hpp"

namespace halfspace {

using HWY_NAMESPACE::NoProbe;
using HWY_NAMESPACE::NoStalls;
using HWY_NAMESPACE::RecurrenceCore;

}  // namespace halfspace
