/// The files of one run.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "halfspace/config/config.hpp"
#include "halfspace/machine/attribute_planes.hpp"
#include "halfspace/machine/frame_result.hpp"
#include "halfspace/report/output_folder.hpp"
#include "halfspace/report/what_if.hpp"
#include "halfspace/run/run_result.hpp"
#include "halfspace/scene/frame.hpp"
#include "halfspace/shade/picture_filter.hpp"
#include "halfspace/timing/stall_plan.hpp"

namespace halfspace {

/// What stands behind the kind of a file that a surface of the result has: the number of a depth surface, or
/// "_target" and that of a target without depth.
std::string surface_label(const FrameResult& result, std::size_t number);

/// How pictures are made.
struct PictureOptions {
  Interpolation interpolation = Interpolation::kPerspective;  ///< of attributes (shade/shader.hpp)
  PictureFilter filter = PictureFilter::kBox;                 ///< of a frame that is magnified
};

/// Writes depth<S>.npy, fragments<S>.npy and survivors<S>.npy of every surface, shaded<S>.png, depth<S>.png,
/// overdraw<S>.png, tiles<S>.png and quads<S>.png where the run kept sums, and stats.json. S is its label;
/// what has no depth has no depth<S>. Throws InputError.
void write_result_files(OutputFolder& folder, const Frame& frame, const Config& config, Fidelity fidelity,
                        const StallPlan& stalls, const RunResult& result,
                        const std::optional<WhatIfReport>& what_if, const PictureOptions& pictures);

}  // namespace halfspace
