/// Bench of tile_walker: the RTL against model/halfspace/units/tile_walker.hpp.
#include <algorithm>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/bench_cli.hpp"
#include "halfspace/config/config.hpp"
#include "halfspace/timing/contract.hpp"
#include "halfspace/timing/recurrence/core.hpp"
#include "halfspace/timing/recurrence/cycle_probe.hpp"
#include "halfspace/timing/recurrence/machine.hpp"
#include "halfspace/units/packing.hpp"
#include "models.hpp"
#include "stimulus.hpp"
#include "tile_coverage.hpp"
#include "tile_timing.hpp"

namespace halfspace::tb {
namespace {

constexpr std::uint64_t kTimingTriangles = 200;
constexpr int kBinsMissed = 18;  // exit status, after those of FailureKind

/// The cycles from the first block until the last job has left, by the model's own timing engine, where
/// nothing but the tile walker takes time: all blocks are of one triangle, and come one a cycle.
std::uint64_t modelled_cycles(const std::vector<BlockJob>& blocks, const TileWalkerParameters& parameters) {
  Config config;
  config.tile_walker.fifo = parameters.fifo_depth;
  config.block_walker.fifo = config.edge_evaluator.fifo = config.quad_generator.fifo = kMostCredits;
  PacketTimes times;
  CycleProbe<true> probe(capacities(config), &times);
  RecurrenceMemory<OneMachine> memory = recurrence_memory(config, 0);
  RecurrenceCore<OneMachine, NoStalls, CycleProbe<true>> core(memory, NoStalls{}, probe);
  core.drawn();
  for (const BlockJob& block : blocks) {
    const std::size_t jobs = tile_jobs(block, parameters).size();
    core.block(0, static_cast<int>(jobs));
    for (std::size_t left = jobs; left > 0; --left) {
      core.job({});
    }
    core.block_done();
  }
  core.walked(0);
  return times.e.back() - times.emit.front() + 1;
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
    return status != 0 || !wants_bins_ || coverage_->report() ? status : kBinsMissed;
  }

 private:
  [[nodiscard]] const TileWalkerParameters& parameters(const DutModel& model) const {
    return std::ranges::find(models_, model.name, [](const TileWalkerModel& known) { return known.dut.name; })
        ->parameters;
  }

  UnitShape shape(const DutModel& model) {
    const TileWalkerParameters& walker = parameters(model);
    const Widths widths = walker.sizes.widths();
    coverage_ = std::make_unique<TileCoverage>(walker);
    return {.input_words = words_for(packed_bits<BlockJob>(widths)),
            .output_fields = field_slots<TileJob>(widths),
            .latency = kTileLatency,
            .capacity = walker.fifo_depth,
            .timing = [this, walker] { return std::make_unique<TileTiming>(walker, *coverage_); },
            .reads_ahead = true};
  }

  std::vector<BenchRun> runs(const DutModel& model, const std::string& test_case,
                             const CommandLine& command_line, const BenchOptions& base) {
    const TileWalkerParameters walker = parameters(model);
    wants_bins_ = command_line.test_case == "all" && command_line.coverage.empty();
    if (test_case == "timing") {
      return timing_runs(walker, base);
    }
    const auto list = [=](std::uint64_t seed, const auto& triangles) {
      return list_stimulus(walker, seed, block_jobs(triangles, walker.sizes));
    };
    return case_runs(
        test_case, command_line, with_stalls(base, command_line),
        {.directed = [=](std::uint64_t seed) { return list(seed, directed_triangles(walker.sizes)); },
         .replay = [=, file = command_line.replay](
                       std::uint64_t seed) { return list(seed, frame_triangles(file, walker.sizes)); },
         .random = [=](std::uint64_t seed,
                       std::uint64_t jobs) { return random_stimulus(walker, seed, jobs); }});
  }

  /// Without a stall: the blocks of the directed triangles, of large squares, of random triangles.
  static std::vector<BenchRun> timing_runs(const TileWalkerParameters& walker, const BenchOptions& base) {
    const WalkSizes& sizes = walker.sizes;
    std::vector<SetupTriangle> squares = square_triangles(0, 0, 8 * sizes.block_size, sizes);
    std::ranges::move(square_triangles(3, 5, sizes.block_size, sizes), std::back_inserter(squares));
    std::vector<SetupTriangle> any;
    Random random(base.seed);
    for (std::uint64_t i = 0; i < kTimingTriangles; ++i) {
      any.push_back(random_triangle(sizes, random));
    }
    std::vector<BenchRun> runs;
    for (const std::vector<SetupTriangle>& triangles : {directed_triangles(sizes), squares, any}) {
      const std::vector<BlockJob> blocks = block_jobs(triangles, sizes);
      BenchOptions options = base;
      options.full_rate_packets = modelled_cycles(blocks, walker) - kTileLatency;
      runs.push_back({"timing", options, [=] { return list_stimulus(walker, options.seed, blocks); }});
    }
    return runs;
  }

  std::vector<TileWalkerModel> models_;
  std::unique_ptr<TileCoverage> coverage_;
  bool wants_bins_ = false;
};

}  // namespace
}  // namespace halfspace::tb

int main(int argc, char** argv) { return halfspace::tb::TileWalkerBench().run(argc, argv); }
