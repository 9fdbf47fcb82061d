/// Run time against error: what each fidelity takes for a frame, and how far it is from the RTL.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/config/config.hpp"
#include "halfspace/report/output_folder.hpp"
#include "halfspace/run/run_result.hpp"

namespace halfspace {

inline constexpr const char* kErrorFile = "error.json";
inline constexpr const char* kErrorSchema = "halfspace-error";
inline constexpr int kErrorSchemaVersion = 2;

/// A fidelity on a frame, as it ran. A record that is timed gives the frame's cycles and nothing else.
struct FidelityRun : RunResult {
  std::string fidelity;
  std::optional<std::uint64_t> record_cycles;
  std::vector<double> milliseconds;  ///< of each timed run, at least one
};

/// Cycles against those of the RTL; positive: too many.
struct CycleError {
  std::uint64_t truth = 0;
  std::int64_t cycles = 0;

  [[nodiscard]] double percent() const;  ///< of the truth, taken as 1 where it is 0
};

/// What a stage's cycles were spent on, against the RTL.
struct StageError {
  std::uint64_t off = 0;     ///< sum over busy and every stall reason of the differences' magnitudes
  std::string_view largest;  ///< busy or the reason that is off by most; empty: none is
  std::int64_t largest_cycles = 0;
};

/// A draw's cycles are those from the end of the draw before to its own end.
struct DrawErrors {
  /// Percentages are of draws that take the RTL so many cycles or more: a shorter one is all fill and drain.
  static constexpr std::uint64_t kLong = 1000;

  std::size_t draws = 0;
  std::size_t off = 0;           ///< draws whose cycles differ, short ones included
  std::uint64_t cycles_off = 0;  ///< sum of the differences' magnitudes over all draws
  std::size_t long_draws = 0;
  double mean_percent = 0;            ///< signed, of the long draws
  double mean_magnitude_percent = 0;  ///< without the signs
  std::size_t worst_draw = 0;  ///< the first long one with the largest percentage; 0 without long draws
  double worst_percent = 0;    ///< signed
};

/// Numbers of values that differ; 0 is expected.
struct FunctionErrors {
  std::uint64_t codes = 0;  ///< pixels of all depth surfaces
  std::uint64_t fragments = 0;
  std::uint64_t survivors = 0;
  std::uint64_t counters = 0;  ///< of frame, draws, surfaces and clears

  [[nodiscard]] std::uint64_t total() const { return codes + fragments + survivors + counters; }
};

/// A line of the table. What a fidelity has not is absent, and so are the RTL's errors against itself.
struct FidelityError {
  std::string fidelity;
  std::vector<double> milliseconds;
  std::optional<std::uint64_t> cycles;
  std::optional<CycleError> error;
  std::optional<DrawErrors> draws;
  std::optional<std::array<StageError, kStages>> stages;
  std::optional<FunctionErrors> function;
  std::optional<rtl::PacketReport> packets;  ///< RTL against the C++ units

  [[nodiscard]] double median_milliseconds() const;
  [[nodiscard]] std::optional<double> megacycles_a_second() const;
};

/// `rtl` has cycles and comes from the same frame as `run`.
FidelityError compare_to_rtl(const FidelityRun& run, const FidelityRun& rtl);

struct WorkloadErrors {
  std::string name;
  std::uint64_t triangles = 0;
  std::uint64_t fragments = 0;
  std::vector<FidelityError> fidelities;
};

/// `runs` of one frame; one of them is the RTL's. Its place in the list is kept.
WorkloadErrors compare_fidelities(const std::string& name, const std::vector<FidelityRun>& runs);

struct ErrorTable {
  Config config;
  int repeat = 0;  ///< timed runs of each fidelity; of the RTL at most so many
  std::vector<WorkloadErrors> workloads;

  /// Whether function and packets are equal everywhere, whatever the cycles.
  [[nodiscard]] bool function_agrees() const;
};

/// Two Markdown tables: the fidelities over all workloads, and each fidelity on each workload.
std::string error_markdown(const ErrorTable& table);

/// A line for each fidelity on each workload, with every figure but the single runs' times.
std::string error_csv(const ErrorTable& table);

/// Writes error.md, error.csv and error.json. Throws InputError.
void write_error_files(OutputFolder& folder, const ErrorTable& table);

}  // namespace halfspace
