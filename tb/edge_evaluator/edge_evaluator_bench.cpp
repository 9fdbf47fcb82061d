/// Bench of edge_evaluator: the RTL against model/halfspace/units/edge_evaluator.hpp.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/bench_cli.hpp"
#include "halfspace/report/tile_job_file.hpp"
#include "models.hpp"
#include "stimulus.hpp"

namespace halfspace::tb {
namespace {

constexpr std::uint64_t kTimingTiles = 1000;

Widths widths_of(const DutModel& model) {
  return Widths{.SubPixelBits = model.sub_pixel_bits, .TileSize = model.tile_size};
}

/// The cycle table of docs/units/edge_evaluator.md.
UnitShape shape(const DutModel& model) {
  const Widths widths = widths_of(model);
  return {words_for(packed_bits<TileJob>(widths)), field_slots<Coverage>(widths), model.pipe_stages + 1,
          model.pipe_stages + 2};
}

std::string model_of_file(const std::string& file) {
  const Widths widths = read_tile_jobs(file).widths;
  return fmt::format("t{}_s{}", widths.TileSize, widths.SubPixelBits);
}

std::vector<BenchRun> runs(const DutModel& model, const std::string& test_case,
                           const CommandLine& command_line, const BenchOptions& base) {
  const Widths widths = widths_of(model);
  if (test_case == "timing") {
    BenchOptions options = base;
    options.full_rate_packets = kTimingTiles;
    std::vector<BenchRun> runs;
    runs.push_back({test_case, options, [=] { return random_stimulus(widths, options.seed, kTimingTiles); }});
    return runs;
  }
  const auto list = [=](auto jobs) { return list_stimulus(widths, std::move(jobs)); };
  return case_runs(test_case, command_line, with_stalls(base, command_line),
                   {.directed = [=](std::uint64_t) { return list(directed_jobs(widths)); },
                    .replay = [=](std::uint64_t) { return list(replayed_jobs(command_line.replay, model)); },
                    .random = [=](std::uint64_t seed,
                                  std::uint64_t jobs) { return random_stimulus(widths, seed, jobs); }});
}

}  // namespace
}  // namespace halfspace::tb

int main(int argc, char** argv) {
  using namespace halfspace::tb;
  return bench_main(argc, argv,
                    {"edge_evaluator",
                     edge_evaluator_models(),
                     {"directed", "timing", "reset", "random", "replay"},
                     model_of_file,
                     shape,
                     runs});
}
