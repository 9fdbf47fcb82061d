/// halfspace bench idle: what the engines with modules do where nothing happens, and what it costs.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "halfspace/cli/bench.hpp"
#include "halfspace/cli/load_input.hpp"
#include "halfspace/cli/options.hpp"
#include "halfspace/cli/percent.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/timing/rtl/rest_skipper.hpp"
#include "halfspace/timing/rtl/run_rtl.hpp"
#include "halfspace/timing/systemc/run_systemc.hpp"

namespace halfspace {
namespace {

struct IdleOptions {
  std::vector<std::string> inputs;
  MachineOptions machine;
  RtlOptions rtl;
  int repeat = 3;
};

void print_idle(const Frame& frame, const std::string& machine, const Config& config,
                const IdleOptions& options) {
  std::uint64_t activations = 0;
  std::vector<double> systemc;
  std::vector<double> every;
  std::vector<double> skipping;
  rtl::RestCounts counts;
  FrameCycles cycles;
  for (int i = 0; i < options.repeat; ++i) {
    systemc.push_back(processor_milliseconds(
        [&] { cycles = run_systemc(frame, config, {}, {.vcd = {}, .activations = &activations}).cycles; }));
    const std::unique_ptr<rtl::VerilatedPipeline> evaluated = options.rtl.pipeline(config);
    FrameCycles all;
    every.push_back(
        processor_milliseconds([&] { all = run_rtl(frame, config, {}, *evaluated).timed.cycles; }));
    counts = {};
    const std::unique_ptr<rtl::VerilatedPipeline> skipped =
        rtl::skipping_rests(options.rtl.pipeline(config), &counts);
    FrameCycles same;
    skipping.push_back(
        processor_milliseconds([&] { same = run_rtl(frame, config, {}, *skipped).timed.cycles; }));
    if (all != cycles || same != cycles) {
      throw DisagreementError(fmt::format("{}: runs disagree: systemc {}, rtl {}, skipping {} cycles",
                                          frame.name, cycles.cycles, all.cycles, same.cycles));
    }
  }
  fmt::print("| {} | {} | {} | {} | {:.2f} | {:.0f} | {:.1f} | {:.0f} | {:.0f} | {:.2f} |\n", machine,
             frame.name, cycles.cycles, activations,
             static_cast<double>(activations) / static_cast<double>(cycles.cycles), median(systemc),
             percent(counts.skipped, counts.skipped + counts.evaluated), median(every), median(skipping),
             median(every) / median(skipping));
}

void bench_idle(IdleOptions options) {
  options.rtl.every_cycle = true;
  const Config config = options.machine.config();
  std::string machine =
      options.machine.file.empty() ? "default" : std::filesystem::path(options.machine.file).stem().string();
  for (const std::string& setting : options.machine.settings) {
    machine += " " + setting;
  }
  fmt::print("time of the processor, {} run(s) in turns; the RTL with everything compared\n\n",
             options.repeat);
  fmt::print(
      "| machine | frame | cycles | activations of SystemC | a cycle | systemc, ms | cycles of the RTL "
      "skipped, % | "
      "rtl, every cycle, ms | skipping, ms | every / skipping |\n");
  fmt::print("|---|---|---:|---:|---:|---:|---:|---:|---:|---:|\n");
  for (const std::string& input : options.inputs) {
    print_idle(load_input(input), machine, config, options);
  }
}

}  // namespace

void add_bench_idle(CLI::App& bench) {
  auto options = std::make_shared<IdleOptions>();
  CLI::App* command = bench.add_subcommand(
      "idle", "how often SystemC runs a process, and the cycles in which the RTL is not evaluated");
  command->add_option("INPUT", options->inputs, "frames, meshes or synthetic:NAME")->required();
  options->machine.add_to(*command);
  options->rtl.add_folder_to(*command);
  command->add_option("--repeat", options->repeat, "number of timed runs")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->callback([options] { bench_idle(*options); });
}

}  // namespace halfspace
