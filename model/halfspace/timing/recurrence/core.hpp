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

/// Of the machine of `config`, whose surfaces take so many lines of memory.
template <class TimePolicy = OneMachine>
RecurrenceMemory<TimePolicy> recurrence_memory(const Config& config, std::uint32_t memory_lines) {
  RecurrenceMemory<TimePolicy> memory;
  memory.machine = machine(config);
  const std::array<int, kFifos> capacity = capacities(config);
  for (std::size_t i = 0; i < kFifos; ++i) {
    Credits& fifo = i < kSetupFifos ? memory.setup_fifos[i] : memory.fifos[i - kSetupFifos];
    fifo = Credits(capacity[i]);
  }
  memory.out = TimeTable(memory_lines);
  memory.late = TimeTable(kLateRing);
  if (config.hi_z.enabled) {
    memory.hi_z_lag = static_cast<std::uint64_t>(config.hi_z.lag);
    memory.retired = TimeTable(kHiZRing);
  }
  return memory;
}

}  // namespace halfspace
