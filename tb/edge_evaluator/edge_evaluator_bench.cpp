/// Bench of edge_evaluator: the RTL against model/halfspace/units/edge_evaluator.hpp.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/bench_cli.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/report/tile_job_file.hpp"
#include "models.hpp"
#include "stimulus.hpp"

namespace halfspace::tb {
namespace {

constexpr std::uint64_t kTimingTiles = 1000;
constexpr std::uint64_t kResetPeriod = 50;

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

std::vector<TileJob> replayed_jobs(const std::string& file, const DutModel& model) {
  TileJobFile jobs = read_tile_jobs(file);
  if (jobs.widths.TileSize != model.tile_size || jobs.widths.SubPixelBits != model.sub_pixel_bits) {
    throw InputError(fmt::format("{}: tile size {} and {} sub-pixel bits, but model {} has {} and {}", file,
                                 jobs.widths.TileSize, jobs.widths.SubPixelBits, model.name, model.tile_size,
                                 model.sub_pixel_bits));
  }
  return std::move(jobs.jobs);
}

std::vector<BenchRun> runs(const DutModel& model, const std::string& test_case,
                           const CommandLine& command_line, const BenchOptions& base) {
  const Widths widths = widths_of(model);
  std::vector<BenchRun> runs;
  if (test_case == "timing") {
    BenchOptions options = base;
    options.full_rate_packets = kTimingTiles;
    runs.push_back({test_case, options, [=] { return random_stimulus(widths, options.seed, kTimingTiles); }});
    return runs;
  }
  const std::vector<BenchOptions> all = with_stalls(base, command_line);
  for (BenchOptions options : all) {
    if (test_case == "directed") {
      options.probe_paths = true;
      runs.push_back({test_case, options, [=] { return list_stimulus(widths, directed_jobs(widths)); }});
    } else if (test_case == "replay") {
      runs.push_back({test_case, options,
                      [=] { return list_stimulus(widths, replayed_jobs(command_line.replay, model)); }});
    } else {
      options.reset_period = test_case == "reset" ? kResetPeriod : 0;
      const std::uint64_t count = (command_line.tiles + all.size() - 1) / all.size();
      runs.push_back({test_case, options, [=] { return random_stimulus(widths, options.seed, count); }});
    }
  }
  return runs;
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
