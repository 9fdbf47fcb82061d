/// Bench of quad_generator: the RTL against model/halfspace/units/quad_generator.hpp.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "burst_timing.hpp"
#include "common/bench_cli.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/report/tile_job_file.hpp"
#include "halfspace/timing/contract.hpp"
#include "halfspace/units/quad_beats.hpp"
#include "models.hpp"
#include "quad_coverage.hpp"
#include "stimulus.hpp"

namespace halfspace::tb {
namespace {

constexpr std::uint64_t kTimingCoverages = 200;
constexpr int kBinsMissed = 18;  // exit status: all cases passed, but did not meet everything

/// The unit's part of the bench, with what its runs have in common.
class QuadGeneratorBench {
 public:
  [[nodiscard]] UnitShape shape(const DutModel& dut) {
    const QuadGeneratorModel& model = model_of(dut);
    const Widths widths = widths_of(model);
    coverage_ = std::make_unique<QuadCoverage>(widths, model.fifo_depth);
    UnitShape shape{words_for(packed_bits<Coverage>(widths)), field_slots<QuadBeat>(widths), kQuadLatency,
                    model.fifo_depth};
    shape.timing = [this, widths, depth = model.fifo_depth] {
      return std::make_unique<BurstTiming>(widths, depth, *coverage_);
    };
    return shape;
  }

  [[nodiscard]] std::vector<BenchRun> runs(const DutModel& dut, const std::string& test_case,
                                           const CommandLine& command_line, const BenchOptions& base);

  [[nodiscard]] std::string model_of_file(const std::string& file) const {
    const Widths widths = read_tile_jobs(file).widths;
    for (const QuadGeneratorModel& model : models_) {
      if (model.dut.tile_size == widths.TileSize && model.dut.sub_pixel_bits == widths.SubPixelBits) {
        return model.dut.name;
      }
    }
    throw InputError(fmt::format("{}: no model here has tile size {} and {} sub-pixel bits", file,
                                 widths.TileSize, widths.SubPixelBits));
  }

  [[nodiscard]] std::vector<DutModel> duts() const {
    std::vector<DutModel> duts;
    for (const QuadGeneratorModel& model : models_) {
      duts.push_back(model.dut);
    }
    return duts;
  }

  /// Reports the functional coverage. All bins must be hit when all cases have run.
  [[nodiscard]] int finish() const {
    if (!coverage_) {
      return 0;
    }
    const std::vector<std::string> missed = coverage_->missed();
    fmt::print("functional coverage: {} of {} bins\n", coverage_->bins() - missed.size(), coverage_->bins());
    static const std::set<std::string> kAll = {"directed", "timing", "reset", "random"};
    if (missed.empty() || !std::ranges::includes(cases_, kAll)) {
      return 0;
    }
    for (const std::string& bin : missed) {
      fmt::print("never met: {}\n", bin);
    }
    return kBinsMissed;
  }

 private:
  [[nodiscard]] const QuadGeneratorModel& model_of(const DutModel& dut) const {
    return *std::ranges::find(models_, dut.name,
                              [](const QuadGeneratorModel& model) { return model.dut.name; });
  }

