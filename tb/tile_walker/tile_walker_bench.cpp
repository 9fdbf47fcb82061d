/// Bench of tile_walker: the RTL against model/halfspace/units/tile_walker.hpp.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/bench_cli.hpp"
#include "halfspace/config/config.hpp"
#include "halfspace/timing/recurrence/core.hpp"
#include "halfspace/timing/recurrence/cycle_probe.hpp"
#include "halfspace/timing/recurrence/machine.hpp"
#include "halfspace/units/link_packets.hpp"
#include "halfspace/units/packing.hpp"
#include "models.hpp"
#include "stimulus.hpp"
#include "walk_coverage.hpp"
#include "walk_timing.hpp"

namespace halfspace::tb {
namespace {

constexpr int kLatency = 2;
constexpr std::uint64_t kTimingJobs = 2000;
constexpr std::uint64_t kStalledCycles = 2000;  // longer than any stall profile holds a link
constexpr int kBinsMissed = 18;                 // exit status, after those of FailureKind

/// Steps of the largest triangle that a bench sends: it may be rejected everywhere.
std::uint64_t most_steps(const WalkerParameters& walker) {
  const auto across = static_cast<std::uint64_t>(2048 / walker.tile_size);
  return 2 * across * across;
}

/// The cycles from the first triangle to the last job, by the model's own timing engine, where nothing but
/// the walker takes time.
std::uint64_t modelled_cycles(const std::vector<SetupTriangle>& triangles, const WalkerParameters& walker) {
  Config config;
  config.tile_walker.step_interval = walker.step_interval;
  config.tile_walker.fifo = walker.fifo_depth;
  config.setup.queue = config.setup.fifo = config.edge_evaluator.fifo = config.quad_generator.fifo =
      kMostCredits;
  PacketTimes times;
  CycleProbe<true> probe(capacities(config), &times);
  RecurrenceMemory<OneMachine> memory = recurrence_memory(config, 0);
  RecurrenceCore<OneMachine, NoStalls, CycleProbe<true>> core(memory, NoStalls{}, probe);
  std::vector<std::uint32_t> words(InputWords(walker.widths()).triangle);
  for (const SetupTriangle& triangle : triangles) {
    pack(to_packet(triangle, walker.walker(), walker.tile_size), walker.widths(), words);
    core.drawn();
    std::uint32_t steps = 0;
    for (const WalkStep& step : reference_walk(words, 0, walker).steps) {
      ++steps;
      if (gives_out(step.kind)) {
        core.job({.steps = steps});
        steps = 0;
      }
    }
    core.walked(steps);
  }
  return times.e.back() - times.accept.front() + 1;
}

/// The bench as a whole: its models, and the bins of the one at work.
class TileWalkerBench {
 public:
  TileWalkerBench() : models_(tile_walker_models()) {}

  int run(int argc, char** argv) {
    std::vector<DutModel> models;
    for (const TileWalkerModel& model : models_) {
      models.push_back(model.dut);
    }
    const int status = bench_main(
        argc, argv,
        {.unit = "tile_walker",
         .models = std::move(models),
         .cases = {"directed", "timing", "reset", "random", "replay"},
         .model_of_file = [this](const std::string&) { return models_.front().dut.name; },
         .shape = [this](const DutModel& model) { return shape(model); },
         .runs = [this](const DutModel& model, const std::string& test_case, const CommandLine& command_line,
                        const BenchOptions& base) { return runs(model, test_case, command_line, base); }});
    return status == 0 && wants_bins_ ? report_bins() : status;
  }

 private:
  [[nodiscard]] const WalkerParameters& parameters(const DutModel& model) const {
    return std::ranges::find(models_, model.name, [](const TileWalkerModel& known) { return known.dut.name; })
        ->parameters;
  }

  UnitShape shape(const DutModel& model) {
    const WalkerParameters& walker = parameters(model);
    coverage_ = std::make_unique<WalkCoverage>(walker);
    return {.input_words = InputWords(walker.widths()).all(),
            .output_fields = field_slots<TileJob>(walker.widths()),
            .latency = kLatency,
            .capacity = walker.fifo_depth,
            .timing = [this, walker] { return std::make_unique<WalkTiming>(walker, *coverage_); },
            .deadlock_cycles =
                kStalledCycles + static_cast<std::uint64_t>(walker.step_interval) * most_steps(walker)};
  }

  std::vector<BenchRun> runs(const DutModel& model, const std::string& test_case,
                             const CommandLine& command_line, const BenchOptions& base) {
    const WalkerParameters walker = parameters(model);
    wants_bins_ = command_line.test_case == "all" && command_line.coverage.empty();
    if (test_case == "timing") {
      return timing_runs(walker, base);
    }
    const auto list = [=](std::uint64_t seed, auto triangles) {
      return list_stimulus(walker, seed, std::move(triangles));
    };
    return case_runs(test_case, command_line, with_stalls(base, command_line),
                     {.directed = [=](std::uint64_t seed) { return list(seed, directed_triangles(walker)); },
                      .replay = [=, file = command_line.replay](
                                    std::uint64_t seed) { return list(seed, frame_triangles(file, walker)); },
                      .random = [=](std::uint64_t seed,
                                    std::uint64_t jobs) { return random_stimulus(walker, seed, jobs); }});
  }

  /// Without a stall: the directed triangles, large squares, random triangles.
  static std::vector<BenchRun> timing_runs(const WalkerParameters& walker, const BenchOptions& base) {
    std::vector<SetupTriangle> squares = square(0, 0, 8 * walker.block_size, walker);
    std::ranges::move(square(3, 5, walker.block_size, walker), std::back_inserter(squares));
    std::vector<SetupTriangle> any;
    Random random(base.seed);
    for (std::uint64_t i = 0; i < kTimingJobs / 10; ++i) {
      any.push_back(random_triangle(walker, random));
    }
    std::vector<BenchRun> runs;
    for (const std::vector<SetupTriangle>& list : {directed_triangles(walker), squares, any}) {
      BenchOptions options = base;
      options.full_rate_packets = modelled_cycles(list, walker) - kLatency;
      runs.push_back({"timing", options, [=] { return list_stimulus(walker, options.seed, list); }});
    }
    return runs;
  }

  [[nodiscard]] int report_bins() const {
    const std::vector<std::string> missed = coverage_->missed();
    const std::size_t hit = coverage_->bins() - missed.size();
    fmt::print("functional coverage: {} of {} bins\n", hit, coverage_->bins());
    for (const std::string& name : missed) {
      fmt::print("not covered: {}\n", name);
    }
    return missed.empty() ? 0 : kBinsMissed;
  }

  std::vector<TileWalkerModel> models_;
  std::unique_ptr<WalkCoverage> coverage_;
  bool wants_bins_ = false;
};

}  // namespace
}  // namespace halfspace::tb

int main(int argc, char** argv) { return halfspace::tb::TileWalkerBench().run(argc, argv); }
