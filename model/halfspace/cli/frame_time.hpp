/// How long a frame takes: --time of halfspace run.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "halfspace/cli/bench.hpp"
#include "halfspace/cli/run_table.hpp"

namespace halfspace {

inline void add_time_option(CLI::App& command, int& passes) {
  command
      .add_option("--time", passes,
                  "draw the frame N times more, with no files, and print the median time of a pass")
      ->check(CLI::Range(1, 1000))
      ->type_name("N");
}

/// Draws the frame `passes` times more, and prints the line of the table; 0 does nothing. `by`: what draws.
template <class Draw>
void print_time(int passes, const std::string& by, const Draw& draw) {
  std::vector<double> times;
  for (int i = 0; i < passes; ++i) {
    times.push_back(milliseconds(draw));
  }
  if (passes > 0) {
    print_frame_time(median(times), passes, by);
  }
}

}  // namespace halfspace
