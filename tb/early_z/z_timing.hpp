/// The cycles that docs/units/early_z.md prescribes, from when the source offers and the sink takes: a check
/// of every handshake of a run, after it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/failure.hpp"
#include "early_z/coverage.hpp"
#include "early_z/models.hpp"
#include "early_z/workload.hpp"

namespace halfspace::tb {

inline constexpr std::uint64_t kLookupToTest = 17;  ///< f to b at least
inline constexpr std::uint64_t kTestToSink = 2;     ///< b to the first beat at the sink
inline constexpr std::uint64_t kTestToUpdate = 4;   ///< test of the last beat to the update for hi_z

/// What happened with a command, up to where the run ended.
struct CommandLog {
  std::uint64_t arrive = 0;      ///< first cycle offered
  std::uint64_t ready_from = 0;  ///< first cycle, after the burst before it, in which the unit was ready
  std::uint64_t begin = 0;       ///< first beat, clear or flush taken
  bool begun = false;
  bool done = false;
  std::uint64_t done_at = 0;              ///< clear and flush
  std::vector<std::uint64_t> valid_from;  ///< of each beat that left
  std::vector<std::uint64_t> taken;
};

struct RequestLog {
  std::uint64_t cycle = 0;
  std::uint32_t line = 0;
};

struct WriteLog {
  std::uint64_t cycle = 0;
  std::uint32_t line = 0;
  bool last = false;
};

struct RunLog {
  std::vector<CommandLog> commands;
  std::vector<RequestLog> requests;
  std::vector<WriteLog> writes;
  std::vector<std::uint64_t> updates;  ///< cycles of those for hi_z
  std::vector<std::uint64_t> answers;  ///< and of the shader's
  std::uint64_t cycles = 0;
};

/// Nothing where the log is what the contract says. Counts the terms that decided.
std::optional<Failure> check_timing(const EarlyZShape& shape, std::uint64_t latency, const Workload& workload,
                                    const RunLog& log, ZCoverage& coverage);

}  // namespace halfspace::tb
