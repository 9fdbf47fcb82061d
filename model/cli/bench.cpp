/// halfspace bench: how fast the model is.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>

#include "halfspace/cli/commands.hpp"
#include "halfspace/cli/options.hpp"
#include "halfspace/timing/functional.hpp"

namespace halfspace {
namespace {

struct SpeedOptions {
  InputOptions input;
  MachineOptions machine;
  int repeat = 9;
};

/// Times what `run` does between reading and writing files: front end, units, counters and per-pixel counts.
void bench_speed(const SpeedOptions& options) {
  const Config config = options.machine.config();
  const Frame frame = options.input.frame();
  std::vector<double> seconds;
  Counters counters;
  for (int i = 0; i <= options.repeat; ++i) {
    const auto start = std::chrono::steady_clock::now();
    counters = run_functional(frame, config, false, nullptr).counters;
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    if (i > 0) {  // the first run warms caches and page tables
      seconds.push_back(time.count());
    }
  }
  std::sort(seconds.begin(), seconds.end());
  const double median = seconds[seconds.size() / 2];
  const auto rate = [&](std::uint64_t count) { return static_cast<double>(count) / median / 1e6; };
  fmt::print("{}: functional, one thread, {} runs: min {:.1f} median {:.1f} max {:.1f} ms\n", frame.name,
             options.repeat, seconds.front() * 1e3, median * 1e3, seconds.back() * 1e3);
  fmt::print("  at the median: {:.1f} Mquads/s, {:.1f} Mfragments/s, {:.2f} Mtriangles/s\n",
             rate(counters.quad_generator.quads), rate(counters.quad_generator.fragments),
             rate(counters.front_end.triangles));
}

}  // namespace

void add_bench_command(CLI::App& app, int& /*status*/) {
  CLI::App* bench = app.add_subcommand("bench", "measure the model");
  bench->require_subcommand(1);
  auto options = std::make_shared<SpeedOptions>();
  CLI::App* speed =
      bench->add_subcommand("speed", "quads a second of the functional model, quads not stored");
  options->input.add_to(*speed);
  options->machine.add_to(*speed);
  speed->add_option("--repeat", options->repeat, "timed runs")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  speed->callback([options] { bench_speed(*options); });
}

}  // namespace halfspace
