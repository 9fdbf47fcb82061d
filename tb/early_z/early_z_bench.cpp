/// Bench of early_z: the RTL against the C++ units, z_cache.hpp and the contract of docs/units/early_z.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "common/failure.hpp"
#include "early_z/coverage.hpp"
#include "early_z/early_z_run.hpp"
#include "early_z/models.hpp"
#include "early_z/workload.hpp"

namespace halfspace::tb {
namespace {

struct CommandLine {
  std::string model;
  std::string test_case = "all";
  std::uint64_t seed = 1;
  std::uint64_t bursts = 6000;
  std::string wave;
  std::string coverage;
  std::string fault = "none";
  std::uint64_t fault_packet = 100;
  double bins = 0;  ///< percent of the functional coverage that a run must reach
};

struct Case {
  std::string name;
  ZRunOptions options;
  bool local = false;
};

/// The stalls, latencies and working sets that the runs of a case go through.
std::vector<Case> cases(const CommandLine& command_line) {
  using enum StallProfile;
  struct Profile {
    StallProfile idle;
    StallProfile stall;
    std::uint64_t latency;
    bool local;
    std::uint64_t late_latency;
    bool late_varies;
  };
  static constexpr std::array<Profile, 8> kProfiles = {{{kNone, kNone, 20, false, 20, false},
                                                        {kNone, kNone, 1, true, 1, false},
                                                        {kLight, kLight, 100, true, 2, false},
                                                        {kNone, kHeavy, 20, false, 200, true},
                                                        {kHeavy, kNone, 3, true, 20, true},
                                                        {kBursty, kBursty, 50, false, 1, false},
                                                        {kNone, kBursty, 2, true, 40, true},
                                                        {kNone, kNone, 200, false, 200, false}}};
  std::vector<Case> all;
  for (std::size_t i = 0; i < kProfiles.size(); ++i) {
    const Profile& profile = kProfiles[i];
    ZRunOptions options{.seed = command_line.seed + i,
                        .latency = profile.latency,
                        .late_latency = profile.late_latency,
                        .late_varies = profile.late_varies,
                        .idle = profile.idle,
                        .stall = profile.stall,
                        .fault = z_fault_by_name(command_line.fault).value(),
                        .fault_packet = command_line.fault_packet,
                        .wave_file = {},
                        .coverage_file = {}};
    all.push_back({"random", options, profile.local});
    options.cut = 100 + 37 * i * i;
    all.push_back({"reset", options, profile.local});
    options.cut = 0;
    options.memory = i % 2 == 0 ? kLight : kHeavy;
    all.push_back({"memory", options, profile.local});
  }
  std::erase_if(all, [&](const Case& one) {
    return command_line.test_case != "all" && one.name != command_line.test_case;
  });
  return all;
}

int run_all(const CommandLine& command_line) {
  const std::vector<EarlyZModel> models = early_z_models();
  const auto model = command_line.model.empty()
                         ? models.begin()
                         : std::ranges::find(models, command_line.model, &EarlyZModel::name);
  if (model == models.end()) {
    fmt::print(stderr, "model '{}' is not in this bench\n", command_line.model);
    return 1;
  }
  const std::vector<Case> all = cases(command_line);
  ZCoverage coverage(model->shape);
  std::uint64_t beats = 0;
  std::uint64_t cycles = 0;
  std::uint64_t lines = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    ZRunOptions options = all[i].options;
    if (!command_line.wave.empty()) {
      options.wave_file = fmt::format("{}{}.fst", command_line.wave, i);
    }
    if (!command_line.coverage.empty()) {
      options.coverage_file = fmt::format("{}{}.dat", command_line.coverage, i);
    }
    const Workload workload =
        make_workload(model->shape, options.seed, command_line.bursts / all.size() + 1, all[i].local);
    const std::unique_ptr<EarlyZDut> dut = model->make(options.seed);
    const ZRunResult result = run_early_z(*dut, model->shape, workload, options, coverage);
    const std::string name =
        fmt::format("{} idle={} stall={} memory={} latency={}{} seed={}", all[i].name,
                    to_string(options.idle), to_string(options.stall), to_string(options.memory),
                    options.latency, all[i].local ? " local" : "", options.seed);
    if (result.failure) {
      fmt::print("FAIL early_z {}: {}\n{} in cycle {}: {}\n", model->name, name,
                 to_string(result.failure->kind), result.failure->cycle, result.failure->message);
      return static_cast<int>(result.failure->kind);
    }
    fmt::print("pass {}: {} beats, {} lines of memory in {} cycles\n", name, result.beats, result.lines,
               result.cycles);
    beats += result.beats;
    cycles += result.cycles;
    lines += result.lines;
  }
  coverage.report();
  if (coverage.percent() < command_line.bins) {
    fmt::print("FAIL early_z {}: functional coverage is below {} %\n", model->name, command_line.bins);
    return 2;
  }
  fmt::print("PASS early_z {}: {} beats and {} lines of memory compared, {} cycles\n", model->name, beats,
             lines, cycles);
  return 0;
}

}  // namespace
}  // namespace halfspace::tb

int main(int argc, char** argv) {
  using namespace halfspace::tb;
  CommandLine command_line;
  CLI::App app{"Compares the RTL of early_z with its C++ definition, beat by beat and cycle by cycle"};
  app.add_option("--model", command_line.model, "configuration of the RTL");
  app.add_option("--case", command_line.test_case, "what to send")
      ->check(CLI::IsMember({"all", "random", "reset", "memory"}))
      ->capture_default_str();
  app.add_option("--seed", command_line.seed, "of stimulus, stalls and register values before reset")
      ->capture_default_str();
  app.add_option("--bursts", command_line.bursts, "of all runs together")->capture_default_str();
  app.add_option("--wave", command_line.wave, "beginning of the names of waveforms (FST), one a run");
  app.add_option("--coverage", command_line.coverage, "the same for coverage, of a model built with it");
  app.add_option("--fault", command_line.fault, "fault between the RTL and its checkers, which must find it")
      ->check([](const std::string& name) {
        return z_fault_by_name(name) ? std::string() : "no fault of the name " + name;
      });
  app.add_option("--fault-packet", command_line.fault_packet,
                 "the beat, request or transfer that it is about")
      ->capture_default_str();
  app.add_option("--bins", command_line.bins, "percent of the functional coverage bins that must be hit")
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  return run_all(command_line);
}
