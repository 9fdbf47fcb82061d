/// Bench of setup: the RTL against model/halfspace/units/setup.hpp.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "common/bench_cli.hpp"
#include "coverage.hpp"
#include "halfspace/timing/contract.hpp"
#include "job.hpp"
#include "models.hpp"
#include "stimulus.hpp"
#include "timing.hpp"

namespace halfspace::tb {
namespace {

constexpr std::size_t kTimingTriangles = 300;
const std::set<std::string> kCoverageCases = {"directed", "timing", "reset", "random"};
constexpr std::uint64_t kCoverageTriangles = 5000;  // random ones from which on every bin is asked for

/// What the runs of this program cover, and whether that may be judged.
struct Seen {
  std::map<std::string, SetupCoverage> coverage;  ///< by model
  std::set<std::string> cases;
  bool enough = true;
};

const SetupModel& model_of(const DutModel& dut) {
  static const std::vector<SetupModel> models = setup_models();
  return *std::ranges::find(models, dut.name, [](const SetupModel& model) { return model.dut.name; });
}

UnitShape shape(const DutModel& dut, Seen& seen) {
  const SetupModel& model = model_of(dut);
  SetupCoverage& coverage = seen.coverage.try_emplace(dut.name, model).first->second;
  return {.input_words = input_words(model.widths()),
          .output_fields = output_fields(model.widths()),
          .latency = kSetupCullLatency + model.divide_latency(),
          .capacity = model.fifo,
          .timing = [&model, &coverage] { return std::make_unique<SetupTiming>(model, coverage); }};
}

/// Drawn and dropped triangles in turns of a few lengths.
std::vector<std::vector<bool>> timing_patterns() {
  std::vector<std::vector<bool>> patterns;
  for (const std::size_t period : {1, 2, 3, 7, 23}) {
    std::vector<bool> one_drawn(kTimingTriangles);
    std::vector<bool> one_dropped(kTimingTriangles);
    for (std::size_t i = 0; i < kTimingTriangles; ++i) {
      one_drawn[i] = i % period == period - 1;
      one_dropped[i] = i % period != 0 || period == 1;
    }
    one_drawn.back() = one_dropped.back() = true;
    patterns.push_back(std::move(one_drawn));
    patterns.push_back(std::move(one_dropped));
  }
  return patterns;
}

std::vector<BenchRun> timing_runs(const SetupModel& model, const BenchOptions& base) {
  std::vector<BenchRun> runs;
  for (const std::vector<bool>& drawn : timing_patterns()) {
    BenchOptions options = base;
    options.full_rate_packets = last_leave_at_full_rate(model, drawn) -
                                static_cast<std::uint64_t>(kSetupCullLatency + model.divide_latency());
    runs.push_back(
        {"timing", options, [&model, drawn] { return list_stimulus(model, timing_jobs(model, drawn)); }});
  }
  return runs;
}

std::vector<BenchRun> runs(const DutModel& dut, const std::string& test_case, const CommandLine& command_line,
                           const BenchOptions& base, Seen& seen) {
  const SetupModel& model = model_of(dut);
  seen.cases.insert(test_case);
  seen.enough = seen.enough && command_line.tiles >= kCoverageTriangles && !command_line.idle &&
                !command_line.stall && command_line.check == "all";
  if (test_case == "timing") {
    return timing_runs(model, base);
  }
  std::vector<BenchOptions> all = with_stalls(base, command_line);
  if (test_case == "directed" || test_case == "replay") {
    // The same packets each time: without stalls, and with bursts of them on both sides.
    std::erase_if(all, [](const BenchOptions& options) {
      return options.stall != StallProfile::kNone && options.idle != StallProfile::kBursty;
    });
    std::erase_if(all, [](const BenchOptions& options) { return options.idle == StallProfile::kHeavy; });
  }
  return case_runs(
      test_case, command_line, all,
      {.directed = [&model](std::uint64_t) { return list_stimulus(model, directed_jobs(model)); },
       .replay = [&model, file = command_line.replay](
                     std::uint64_t) { return list_stimulus(model, frame_jobs(file, model)); },
       .random = [&model](std::uint64_t seed,
                          std::uint64_t count) { return random_stimulus(model, seed, count); }});
}

/// Prints the coverage of every model that ran; false when bins are missed that all cases together must hit.
bool judge(const Seen& seen) {
  const bool all = seen.enough && std::ranges::includes(seen.cases, kCoverageCases);
  bool complete = true;
  for (const auto& [name, coverage] : seen.coverage) {
    const std::map<std::string, std::uint64_t> bins = coverage.bins();
    std::size_t missed = 0;
    for (const auto& [bin, count] : bins) {
      missed += count == 0 ? 1 : 0;
      if (count == 0 && all) {
        fmt::print("not covered: {}\n", bin);
      }
    }
    fmt::print("functional coverage {}: {} of {} bins\n", name, bins.size() - missed, bins.size());
    complete = complete && missed == 0;
  }
  return complete || !all;
}

}  // namespace
}  // namespace halfspace::tb

int main(int argc, char** argv) {
  using namespace halfspace::tb;
  Seen seen;
  std::vector<DutModel> models;
  for (const SetupModel& model : setup_models()) {
    models.push_back(model.dut);
  }
  const int status = bench_main(
      argc, argv,
      {"setup",
       models,
       {"directed", "timing", "reset", "random", "replay"},
       [&](const std::string&) { return models.front().name; },
       [&](const DutModel& model) { return shape(model, seen); },
       [&](const DutModel& model, const std::string& test_case, const CommandLine& command_line,
           const BenchOptions& base) { return runs(model, test_case, command_line, base, seen); }});
  if (status == 0 && !judge(seen)) {
    return 1;
  }
  return status;
}
