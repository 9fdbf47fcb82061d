/// halfspace bench sampled: how far the sampled fidelity is from the recurrence, over many machines, and what
/// it costs.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "halfspace/cli/bench.hpp"
#include "halfspace/cli/load_input.hpp"
#include "halfspace/cli/options.hpp"
#include "halfspace/machine/surfaces.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/speed/speed_table.hpp"
#include "halfspace/timing/record/retime.hpp"

namespace halfspace {
namespace {

struct SampledOptions {
  std::vector<std::string> inputs;
  MachineOptions machine;
  ThreadsOption threads;
  int machines = 160;
  std::uint64_t seed = 1;
  int repeat = 3;
};

struct Choice {
  const char* key;
  std::vector<int> values;
};

/// What a random machine draws from: what an architect might sweep. A value twice is drawn twice as often.
const std::vector<Choice>& choices() {
  static const std::vector<Choice> list{
      {"setup.queue", {4, 8, 16}},
      {"setup.interval", {1, 1, 2, 4, 8, 16}},
      {"setup.fifo", {8, 16, 40, 64}},
      {"block_walker.fifo", {2, 4, 4, 8}},
      {"tile_walker.fifo", {4, 8, 16, 32, 64}},
      {"edge_evaluator.pipe_stages", {1, 2, 3}},
      {"edge_evaluator.fifo", {2, 4, 8, 16}},
      {"quad_generator.quads_per_cycle", {1, 2, 4, 4, 8, 16}},
      {"quad_generator.fifo", {2, 4, 8, 16}},
      {"early_z.quads_per_cycle", {1, 2, 4, 4, 8, 16}},
      {"early_z.pending", {8, 16, 32, 64}},
      {"early_z.fifo", {4, 16, 32}},
      {"depth.latency", {12, 20, 32}},
      {"z_cache.misses_in_flight", {4, 8, 16, 32, 64}},
      {"z_cache.write_buffers", {4, 8, 16}},
      {"z_cache.clear_tiles", {16, 64, 256}},
      {"memory.latency", {20, 50, 100, 200, 400}},
      {"memory.read_bytes", {8, 16, 32, 64, 128}},
      {"memory.write_bytes", {8, 16, 32, 64, 128}},
  };
  return list;
}

/// Lines, ways and parts of their z caches: few, because machines with the same share a pass.
constexpr std::array<std::array<int, 3>, 8> kZCaches{
    {{128, 4, 1}, {64, 4, 1}, {16, 2, 1}, {8, 2, 1}, {512, 8, 1}, {128, 4, 4}, {64, 2, 2}, {32, 1, 1}}};

/// `base`, and machines for the same packets. The same on every system.
std::vector<Config> random_machines(const Config& base, int count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<Config> machines{base};
  while (machines.size() < static_cast<std::size_t>(count)) {
    Config machine = base;
    for (const Choice& choice : choices()) {
      set_config(machine, choice.key, std::to_string(choice.values[random() % choice.values.size()]));
    }
    const auto& [lines, ways, parts] = kZCaches[random() % kZCaches.size()];
    machine.z_cache.lines = lines;
    machine.z_cache.ways = ways;
    machine.z_cache.parts = parts;
    try {
      validate(machine);
    } catch (const InputError&) {
      continue;  // widths that do not go together: draw again
    }
    machines.push_back(machine);
  }
  return machines;
}

struct SampledErrors {
  double sum = 0;
  double worst = 0;
  std::size_t machines = 0;

  void add(double error) {
    sum += std::abs(error);
    worst = std::abs(error) > std::abs(worst) ? error : worst;
    ++machines;
  }
  [[nodiscard]] double mean() const { return machines == 0 ? 0 : sum / static_cast<double>(machines); }
};

void print_frame(const std::string& input, const SampledOptions& options, SampledErrors& all) {
  const Config base = options.machine.config();
  const FrameRecord record = record_frame(load_input(input), base);
  const ZTrace trace = trace_z_cache(record, z_cache_shape(base));
  const std::vector<Config> machines = random_machines(base, options.machines, options.seed);
  Retimer retimer(record, options.threads.count);
  std::vector<RetimedFrame> exact = retimer.retime(machines);  // finds what the z caches say
  std::vector<std::uint64_t> estimated = retimer.estimate(machines);
  std::vector<double> exact_times;
  std::vector<double> estimate_times;
  std::vector<double> sample_times;
  bool pays = false;
  for (int i = 0; i < options.repeat; ++i) {
    exact_times.push_back(milliseconds([&] { exact = retimer.retime(machines); }));
    estimate_times.push_back(milliseconds([&] { estimated = retimer.estimate(machines); }));
    sample_times.push_back(milliseconds([&] {
      const FrameSample sample(record);
      pays = sample.pays() && !sample.trace(trace).weight.empty();
    }));
  }
  SampledErrors errors;
  double cycles = 0;
  for (std::size_t i = 0; i < machines.size(); ++i) {
    const auto truth = static_cast<double>(exact[i].cycles);
    errors.add(100.0 * (static_cast<double>(estimated[i]) - truth) / truth);
    if (pays) {
      all.add(100.0 * (static_cast<double>(estimated[i]) - truth) / truth);
    }
    cycles += truth;
  }
  const double each = 1e3 / static_cast<double>(machines.size());
  fmt::print("| {} | {} | {} | {:.0f} | {:.0f} | {:.1f} | {:.0f} | {} | {:.2f} | {:+.1f} |\n", record.name,
             record.packets.jobs.size(), exact[0].cycles, median(exact_times) * each,
             median(estimate_times) * each, median(exact_times) / median(estimate_times),
             cycles / median(estimate_times) / 1e3,
             pays ? fmt::format("{:.1f}", median(sample_times)) : "short", errors.mean(), errors.worst);
}

void bench_sampled(const SampledOptions& options) {
  fmt::print("{} machines, seed {}; {}, medians of {} passes\n\n", options.machines, options.seed,
             threads_text(options.threads.count), options.repeat);
  fmt::print(
      "| frame | tile jobs | cycles on the first | retime, us a machine | sampled, us a machine | retime / "
      "sampled | sampled, Mcycles/s | making the sample, ms | mean error's magnitude % | worst error % |\n");
  fmt::print("|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n");
  SampledErrors all;
  for (const std::string& input : options.inputs) {
    print_frame(input, options, all);
  }
  fmt::print("| all that are sampled | | | | | | | | {:.2f} | {:+.1f} |\n", all.mean(), all.worst);
}

}  // namespace

void add_bench_sampled(CLI::App& bench) {
  auto options = std::make_shared<SampledOptions>();
  CLI::App* command =
      bench.add_subcommand("sampled", "error and run time of the sampled fidelity over random machines");
  command->add_option("INPUT", options->inputs, "frames, meshes or synthetic:NAME")->required();
  options->machine.add_to(*command);
  options->threads.add_to(*command, "Each times other machines");
  command->add_option("--machines", options->machines, "number of machines, the configured one first")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "of the other machines")->capture_default_str();
  command->add_option("--repeat", options->repeat, "number of timed passes")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->callback([options] { bench_sampled(*options); });
}

}  // namespace halfspace
