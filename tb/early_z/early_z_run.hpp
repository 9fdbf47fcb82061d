/// source -> early_z -> sink, and memory: one run of one workload.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/failure.hpp"
#include "common/staller.hpp"
#include "early_z/coverage.hpp"
#include "early_z/models.hpp"
#include "early_z/workload.hpp"

namespace halfspace::tb {

/// Faults between the RTL and what checks it.
enum class ZFault : std::uint8_t {
  kNone,
  kFlipDepth,      ///< a bit of a depth code of a beat
  kFlipPassed,     ///< a bit of what passed
  kDrop,           ///< a beat swallowed
  kLate,           ///< a beat one cycle late
  kChangePayload,  ///< another payload in the second cycle of a stall
  kFlipFill,       ///< a bit of the data read from memory, from a beat on
  kLoseFill,       ///< no data from memory any more, from a beat on
  kFlipWrite,      ///< a bit of the data written to memory, from a beat on
  kHoldRequest,    ///< memory takes a request one cycle late
  kFlipUpdate,     ///< a bit of an update for hi_z
  kLateUpdate,     ///< an update one cycle late
  kFlipKeep,       ///< a bit of what the shader keeps
  kLateAnswer,     ///< the shader answers one cycle late, from an answer on
  kLoseAnswer,     ///< no answers any more, from one on
  kExtraAnswer,    ///< an answer for nothing: for the assertions of the RTL
  kGap,            ///< the source leaves a gap in a burst: for the assertions of the RTL
};

[[nodiscard]] std::optional<ZFault> z_fault_by_name(const std::string& name);

struct ZRunOptions {
  std::uint64_t seed = 1;
  std::uint64_t latency = 20;       ///< of memory
  std::uint64_t late_latency = 20;  ///< of the shader: from the last beat taken to its answer
  bool late_varies = false;         ///< from 1 to that, but in order
  StallProfile idle = StallProfile::kNone;
  StallProfile stall = StallProfile::kNone;
  StallProfile memory =
      StallProfile::kNone;  ///< requests and writes are not taken: no timing is checked then
  std::uint64_t cut = 0;    ///< reset in this cycle, and the workload again from its start
  bool timing = true;
  ZFault fault = ZFault::kNone;
  std::uint64_t fault_packet = 0;
  std::string wave_file;
  std::string coverage_file;
};

struct ZRunResult {
  std::optional<Failure> failure;
  std::uint64_t cycles = 0;
  std::uint64_t beats = 0;  ///< compared
  std::uint64_t lines = 0;  ///< of memory, compared at the end
};

ZRunResult run_early_z(EarlyZDut& dut, const EarlyZShape& shape, const Workload& workload,
                       const ZRunOptions& options, ZCoverage& coverage);

}  // namespace halfspace::tb
