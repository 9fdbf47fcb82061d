/// halfspace bench time: what it costs to know the time, fidelity by fidelity, in turns on the same machine.
#include <fmt/format.h>

#include <memory>

#include "halfspace/cli/bench.hpp"
#include "halfspace/cli/load_input.hpp"
#include "halfspace/cli/options.hpp"
#include "halfspace/core/functional.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/speed/speed_table.hpp"
#include "halfspace/timing/record/retime.hpp"
#include "halfspace/timing/recurrence/run_recurrence.hpp"
#include "halfspace/timing/systemc/run_systemc.hpp"

namespace halfspace {
namespace {

struct TimeOptions {
  std::vector<std::string> inputs;
  MachineOptions machine;
  ThreadsOption threads;
  int repeat = 9;
};

/// 64 machines around `config`, with its z cache.
std::vector<Config> neighbours(const Config& config) {
  std::vector<Config> machines;
  for (const int latency : {25, 50, 100, 200}) {
    for (const int jobs : {4, 8, 16, 32}) {
      for (const int pending : {8, 16, 32, 64}) {
        Config machine = config;
        machine.memory.latency = latency;
        machine.tile_walker.fifo = jobs;
        machine.early_z.pending = pending;
        machines.push_back(machine);
      }
    }
  }
  return machines;
}

void print_times(const Frame& frame, const Config& config, const TimeOptions& options) {
  const Watch watch{.threads = options.threads.count};
  EngineOptions timed;
  timed.watch = watch;
  std::vector<double> functional;
  std::vector<double> recurrence;
  std::vector<double> systemc;
  std::vector<double> one;
  std::vector<double> batch;
  std::vector<double> sampled;
  std::vector<double> singly;
  std::uint64_t cycles = 0;
  std::uint64_t events = 0;
  Retimer retimer(record_frame(frame, config), watch.threads);
  const std::vector<Config> machines = neighbours(config);
  for (int i = 0; i <= options.repeat; ++i) {
    RetimedFrame retimed;
    std::vector<RetimedFrame> all;
    std::vector<RetimedFrame> each;
    const double times[] = {
        milliseconds([&] { run_functional(frame, config, watch); }),
        milliseconds([&] { cycles = run_recurrence(frame, config, timed).cycles.cycles; }),
        milliseconds([&] { events = run_systemc(frame, config).cycles.cycles; }),
        milliseconds([&] { retimed = retimer.retime(config); }),
        milliseconds([&] { all = retimer.retime(machines); }),
        milliseconds([&] { retimer.estimate(machines); }),
        milliseconds([&] {
          for (const Config& machine : machines) {
            each.push_back(retimer.retime(machine));
          }
        }),
    };
    if (retimed.cycles != cycles || events != cycles || all != each) {
      throw DisagreementError(fmt::format("{}: engines disagree: recurrence {}, systemc {}, retime {} cycles",
                                          frame.name, cycles, events, retimed.cycles));
    }
    if (i == 0) {  // warms caches and page tables
      continue;
    }
    std::size_t k = 0;
    for (std::vector<double>* list : {&functional, &recurrence, &systemc, &one, &batch, &sampled, &singly}) {
      list->push_back(times[k++]);
    }
  }
  const double f = median(functional);
  const double r = median(recurrence);
  fmt::print(
      "| {} | {} | {:.1f} | {:.1f} | {:.0f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.1f} | {:.1f} | {:.1f} | "
      "{:.0f} | {:.1f} |\n",
      frame.name, cycles, f, r, median(systemc), median(one), median(batch), median(sampled), r / f,
      median(systemc) / r, r / median(one), median(singly) / median(batch),
      r * static_cast<double>(machines.size()) / median(batch), median(batch) / median(sampled));
}

void bench_time(const TimeOptions& options) {
  const Config config = options.machine.config();
  fmt::print("{}, medians of {} runs in turns, ms\n\n", threads_text(options.threads.count), options.repeat);
  fmt::print(
      "| frame | cycles | functional | recurrence | systemc | retime | retime 64 | sampled 64 | recurrence / "
      "functional | systemc / recurrence | recurrence / retime | 64 x retime / retime 64 | 64 x recurrence / "
      "retime 64 | retime 64 / sampled 64 |\n");
  fmt::print("|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n");
  for (const std::string& input : options.inputs) {
    print_times(load_input(input), config, options);
  }
}

}  // namespace

void add_bench_time(CLI::App& bench) {
  auto options = std::make_shared<TimeOptions>();
  CLI::App* command = bench.add_subcommand("time", "run time of every fidelity and of re-timing");
  command->add_option("INPUT", options->inputs, "frames, meshes or synthetic:NAME")->required();
  options->machine.add_to(*command);
  options->threads.add_to(*command, "All but systemc use them");
  command->add_option("--repeat", options->repeat, "number of timed runs")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->callback([options] { bench_time(*options); });
}

}  // namespace halfspace
