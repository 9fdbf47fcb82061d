/// halfspace bench rtl: how fast the verilated pipeline simulates, alone and with everything compared.
#include <fmt/format.h>

#include <memory>

#include "halfspace/cli/bench.hpp"
#include "halfspace/cli/load_input.hpp"
#include "halfspace/cli/options.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/timing/recurrence/run_recurrence.hpp"
#include "halfspace/timing/rtl/input_trace.hpp"
#include "halfspace/timing/rtl/run_rtl.hpp"

namespace halfspace {
namespace {

struct RtlBenchOptions {
  std::vector<std::string> inputs;
  MachineOptions machine;
  RtlOptions rtl;
  int repeat = 5;
};

void print_speed(const Frame& frame, const Config& config, const RtlOptions& rtl, int repeat) {
  rtl::InputTrace trace;
  const FrameCycles first =
      run_rtl(frame, config, {}, *rtl::traced(rtl.pipeline(config), trace)).timed.cycles;
  std::vector<double> alone;
  std::vector<double> checked;
  std::vector<double> model;
  for (int i = 0; i < repeat; ++i) {
    const std::unique_ptr<rtl::VerilatedPipeline> played = rtl.pipeline(config);
    std::uint64_t digest = 0;
    alone.push_back(milliseconds([&] { digest = trace.play(*played); }));
    const std::unique_ptr<rtl::VerilatedPipeline> run = rtl.pipeline(config);
    FrameCycles again;
    checked.push_back(milliseconds([&] { again = run_rtl(frame, config, {}, *run).timed.cycles; }));
    FrameCycles recurrence;
    model.push_back(milliseconds([&] { recurrence = run_recurrence(frame, config).cycles; }));
    if (digest != trace.digest() || again != first || recurrence != first) {
      throw DisagreementError(fmt::format("{}: runs disagree: rtl {} and {}, recurrence {} cycles",
                                          frame.name, first.cycles, again.cycles, recurrence.cycles));
    }
  }
  const auto cycles = static_cast<double>(first.cycles);
  fmt::print("| {} | {} | {:.0f} | {:.3f} | {:.0f} | {:.3f} | {:.2f} | {:.0f} | {:.0f} |\n", frame.name,
             first.cycles, median(alone), cycles / median(alone) / 1e3, median(checked),
             cycles / median(checked) / 1e3, median(model), median(alone) / median(model),
             median(checked) / median(model));
}

void bench_rtl(const RtlBenchOptions& options) {
  const Config config = options.machine.config();
  fmt::print("medians of {} runs in turns; alone: recorded inputs played back, outputs ignored\n\n",
             options.repeat);
  fmt::print(
      "| frame | cycles | alone, ms | Mcycles/s | with checks, ms | Mcycles/s | recurrence, ms | "
      "times faster than alone | than with checks |\n");
  fmt::print("|---|---:|---:|---:|---:|---:|---:|---:|---:|\n");
  for (const std::string& input : options.inputs) {
    print_speed(load_input(input), config, options.rtl, options.repeat);
  }
}

}  // namespace

void add_bench_rtl(CLI::App& bench) {
  auto options = std::make_shared<RtlBenchOptions>();
  CLI::App* command = bench.add_subcommand("rtl", "speed of the verilated pipeline, in cycles a second");
  command->add_option("INPUT", options->inputs, "frames, meshes or synthetic:NAME")->required();
  options->machine.add_to(*command);
  options->rtl.add_to(*command);
  command->add_option("--repeat", options->repeat, "number of timed runs")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->callback([options] { bench_rtl(*options); });
}

}  // namespace halfspace
