/// What a run prints for people.
#pragma once

#include <string>

#include "halfspace/machine/frame_result.hpp"
#include "halfspace/report/what_if.hpp"
#include "halfspace/run/run_result.hpp"
#include "halfspace/scene/frame.hpp"

namespace halfspace {

/// On what a frame draws, in words: "2 depth surfaces and 1 target without depth".
std::string surfaces_text(const FrameResult& result);

/// Prints the table of a run. Returns whether RTL and model agree, where there is RTL.
bool print_result(const Frame& frame, const RunResult& result);

/// Prints how long a frame takes: the median of `passes` in milliseconds, and what draws it.
void print_frame_time(double median, int passes, const std::string& by);

/// Prints what was changed, and the work without and with it.
void print_what_if(const WhatIfReport& report);

}  // namespace halfspace
