/// halfspace bench error: run time against error, every fidelity beside the RTL on the same frames.
#include <fmt/format.h>

#include <memory>
#include <optional>
#include <utility>

#include "halfspace/cli/bench.hpp"
#include "halfspace/cli/load_input.hpp"
#include "halfspace/cli/options.hpp"
#include "halfspace/cli/progress.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/report/error_table.hpp"
#include "halfspace/report/output_folder.hpp"
#include "halfspace/run/run.hpp"
#include "halfspace/scene/synthetic.hpp"
#include "halfspace/timing/record/retime.hpp"
#include "halfspace/timing/rtl/run_rtl.hpp"

namespace halfspace {
namespace {

struct ErrorOptions {
  std::vector<std::string> inputs;
  MachineOptions machine;
  RtlOptions rtl;
  std::string out;
  int repeat = 5;
  double rtl_seconds = 2;
  bool synthetic = false;

  [[nodiscard]] std::vector<std::string> all_inputs() const {
    std::vector<std::string> all = inputs;
    for (const SyntheticInfo& info : synthetic_frames()) {
      if (synthetic) {
        all.push_back(std::string(kSyntheticPrefix) + std::string(info.name));
      }
    }
    if (all.empty()) {
      throw OptionError(
          "bench error: no INPUT is given; legal: frames, meshes, synthetic:NAME, or --synthetic");
    }
    return all;
  }
};

/// Runs a frame once, puts what came of it in place of what an earlier run left, and returns milliseconds.
/// Loading a verilated pipeline does not count.
double run_once(Fidelity fidelity, const Frame& frame, const Config& config, const RtlOptions& rtl,
                FidelityRun& to) {
  RunResult& result = to;
  if (fidelity != Fidelity::kRtl) {
    return milliseconds([&] { result = run(fidelity, frame, config); });
  }
  const std::unique_ptr<rtl::VerilatedPipeline> pipeline = rtl.pipeline(config);
  const double time = milliseconds([&] {
    RtlResult verilated = run_rtl(frame, config, {}, *pipeline);
    result.frame = std::move(verilated.timed.frame);
    result.cycles = std::move(verilated.timed.cycles);
    result.rtl = std::move(verilated.report);
  });
  if (result.rtl->different != 0) {
    fmt::print(stderr, "halfspace: {}: RTL and model differ: {}\n", frame.name, result.rtl->first);
  }
  return time;
}

/// Times a record of the frame, exactly and by its sample, each into a run of its own.
class RecordRuns {
 public:
  RecordRuns(const Frame& frame, const Config& config)
      : config_(config), retimer_(record_frame(frame, config)) {
    exact_.fidelity = "retime";
    sampled_.fidelity = "sampled";
  }

  void turn(bool counts) {
    const double exact = milliseconds([&] { exact_.record_cycles = retimer_.retime(config_).cycles; });
    const double sampled = milliseconds([&] { sampled_.record_cycles = retimer_.estimate(config_); });
    if (counts) {
      exact_.milliseconds.push_back(exact);
      sampled_.milliseconds.push_back(sampled);
    }
  }

  [[nodiscard]] const FidelityRun& exact() const { return exact_; }
  [[nodiscard]] const FidelityRun& sampled() const { return sampled_; }

 private:
  Config config_;
  Retimer retimer_;
  FidelityRun exact_;
  FidelityRun sampled_;
};

WorkloadErrors measure(const Frame& frame, const Config& config, const ErrorOptions& options) {
  std::vector<FidelityRun> runs(kFidelityInfo.size());
  RecordRuns record(frame, config);
  ProgressBar bar(frame.name);
  const auto turns = static_cast<std::size_t>(options.repeat) + 1;
  double rtl_time = 0;
  for (std::size_t turn = 0; turn < turns; ++turn) {
    for (std::size_t i = 0; i < runs.size(); ++i) {
      bar.update(turn * runs.size() + i, turns * runs.size());
      const bool rtl = kFidelityInfo[i].rtl;
      // The first turn warms caches and page tables; the RTL, whose runs are long, does without where it is
      // out of time.
      if (rtl && rtl_time > options.rtl_seconds * 1e3) {
        continue;
      }
      const double time = run_once(kFidelityInfo[i].fidelity, frame, config, options.rtl, runs[i]);
      runs[i].fidelity = kFidelityInfo[i].name;
      rtl_time += rtl ? time : 0;
      if (turn > 0 || (rtl && rtl_time > options.rtl_seconds * 1e3)) {
        runs[i].milliseconds.push_back(time);
      }
    }
    record.turn(turn > 0);
  }
  runs.push_back(record.exact());
  runs.push_back(record.sampled());
  return compare_fidelities(frame.name, runs);
}

ExitStatus bench_error(const ErrorOptions& options) {
  ErrorTable table{.config = options.machine.config(), .repeat = options.repeat, .workloads = {}};
  const std::vector<std::string> inputs = options.all_inputs();
  (void)options.rtl.pipeline(table.config);  // without it there is nothing to compare with: said at once
  std::optional<OutputFolder> folder;
  if (!options.out.empty()) {
    folder.emplace(options.out);
  }
  for (const std::string& input : inputs) {
    table.workloads.push_back(measure(load_input(input), table.config, options));
  }
  if (folder) {
    write_error_files(*folder, table);
    folder->commit();
    fmt::print("results in {}\n", options.out);
  } else {
    fmt::print("{}", error_markdown(table));
  }
  return status_of(table.function_agrees());
}

}  // namespace

void add_bench_error(CLI::App& bench, ExitStatus& status) {
  auto options = std::make_shared<ErrorOptions>();
  CLI::App* command =
      bench.add_subcommand("error", "run time against error: every fidelity beside the verilated RTL");
  command->add_option("INPUT", options->inputs, "frames, meshes or synthetic:NAME");
  command->add_flag("--synthetic", options->synthetic, "measure all synthetic frames too");
  options->machine.add_to(*command);
  command->add_option("--repeat", options->repeat, "number of timed runs")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command
      ->add_option("--rtl-seconds", options->rtl_seconds,
                   "stop repeating the RTL on a frame after so many seconds")
      ->check(CLI::Range(0.0, 86400.0))
      ->capture_default_str();
  options->rtl.add_folder_to(*command);
  command
      ->add_option("--out", options->out,
                   "folder for error.md, error.csv and error.json (default: print the tables)")
      ->type_name("DIR");
  command->callback([options, &status] { status = bench_error(*options); });
}

}  // namespace halfspace
