/// Bench of block_walker: the RTL against model/halfspace/units/block_walker.hpp.
#include <algorithm>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "block_coverage.hpp"
#include "block_timing.hpp"
#include "common/bench_cli.hpp"
#include "halfspace/config/config.hpp"
#include "halfspace/timing/contract.hpp"
#include "halfspace/timing/recurrence/core.hpp"
#include "halfspace/timing/recurrence/cycle_probe.hpp"
#include "halfspace/timing/recurrence/machine.hpp"
#include "halfspace/units/link_packets.hpp"
#include "halfspace/units/packing.hpp"
#include "models.hpp"
#include "stimulus.hpp"

namespace halfspace::tb {
namespace {

constexpr std::uint64_t kTimingTriangles = 200;
constexpr std::uint64_t kStalledCycles = 2000;  // longer than any stall profile holds a link
constexpr int kBinsMissed = 18;                 // exit status, after those of FailureKind

/// Steps of the largest triangle that a bench sends: every cell may be without a tile, and looked at twice.
std::uint64_t most_steps(const BlockWalkerParameters& walker) {
  const WalkSizes& sizes = walker.sizes;
  const auto across =
      static_cast<std::uint64_t>(2048 / (walker.levels == 1 ? sizes.tile_size : sizes.block_size));
  return 2 * across * across;
}

/// The cycles from the first triangle until the last block has left, by the model's own timing engine, where
/// nothing but the block walker takes time: behind it every block has one tile.
std::uint64_t modelled_cycles(const std::vector<SetupTriangle>& triangles,
                              const BlockWalkerParameters& parameters) {
  Config config;
  config.block_walker.fifo = parameters.fifo_depth;
  config.setup.queue = config.setup.fifo = config.tile_walker.fifo = config.edge_evaluator.fifo =
      config.quad_generator.fifo = kMostCredits;
  PacketTimes times;
  CycleProbe<true> probe(capacities(config), &times);
  RecurrenceMemory<OneMachine> memory = recurrence_memory(config, 0);
  RecurrenceCore<OneMachine, NoStalls, CycleProbe<true>> core(memory, NoStalls{}, probe);
  const Widths widths = parameters.sizes.widths();
  std::vector<std::uint32_t> words(InputWords(widths).triangle);
  for (const SetupTriangle& triangle : triangles) {
    pack(to_packet(triangle, parameters.walker()), widths, words);
    core.drawn();
    std::uint32_t empty = 0;
    for (const BlockStep& step : reference_walk(words, 0, parameters)) {
      if (step.leaves()) {
        core.block(empty, 1);
        core.job({});
        core.block_done();
      }
      empty = step.leaves() ? 0 : empty + 1;
    }
    core.walked(empty);
  }
  return times.emit.back() - times.accept.front() + 1;
}

/// The bench as a whole: its models, and the bins of the one at work.
class BlockWalkerBench {
 public:
  BlockWalkerBench() : models_(block_walker_models()) {}

  int run(int argc, char** argv) {
    std::vector<DutModel> models;
    for (const BlockWalkerModel& model : models_) {
      models.push_back(model.dut);
    }
    const int status = bench_main(
        argc, argv,
        {.unit = "block_walker",
         .models = std::move(models),
         .cases = {"directed", "timing", "reset", "random", "replay"},
         .model_of_file = [this](const std::string&) { return models_.front().dut.name; },
         .shape = [this](const DutModel& model) { return shape(model); },
         .runs = [this](const DutModel& model, const std::string& test_case, const CommandLine& command_line,
                        const BenchOptions& base) { return runs(model, test_case, command_line, base); }});
    return status != 0 || !wants_bins_ || coverage_->report() ? status : kBinsMissed;
  }

 private:
  [[nodiscard]] const BlockWalkerParameters& parameters(const DutModel& model) const {
    return std::ranges::find(models_, model.name,
                             [](const BlockWalkerModel& known) { return known.dut.name; })
        ->parameters;
  }

  UnitShape shape(const DutModel& model) {
    const BlockWalkerParameters& walker = parameters(model);
    const Widths widths = walker.sizes.widths();
    coverage_ = std::make_unique<BlockCoverage>(walker);
    return {.input_words = InputWords(widths).all(),
            .output_fields = field_slots<BlockJob>(widths),
            .latency = kBlockLatency,
            .capacity = walker.fifo_depth,
            .timing = [this, walker] { return std::make_unique<BlockTiming>(walker, *coverage_); },
            .deadlock_cycles = kStalledCycles + most_steps(walker)};
  }

  std::vector<BenchRun> runs(const DutModel& model, const std::string& test_case,
                             const CommandLine& command_line, const BenchOptions& base) {
    const BlockWalkerParameters walker = parameters(model);
    wants_bins_ = command_line.test_case == "all" && command_line.coverage.empty();
    if (test_case == "timing") {
      return timing_runs(walker, base);
    }
    const auto list = [=](std::uint64_t seed, auto triangles) {
      return list_stimulus(walker, seed, std::move(triangles));
    };
    return case_runs(
        test_case, command_line, with_stalls(base, command_line),
        {.directed = [=](std::uint64_t seed) { return list(seed, directed_triangles(walker.sizes)); },
         .replay = [=, file = command_line.replay](
                       std::uint64_t seed) { return list(seed, frame_triangles(file, walker.sizes)); },
         .random = [=](std::uint64_t seed,
                       std::uint64_t blocks) { return random_stimulus(walker, seed, blocks); }});
  }

  /// Without a stall: the directed triangles, large squares, random triangles.
  static std::vector<BenchRun> timing_runs(const BlockWalkerParameters& walker, const BenchOptions& base) {
    const WalkSizes& sizes = walker.sizes;
    std::vector<SetupTriangle> squares = square_triangles(0, 0, 8 * sizes.block_size, sizes);
    std::ranges::move(square_triangles(3, 5, sizes.block_size, sizes), std::back_inserter(squares));
    std::vector<SetupTriangle> any;
    Random random(base.seed);
    for (std::uint64_t i = 0; i < kTimingTriangles; ++i) {
      any.push_back(random_triangle(sizes, random));
    }
    std::vector<BenchRun> runs;
    for (const std::vector<SetupTriangle>& list : {directed_triangles(sizes), squares, any}) {
      BenchOptions options = base;
      options.full_rate_packets = modelled_cycles(list, walker) - kBlockLatency;
      runs.push_back({"timing", options, [=] { return list_stimulus(walker, options.seed, list); }});
    }
    return runs;
  }

  std::vector<BlockWalkerModel> models_;
  std::unique_ptr<BlockCoverage> coverage_;
  bool wants_bins_ = false;
};

}  // namespace
}  // namespace halfspace::tb

int main(int argc, char** argv) { return halfspace::tb::BlockWalkerBench().run(argc, argv); }