  std::vector<QuadGeneratorModel> models_ = quad_generator_models();
  std::unique_ptr<QuadCoverage> coverage_;  ///< of all runs
  std::set<std::string> cases_;             ///< that have run
};

/// Beats of each coverage.
std::vector<std::int64_t> beats_of(const std::vector<Coverage>& coverages, const Widths& widths) {
  std::vector<std::int64_t> counts;
  for (const Coverage& coverage : coverages) {
    const QuadBurst burst = widths.TileSize == 4   ? quad_generator<4>(coverage)
                            : widths.TileSize == 8 ? quad_generator<8>(coverage)
                                                   : quad_generator<16>(coverage);
    counts.push_back(beats(popcount(burst.quads), widths.QuadWidth));
  }
  return counts;
}

/// The cycle after the one in which the last beat leaves, by the formula of docs/units/quad_generator.md,
/// when the source never idles, the sink is always ready and the first coverage is taken in cycle 0.
std::int64_t cycles_at_full_rate(const std::vector<std::int64_t>& counts, int fifo_depth) {
  const auto depth = static_cast<std::size_t>(fifo_depth);
  std::vector<std::int64_t> leave;
  std::int64_t next = 0;
  for (const std::int64_t count : counts) {
    const std::int64_t g = std::max(next, leave.size() < depth ? 0 : leave[leave.size() - depth] + 1);
    next = g + std::max<std::int64_t>(1, count);
    if (count > 0) {
      leave.push_back(g + kQuadLatency + count - 1);
    }
  }
  return leave.back() + 1;
}

/// Coverages back to back into a sink that is always ready: the last of them not empty.
std::vector<std::vector<Coverage>> timed_lists(const Widths& widths, std::uint64_t seed) {
  Random random(seed);
  const int width = widths.QuadWidth;
  std::vector<std::vector<Coverage>> lists;
  // At the borders between numbers of beats, and everything mixed.
  for (const int quads : {1, width, width + 1, 2 * width - 1, 2 * width, 2 * width + 1, widths.TileQuads}) {
    lists.emplace_back();
    for (std::uint64_t i = 0; i < kTimingCoverages; ++i) {
      lists.back().push_back(random_coverage(quads, widths, random));
    }
  }
  for (const std::uint64_t empty_share : {0u, 1u, 3u}) {
    lists.emplace_back();
    for (std::uint64_t i = 0; i < kTimingCoverages; ++i) {
      const bool empty = random.below(4) < empty_share;
      lists.back().push_back(
          random_coverage(empty ? 0 : static_cast<int>(random.range(1, widths.TileQuads)), widths, random));
    }
    lists.back().push_back(random_coverage(1, widths, random));
  }
  return lists;
}

std::vector<BenchRun> QuadGeneratorBench::runs(const DutModel& dut, const std::string& test_case,
                                               const CommandLine& command_line, const BenchOptions& base) {
  const QuadGeneratorModel& model = model_of(dut);
  const Widths widths = widths_of(model);
  cases_.insert(test_case);
  std::vector<BenchRun> runs;
  if (test_case == "timing") {
    for (const std::vector<Coverage>& list : timed_lists(widths, base.seed)) {
      BenchOptions options = base;
      options.full_rate_packets = static_cast<std::uint64_t>(
          cycles_at_full_rate(beats_of(list, widths), model.fifo_depth) - kQuadLatency);
      runs.push_back({test_case, options, [=] { return list_stimulus(widths, list); }});
    }
    return runs;
  }
  const auto list = [=](auto coverages) { return list_stimulus(widths, std::move(coverages)); };
  return case_runs(test_case, command_line, with_stalls(base, command_line),
                   {.directed = [=](std::uint64_t) { return list(directed_coverages(widths)); },
                    .replay =
                        [=](std::uint64_t) {
                          return list(coverages_of_jobs(replayed_jobs(command_line.replay, dut), widths));
                        },
                    .random = [=](std::uint64_t seed,
                                  std::uint64_t tiles) { return random_stimulus(widths, seed, tiles); }});
}

}  // namespace
}  // namespace halfspace::tb

int main(int argc, char** argv) {
  using namespace halfspace::tb;
  QuadGeneratorBench bench;
  const int status =
      bench_main(argc, argv,
                 {"quad_generator",
                  bench.duts(),
                  {"directed", "timing", "reset", "random", "replay"},
                  [&](const std::string& file) { return bench.model_of_file(file); },
                  [&](const DutModel& dut) { return bench.shape(dut); },
                  [&](const DutModel& dut, const std::string& test_case, const CommandLine& command_line,
                      const BenchOptions& base) { return bench.runs(dut, test_case, command_line, base); }});
  return status == 0 ? bench.finish() : status;
}
