/// The files of one run.
#pragma once

#include <filesystem>
#include <optional>

#include "halfspace/config/config.hpp"
#include "halfspace/report/output_folder.hpp"
#include "halfspace/report/what_if.hpp"
#include "halfspace/run/run_result.hpp"
#include "halfspace/scene/frame.hpp"
#include "halfspace/timing/stall_plan.hpp"

namespace halfspace {

/// Writes depth<S>.npy, fragments<S>.npy and survivors<S>.npy of every surface, shaded<S>.png, depth<S>.png,
/// overdraw<S>.png, tiles<S>.png and quads<S>.png where the run kept sums, and stats.json.
/// Throws InputError.
void write_result_files(OutputFolder& folder, const Frame& frame, const Config& config, Fidelity fidelity,
                        const StallPlan& stalls, const RunResult& result,
                        const std::optional<WhatIfReport>& what_if);

}  // namespace halfspace
