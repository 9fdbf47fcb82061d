/// halfspace bench speed: quads a second of the functional model.
#include <fmt/format.h>

#include <memory>

#include "halfspace/cli/bench.hpp"
#include "halfspace/cli/options.hpp"
#include "halfspace/machine/functional.hpp"
#include "halfspace/scene/load.hpp"

namespace halfspace {
namespace {

struct SpeedOptions {
  std::vector<std::string> inputs;
  MachineOptions machine;
  int repeat = 9;
};

/// Times what `run` does between reading and writing files: front end, units, counters and per-pixel counts.
void print_speed(const Frame& frame, const Config& config, int repeat) {
  std::vector<double> times;
  Counters counters;
  for (int i = 0; i <= repeat; ++i) {
    const double time = milliseconds([&] { counters = run_functional(frame, config).counters; });
    if (i > 0) {  // the first run warms caches and page tables
      times.push_back(time);
    }
  }
  const auto [least, most] = std::minmax_element(times.begin(), times.end());
  fmt::print("| {} | {} | {} | {} | {:.1f} | {:.1f} | {:.1f} | {:.1f} |\n", frame.name,
             counters.front_end.triangles, counters.quad_generator.fragments, counters.quad_generator.quads,
             *least, median(times), *most,
             static_cast<double>(counters.quad_generator.quads) / median(times) / 1e3);
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

void add_bench_speed(CLI::App& bench) {
  auto options = std::make_shared<SpeedOptions>();
  CLI::App* speed = bench.add_subcommand("speed", "speed of the functional model, in quads a second");
  speed->add_option("INPUT", options->inputs, "frames, meshes or synthetic:NAME")->required();
  options->machine.add_to(*speed);
  speed->add_option("--repeat", options->repeat, "number of timed runs")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  speed->callback([options] { bench_speed(*options); });
}

}  // namespace halfspace
