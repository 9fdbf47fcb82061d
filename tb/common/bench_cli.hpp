/// The command line that every unit bench has, and the runs it makes of it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "halfspace/units/packets.hpp"
#include "stream_bench.hpp"
#include "stream_dut.hpp"

namespace halfspace::tb {

struct CommandLine {
  std::string model;  ///< empty: the first
  std::string test_case = "all";
  std::uint64_t seed = 1;
  std::uint64_t tiles = 10000;
  std::optional<double> idle;  ///< share of the cycles; without it a case runs its own stall profiles
  std::optional<double> stall;
  std::string replay;
  std::string wave;
  std::string failure_wave;
  std::string coverage;
  std::string fault = "none";
  std::uint64_t fault_packet = 100;
  std::string check = "all";
};

/// One run: a fresh device under test with a fresh stimulus, so that it can be made again with a waveform.
struct BenchRun {
  std::string name;
  BenchOptions options;
  std::function<std::unique_ptr<Stimulus>()> stimulus;
};

/// The unit's part of its bench.
struct UnitBench {
  std::string unit;
  std::vector<DutModel> models;
  std::vector<std::string> cases;
  /// The model that a replay file was recorded for; throws InputError.
  std::function<std::string(const std::string& file)> model_of_file;
  std::function<UnitShape(const DutModel&)> shape;
  /// The runs of one case. `base` has the seed and the checks; stall profiles come from the command line if
  /// it has any.
  std::function<std::vector<BenchRun>(const DutModel&, const std::string& test_case, const CommandLine&,
                                      const BenchOptions& base)>
      runs;
};

/// The stall profiles that random cases go through, or the one that the command line asks for.
[[nodiscard]] std::vector<BenchOptions> with_stalls(const BenchOptions& base,
                                                    const CommandLine& command_line);

/// The stimuli of the cases that every unit has.
struct CaseStimuli {
  std::function<std::unique_ptr<Stimulus>(std::uint64_t seed)> directed;
  std::function<std::unique_ptr<Stimulus>(std::uint64_t seed)> replay;  ///< of CommandLine::replay
  std::function<std::unique_ptr<Stimulus>(std::uint64_t seed, std::uint64_t packets)> random;
};

/// The runs of the cases directed, replay, reset and random: one for each of `stalls`, which share the random
/// packets that the command line asks for.
[[nodiscard]] std::vector<BenchRun> case_runs(const std::string& test_case, const CommandLine& command_line,
                                              const std::vector<BenchOptions>& stalls,
                                              const CaseStimuli& stimuli);

/// The tile jobs of a file for `model`. Throws InputError where they are of another machine.
[[nodiscard]] std::vector<TileJob> replayed_jobs(const std::string& file, const DutModel& model);

/// Exit status: 0 when all runs passed, a FailureKind when one did not, 1 for input that cannot be used.
int bench_main(int argc, char** argv, const UnitBench& bench);

}  // namespace halfspace::tb
