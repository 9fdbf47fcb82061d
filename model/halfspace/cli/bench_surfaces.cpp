/// halfspace bench surfaces: what a large depth surface costs where little of it is drawn on.
#include <fmt/format.h>

#include <memory>

#include "halfspace/cli/bench.hpp"
#include "halfspace/cli/options.hpp"
#include "halfspace/core/functional.hpp"
#include "halfspace/speed/speed_table.hpp"
#include "halfspace/speed/surface_cost.hpp"
#include "halfspace/timing/recurrence/run_recurrence.hpp"

namespace halfspace {
namespace {

struct SurfacesOptions {
  MachineOptions machine;
  std::uint32_t side = 16384;
  int repeat = 5;
};

/// Costs of one engine on one frame.
struct Costs {
  std::vector<double> milliseconds;
  std::vector<double> megabytes;

  void add(const RunCost& cost) {
    milliseconds.push_back(cost.milliseconds);
    megabytes.push_back(cost.megabytes);
  }
  [[nodiscard]] std::string cells(std::uint64_t tiles) const {
    const Spread ms = spread(milliseconds);
    const std::string each =
        tiles == 0 ? "-" : fmt::format("{:.0f}", ms.median * 1e6 / static_cast<double>(tiles));
    return fmt::format("{:.2f} ({:.2f} to {:.2f}) | {} | {:.1f}", ms.median, ms.least, ms.most, each,
                       median(megabytes));
  }
};

void print_row(const char* name, std::uint64_t tiles, const Frame& frame, const Config& config, int repeat) {
  Costs functional;
  Costs recurrence;
  for (int pass = 0; pass < repeat; ++pass) {
    functional.add(cost_of_fresh_run([&] { run_functional(frame, config); }));
    recurrence.add(cost_of_fresh_run([&] { run_recurrence(frame, config, {}); }));
  }
  fmt::print("| {} | {} | {} | {} |\n", name, tiles, functional.cells(tiles), recurrence.cells(tiles));
}

void bench_surfaces(const SurfacesOptions& options) {
  const Config config = options.machine.config();
  const SurfaceFrames frames{.side = options.side,
                             .tile_side = static_cast<std::uint32_t>(config.tile_walker.tile_size)};
  fmt::print(
      "one thread, medians of {} runs (least to most), each in a process of its own; {}x{} pixels, {}x{} a "
      "tile; MB: memory at the peak, more than before the run\n\n",
      options.repeat, frames.side, frames.side, frames.tile_side, frames.tile_side);
  fmt::print(
      "| drawn | tiles touched | functional ms | ns a tile | MB | recurrence ms | ns a tile | MB |\n"
      "|---|---:|---:|---:|---:|---:|---:|---:|\n");
  print_row("nothing", 0, frames.cleared(0), config, options.repeat);
  print_row("a clear", 0, frames.cleared(1), config, options.repeat);
  print_row("1000 clears", 0, frames.cleared(1000), config, options.repeat);
  const std::uint32_t most = frames.side / frames.tile_side / 2;
  for (std::uint32_t tiles = std::max(most / 32, 1u); tiles <= most; tiles *= 2) {
    print_row("a square", std::uint64_t{tiles} * tiles, frames.block(tiles), config, options.repeat);
  }
  for (std::uint32_t tiles = std::max(most / 32, 1u); tiles <= most; tiles *= 2) {
    print_row("scattered", std::uint64_t{tiles} * tiles, frames.scattered(tiles * tiles), config,
              options.repeat);
  }
}

}  // namespace

void add_bench_surfaces(CLI::App& bench) {
  auto options = std::make_shared<SurfacesOptions>();
  CLI::App* command =
      bench.add_subcommand("surfaces", "time and memory of a large depth surface, by the tiles touched");
  options->machine.add_to(*command);
  command->add_option("--side", options->side, "pixels of the surface on a side")
      ->check(CLI::IsMember({128, 1024, 2048, 4096, 8192, 16384}))
      ->capture_default_str();
  command->add_option("--repeat", options->repeat, "number of timed runs of each")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->callback([options] { bench_surfaces(*options); });
}

}  // namespace halfspace
