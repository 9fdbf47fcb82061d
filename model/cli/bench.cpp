/// halfspace bench: how fast the model is.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>

#include "halfspace/cli/commands.hpp"
#include "halfspace/cli/options.hpp"
#include "halfspace/scene/load.hpp"
#include "halfspace/timing/functional.hpp"

namespace halfspace {
namespace {

struct SpeedOptions {
  std::vector<std::string> inputs;
  MachineOptions machine;
  int repeat = 9;
};

/// Times what `run` does between reading and writing files: front end, units, counters and per-pixel counts.
void print_speed(const Frame& frame, const Config& config, int repeat) {
  std::vector<double> seconds;
  Counters counters;
  for (int i = 0; i <= repeat; ++i) {
    const auto start = std::chrono::steady_clock::now();
    counters = run_functional(frame, config, false, nullptr).counters;
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    if (i > 0) {  // the first run warms caches and page tables
      seconds.push_back(time.count());
    }
  }
  std::sort(seconds.begin(), seconds.end());
  const double median = seconds[seconds.size() / 2];
  fmt::print("| {} | {} | {} | {} | {:.1f} | {:.1f} | {:.1f} | {:.1f} |\n", frame.name,
             counters.front_end.triangles, counters.quad_generator.fragments, counters.quad_generator.quads,
             seconds.front() * 1e3, median * 1e3, seconds.back() * 1e3,
             static_cast<double>(counters.quad_generator.quads) / median / 1e6);
}

void bench_speed(const SpeedOptions& options) {
  const Config config = options.machine.config();
  fmt::print("functional, one thread, {} runs\n\n", options.repeat);
  fmt::print("| frame | triangles | fragments | quads | min ms | median ms | max ms | Mquads/s |\n");
  fmt::print("|---|---:|---:|---:|---:|---:|---:|---:|\n");
  for (const std::string& input : options.inputs) {
    print_speed(load(input), config, options.repeat);
  }
}

}  // namespace

void add_bench_command(CLI::App& app, int& /*status*/) {
  CLI::App* bench = app.add_subcommand("bench", "measure the model");
  bench->require_subcommand(1);
  auto options = std::make_shared<SpeedOptions>();
  CLI::App* speed =
      bench->add_subcommand("speed", "quads a second of the functional model, quads not stored");
  speed->add_option("INPUT", options->inputs, "frames or meshes")->required();
  options->machine.add_to(*speed);
  speed->add_option("--repeat", options->repeat, "timed runs")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  speed->callback([options] { bench_speed(*options); });
}

}  // namespace halfspace
