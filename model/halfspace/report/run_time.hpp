/// The time of a run, in as much detail as its fidelity has it.
#pragma once

#include <cstdint>
#include <optional>

#include "halfspace/timing/analytic/analytic.hpp"
#include "halfspace/timing/recurrence/run_recurrence.hpp"

namespace halfspace {

/// At most one of the two.
struct RunTime {
  const TimedRun* packets = nullptr;        ///< of every packet
  const AnalyticFrame* estimate = nullptr;  ///< of whole draws

  [[nodiscard]] std::optional<std::uint64_t> cycles() const {
    return packets != nullptr    ? std::optional(packets->cycles.cycles)
           : estimate != nullptr ? std::optional(estimate->cycles)
                                 : std::nullopt;
  }
};

}  // namespace halfspace
