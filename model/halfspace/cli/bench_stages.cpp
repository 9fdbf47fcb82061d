/// halfspace bench stages: what each stage of the functional model costs.
#include <fmt/format.h>

#include <memory>

#include "halfspace/cli/bench.hpp"
#include "halfspace/cli/load_input.hpp"
#include "halfspace/cli/options.hpp"
#include "halfspace/speed/speed_table.hpp"
#include "halfspace/speed/stage_cost.hpp"

namespace halfspace {
namespace {

struct StagesOptions {
  std::vector<std::string> inputs;
  MachineOptions machine;
  int repeat = 9;
};

void print_stages(const Frame& frame, const Config& config, int repeat) {
  const StageCosts costs = stage_costs(frame, config, repeat);
  double sum = 0;
  for (const StageCost& cost : costs.stages) {
    sum += median(cost.milliseconds);
  }
  for (const StageCost& cost : costs.stages) {
    const Spread ms = spread(cost.milliseconds);
    const std::string each =
        cost.items == 0 ? "-" : fmt::format("{:.2f}", ms.median * 1e6 / static_cast<double>(cost.items));
    fmt::print("| {} | {} | {:.2f} ({:.2f} to {:.2f}) | {:.1f}% | {} {}s | {} |\n", frame.name, cost.stage,
               ms.median, ms.least, ms.most, 100 * ms.median / sum, cost.items, cost.item, each);
  }
  const Spread functional = spread(costs.functional);
  fmt::print("| {} | all | {:.2f} | | functional: {:.2f} ({:.2f} to {:.2f}) ms | |\n", frame.name, sum,
             functional.median, functional.least, functional.most);
}

void bench_stages(const StagesOptions& options) {
  const Config config = options.machine.config();
  fmt::print(
      "one thread, medians of {} passes (least to most); a stage is the run up to it less the run up to the "
      "one "
      "before\n\n",
      options.repeat);
  fmt::print("| workload | stage | ms | share | works on | ns each |\n|---|---|---:|---:|---:|---:|\n");
  for (const std::string& input : options.inputs) {
    print_stages(load_input(input), config, options.repeat);
  }
}

}  // namespace

void add_bench_stages(CLI::App& bench) {
  auto options = std::make_shared<StagesOptions>();
  CLI::App* command = bench.add_subcommand("stages", "what each stage of the functional model costs");
  command->add_option("INPUT", options->inputs, "frames, meshes or synthetic:NAME")->required();
  options->machine.add_to(*command);
  command->add_option("--repeat", options->repeat, "number of timed passes")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->callback([options] { bench_stages(*options); });
}

}  // namespace halfspace
