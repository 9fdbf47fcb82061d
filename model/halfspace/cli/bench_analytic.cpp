/// halfspace bench analytic: how far the analytic fidelity is from the recurrence.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "halfspace/cli/bench.hpp"
#include "halfspace/cli/options.hpp"
#include "halfspace/scene/load.hpp"
#include "halfspace/timing/analytic/analytic.hpp"
#include "halfspace/timing/recurrence/run_recurrence.hpp"

namespace halfspace {
namespace {

struct AnalyticOptions {
  std::vector<std::string> inputs;
  std::vector<std::string> configs;
};

/// A draw shorter than this counts for the sum of draws only: its error is fill and drain, not its work.
constexpr std::uint64_t kShortDraw = 1000;

double percent_off(std::uint64_t estimate, std::uint64_t cycles) {
  return 100.0 * (static_cast<double>(estimate) - static_cast<double>(cycles)) /
         static_cast<double>(std::max<std::uint64_t>(cycles, 1));
}

void print_error(const Frame& frame, const std::string& name, const Config& config) {
  const AnalyticFrame estimate = run_analytic(frame, config).estimate;
  const FrameCycles recurrence = run_recurrence(frame, config).cycles;
  double sum = 0;
  double worst = 0;
  std::uint64_t long_draws = 0;
  std::uint64_t off = 0;  // cycles by which draws are off, all of them
  std::uint64_t spans = 0;
  std::uint64_t before = 0;
  for (std::size_t i = 0; i < estimate.draws.size(); ++i) {
    const std::uint64_t span = recurrence.draws[i].end - before;
    before = recurrence.draws[i].end;
    const std::uint64_t cycles = estimate.draws[i].cycles;
    off += cycles > span ? cycles - span : span - cycles;
    spans += span;
    if (span < kShortDraw) {
      continue;
    }
    ++long_draws;
    const double error = percent_off(cycles, span);
    sum += std::abs(error);
    worst = std::abs(error) > std::abs(worst) ? error : worst;
  }
  fmt::print("| {} | {} | {} | {} | {:+.1f} | {:.1f} | {} | {:.1f} | {:+.1f} |\n", frame.name, name,
             recurrence.cycles, estimate.cycles, percent_off(estimate.cycles, recurrence.cycles),
             100.0 * static_cast<double>(off) / static_cast<double>(std::max<std::uint64_t>(spans, 1)),
             long_draws, long_draws == 0 ? 0 : sum / static_cast<double>(long_draws), worst);
}

void bench_analytic(const AnalyticOptions& options) {
  fmt::print(
      "| frame | machine | cycles | analytic | error % | mean error of draws, by cycles % | draws of {} "
      "cycles or more | their mean error % | worst % |\n",
      kShortDraw);
  fmt::print("|---|---|---:|---:|---:|---:|---:|---:|---:|\n");
  for (const std::string& input : options.inputs) {
    const Frame frame = load(input);
    if (options.configs.empty()) {
      print_error(frame, "default", Config{});
    }
    for (const std::string& file : options.configs) {
      const Config config = read_config(file);
      validate(config);
      print_error(frame, std::filesystem::path(file).stem().string(), config);
    }
  }
}

}  // namespace

void add_bench_analytic(CLI::App& bench) {
  auto options = std::make_shared<AnalyticOptions>();
  CLI::App* command =
      bench.add_subcommand("analytic", "error of the analytic fidelity against the recurrence");
  command->add_option("INPUT", options->inputs, "frames, meshes or synthetic:NAME")->required();
  command->add_option("--config", options->configs, "configuration file, repeatable")
      ->type_name("FILE")
      ->allow_extra_args(false);
  command->callback([options] { bench_analytic(*options); });
}

}  // namespace halfspace
