#include "bench_cli.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "halfspace/numerics/error.hpp"
#include "halfspace/report/tile_job_file.hpp"

namespace halfspace::tb {
namespace {

constexpr std::uint64_t kResetPeriod = 50;           // mean cycles between resets
constexpr std::uint64_t kCyclesBeforeFailure = 300;  // of waveform

BenchOptions base_options(const CommandLine& command_line) {
  BenchOptions options;
  options.seed = command_line.seed;
  options.fault = fault_by_name(command_line.fault).value();
  options.fault_packet = command_line.fault_packet;
  options.coverage_file = command_line.coverage;
  if (command_line.check != "all") {
    options.checks = {command_line.check == "packets", command_line.check == "handshake",
                      command_line.check == "timing"};
  }
  return options;
}

/// "a.fst", "a-1.fst", ... : a file for each run.
std::string numbered(const std::string& file, std::size_t index) {
  const std::filesystem::path path(file);
  return index == 0 ? file
                    : (path.parent_path() /
                       fmt::format("{}-{}{}", path.stem().string(), index, path.extension().string()))
                          .string();
}

const DutModel& find_model(const UnitBench& bench, const std::string& name) {
  const auto model = std::ranges::find(bench.models, name, &DutModel::name);
  if (model != bench.models.end()) {
    return *model;
  }
  std::string names;
  for (const DutModel& known : bench.models) {
    names += " " + known.name;
  }
  throw InputError(fmt::format("model '{}' is not in this bench; there are:{}", name, names));
}

std::string describe(const BenchRun& run) {
  const BenchOptions& options = run.options;
  return fmt::format("{} idle={} stall={} seed={}", run.name, to_string(options.idle),
                     to_string(options.stall), options.seed);
}

/// The same run with a waveform, up to the failure.
void record_failure(const DutModel& model, const UnitShape& shape, const BenchRun& run,
                    const Failure& failure, const std::string& file) {
  const std::unique_ptr<StreamDut> dut = model.make(run.options.seed);
  BenchOptions options = run.options;
  options.coverage_file.clear();
  options.wave_file = file;
  options.wave_from = failure.cycle - std::min(failure.cycle, kCyclesBeforeFailure);
  const std::unique_ptr<Stimulus> stimulus = run.stimulus();
  run_bench(*dut, shape, *stimulus, options);
  fmt::print("waveform from cycle {}: {}\n", options.wave_from, file);
}

int run_all(const UnitBench& bench, const CommandLine& command_line) {
  const DutModel& model =
      command_line.replay.empty()
          ? (command_line.model.empty() ? bench.models.front() : find_model(bench, command_line.model))
          : find_model(bench, command_line.model.empty() ? bench.model_of_file(command_line.replay)
                                                         : command_line.model);
  const UnitShape shape = bench.shape(model);
  std::vector<BenchRun> runs;
  for (const std::string& name : bench.cases) {
    const bool wanted = command_line.test_case == "all" ? name != "replay" || !command_line.replay.empty()
                                                        : command_line.test_case == name;
    if (wanted) {
      std::ranges::move(bench.runs(model, name, command_line, base_options(command_line)),
                        std::back_inserter(runs));
    }
  }
  std::uint64_t compared = 0;
  std::uint64_t cycles = 0;
  const auto start = std::chrono::steady_clock::now();
  for (std::size_t i = 0; i < runs.size(); ++i) {
    BenchRun& run = runs[i];
    if (!command_line.wave.empty()) {
      run.options.wave_file = numbered(command_line.wave, i);
    }
    if (!command_line.coverage.empty()) {
      run.options.coverage_file = numbered(command_line.coverage, i);
    }
    std::unique_ptr<StreamDut> dut = model.make(run.options.seed);
    const std::unique_ptr<Stimulus> stimulus = run.stimulus();
    const BenchResult result = run_bench(*dut, shape, *stimulus, run.options);
    dut.reset();  // one model at a time: Verilator keeps the last one's context for the thread
    if (result.failure) {
      fmt::print("FAIL {} {}: {}\n{} in cycle {}: {}\n", bench.unit, model.name, describe(run),
                 to_string(result.failure->kind), result.failure->cycle, result.failure->message);
      if (run.options.wave_file.empty() && command_line.failure_wave != "none") {
        record_failure(model, shape, run, *result.failure,
                       command_line.failure_wave.empty() ? fmt::format("{}_{}.fst", bench.unit, model.name)
                                                         : command_line.failure_wave);
      }
      return static_cast<int>(result.failure->kind);
    }
    fmt::print("pass {}: {} packets in {} cycles\n", describe(run), result.compared, result.cycles);
    compared += result.compared;
    cycles += result.cycles;
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  fmt::print("PASS {} {}: {} packets compared, {} cycles, {:.2f} Mcycles/s\n", bench.unit, model.name,
             compared, cycles, static_cast<double>(cycles) / seconds.count() / 1e6);
  return 0;
}

}  // namespace

std::vector<BenchOptions> with_stalls(const BenchOptions& base, const CommandLine& command_line) {
  if (command_line.idle || command_line.stall) {
    BenchOptions options = base;
    options.idle = StallProfile::kCustom;
    options.stall = StallProfile::kCustom;
    options.idle_share = command_line.idle.value_or(0);
    options.stall_share = command_line.stall.value_or(0);
    return {options};
  }
  static constexpr std::array<std::array<StallProfile, 2>, 6> kProfiles = {
      {{StallProfile::kNone, StallProfile::kNone},
       {StallProfile::kLight, StallProfile::kLight},
       {StallProfile::kNone, StallProfile::kHeavy},
       {StallProfile::kHeavy, StallProfile::kNone},
       {StallProfile::kBursty, StallProfile::kBursty},
       {StallProfile::kLight, StallProfile::kBursty}}};
  std::vector<BenchOptions> all;
  for (const auto& [idle, stall] : kProfiles) {
    all.push_back(base);
    all.back().idle = idle;
    all.back().stall = stall;
    all.back().seed = base.seed + all.size() - 1;
  }
  return all;
}

std::vector<BenchRun> case_runs(const std::string& test_case, const CommandLine& command_line,
                                const std::vector<BenchOptions>& stalls, const CaseStimuli& stimuli) {
  const std::uint64_t packets = (command_line.tiles + stalls.size() - 1) / stalls.size();
  std::vector<BenchRun> runs;
  for (BenchOptions options : stalls) {
    const std::uint64_t seed = options.seed;
    if (test_case == "directed") {
      options.probe_paths = true;
      runs.push_back({test_case, options, [=] { return stimuli.directed(seed); }});
    } else if (test_case == "replay") {
      runs.push_back({test_case, options, [=] { return stimuli.replay(seed); }});
    } else {
      options.reset_period = test_case == "reset" ? kResetPeriod : 0;
      runs.push_back({test_case, options, [=] { return stimuli.random(seed, packets); }});
    }
  }
  return runs;
}

std::vector<TileJob> replayed_jobs(const std::string& file, const DutModel& model) {
  TileJobFile jobs = read_tile_jobs(file);
  if (jobs.widths.TileSize != model.tile_size || jobs.widths.SubPixelBits != model.sub_pixel_bits) {
    throw InputError(fmt::format("{}: tile size {} and {} sub-pixel bits, but model {} has {} and {}", file,
                                 jobs.widths.TileSize, jobs.widths.SubPixelBits, model.name, model.tile_size,
                                 model.sub_pixel_bits));
  }
  return std::move(jobs.jobs);
}

int bench_main(int argc, char** argv, const UnitBench& bench) {
  CommandLine command_line;
  CLI::App app{"Compares the RTL of " + bench.unit +
               " with its C++ definition, packet by packet and cycle by cycle"};
  const std::string model_help =
      fmt::format("configuration of the RTL (first: {})", bench.models.front().name);
  std::vector<std::string> cases = bench.cases;
  cases.emplace_back("all");
  app.add_option("--model", command_line.model, model_help);
  app.add_option("--case", command_line.test_case, "what to send")
      ->check(CLI::IsMember(cases))
      ->capture_default_str();
  app.add_option("--seed", command_line.seed, "of stimulus, stalls and register values before reset")
      ->capture_default_str();
  app.add_option("--tiles", command_line.tiles, "packets of a random case, over all its stall profiles")
      ->capture_default_str();
  app.add_option("--idle", command_line.idle,
                 "share of cycles in which the source idles, instead of profiles")
      ->check(CLI::Range(0.0, 0.99));
  app.add_option("--stall", command_line.stall,
                 "share of cycles in which the sink stalls, instead of profiles")
      ->check(CLI::Range(0.0, 0.99));
  app.add_option("--replay", command_line.replay, "file of recorded packets for the case replay");
  app.add_option("--wave", command_line.wave, "write a waveform (FST)");
  app.add_option("--failure-wave", command_line.failure_wave,
                 "waveform of a failing run, made again (without it UNIT_MODEL.fst), or none");
  app.add_option("--coverage", command_line.coverage, "write coverage, of a model built with it");
  app.add_option("--fault", command_line.fault, "fault between the RTL and its checker, which must find it")
      ->check([](const std::string& name) {
        return fault_by_name(name) ? std::string() : "no fault of the name " + name;
      });
  app.add_option("--fault-packet", command_line.fault_packet, "the packet that the fault is about")
      ->capture_default_str();
  app.add_option("--check", command_line.check, "checkers to use")
      ->check(CLI::IsMember({"all", "packets", "handshake", "timing"}))
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    if (command_line.test_case == "replay" && command_line.replay.empty()) {
      throw InputError("--case replay needs --replay FILE");
    }
    return run_all(bench, command_line);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}

}  // namespace halfspace::tb
