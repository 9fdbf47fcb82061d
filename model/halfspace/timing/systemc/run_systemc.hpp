/// Fidelity `systemc`: the machine as SystemC modules, the second implementation of the timing contract
/// (docs/timing.md). It is slower than `recurrence`, and moves real data through real FIFOs, caches and
/// memory.
#pragma once

#include <cstdint>
#include <filesystem>

#include "halfspace/config/config.hpp"
#include "halfspace/timing/engine.hpp"

namespace halfspace {

struct SystemcOptions {
  std::filesystem::path vcd;  ///< a waveform of links and stages, with or without .vcd; empty: none
  std::uint64_t* activations = nullptr;  ///< gets how often a process was run; null: nobody asks
};

/// Runs `frame` on the machine of `config`. Image, counters, events, cycles and times are those of
/// run_recurrence. Throws systemc::DeadlockError where the machine comes to rest with work left, which a
/// valid configuration never does. Not for several threads at a time.
TimedResult run_systemc(const Frame& frame, const Config& config, const EngineOptions& options = {},
                        const SystemcOptions& systemc = {});

}  // namespace halfspace
