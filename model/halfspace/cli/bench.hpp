/// What the benches of the command line share.
#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>
#include <vector>

#include "halfspace/cli/exit_status.hpp"

namespace CLI {
class App;
}

namespace halfspace {

/// Milliseconds that action() takes.
template <class Action>
double milliseconds(const Action& action) {
  const auto start = std::chrono::steady_clock::now();
  action();
  const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
  return time.count();
}

/// Milliseconds of the processor that action() takes.
template <class Action>
double processor_milliseconds(const Action& action) {
  const std::clock_t start = std::clock();
  action();
  return 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// The middle one of some times.
inline double median(std::vector<double> times) {
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

void add_bench_speed(CLI::App& bench);
void add_bench_roof(CLI::App& bench);
void add_bench_stages(CLI::App& bench);
void add_bench_surfaces(CLI::App& bench);
void add_bench_depth_traffic(CLI::App& bench);
void add_bench_hi_z(CLI::App& bench);
void add_bench_time(CLI::App& bench);
void add_bench_sampled(CLI::App& bench);
void add_bench_rtl(CLI::App& bench);
void add_bench_idle(CLI::App& bench);
void add_bench_read(CLI::App& bench);
void add_bench_error(CLI::App& bench, ExitStatus& status);

}  // namespace halfspace
