/// block_walker -> hi_z -> tile_walker, and what comes back: one run of one workload.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/failure.hpp"
#include "common/staller.hpp"
#include "hi_z/hi_z_coverage.hpp"
#include "hi_z/models.hpp"
#include "hi_z/workload.hpp"

namespace halfspace::tb {

/// Faults between the RTL and what checks it.
enum class HiZFault : std::uint8_t {
  kNone,
  kFlipTile,       ///< a bit of the mask of a block that leaves
  kDrop,           ///< a block swallowed
  kLate,           ///< a block one cycle late
  kChangePayload,  ///< another payload in the second cycle of a stall
  kOtherSlot,      ///< a triangle's slot has another number
  kOtherTriangle,  ///< another depth equation in it
  kLoseSlot,       ///< no triangle gets one, from a block on
  kFlipUpdate,     ///< other bounds come back, from a job on
  kFlipKind,       ///< a job with a burst is said to have none
  kLoseUpdate,     ///< no bounds come back any more, from a job on
  kLateUpdate,     ///< bounds one cycle late, from a job on
  kSkipClear,      ///< the unit does not hear of a clear
  kSkipForget,     ///< nor of the end of a frame
  kEarlyClear,     ///< a clear while a block is under way: for the assertions of the RTL
};

[[nodiscard]] std::optional<HiZFault> hi_z_fault_by_name(const std::string& name);

struct HiZRunOptions {
  std::uint64_t seed = 1;
  StallProfile idle = StallProfile::kNone;   ///< of the source
  StallProfile stall = StallProfile::kNone;  ///< of the sink
  std::uint64_t delay = 20;                  ///< cycles from a block to what comes back of it, at most about
  std::uint64_t cut = 0;                     ///< reset in this cycle, and the workload again from its start
  HiZFault fault = HiZFault::kNone;
  std::uint64_t fault_packet = 0;
  bool packets = true;  ///< checked
  bool timing = true;
  std::string wave_file;
  std::string coverage_file;
};

struct HiZRunResult {
  std::optional<Failure> failure;
  std::uint64_t cycles = 0;
  std::uint64_t blocks = 0;    ///< that left, compared
  std::uint64_t rejected = 0;  ///< whole
};

HiZRunResult run_hi_z(HiZDut& dut, const HiZShape& shape, const HiZWorkload& workload,
                      const HiZRunOptions& options, HiZCoverage& coverage);

}  // namespace halfspace::tb
