/// halfspace bench: how fast and how exact the model is.
#include "halfspace/cli/bench.hpp"

#include <CLI/CLI.hpp>

#include "halfspace/cli/commands.hpp"

namespace halfspace {

void add_bench_command(CLI::App& app, ExitStatus& status) {
  CLI::App* bench = app.add_subcommand("bench", "measure speed and error");
  bench->require_subcommand(1);
  add_bench_speed(*bench);
  add_bench_roof(*bench);
  add_bench_stages(*bench);
  add_bench_surfaces(*bench);
  add_bench_depth_traffic(*bench);
  add_bench_hi_z(*bench);
  add_bench_time(*bench);
  add_bench_sampled(*bench);
  add_bench_rtl(*bench);
  add_bench_idle(*bench);
  add_bench_read(*bench);
  add_bench_error(*bench, status);
}

}  // namespace halfspace
