/// The files of one run.
#pragma once

#include <filesystem>
#include <string>

#include "halfspace/config/config.hpp"
#include "halfspace/report/output_folder.hpp"
#include "halfspace/report/recorder.hpp"
#include "halfspace/scene/frame.hpp"
#include "halfspace/timing/frame_result.hpp"
#include "halfspace/timing/recurrence/run_recurrence.hpp"

namespace halfspace {

/// Writes depth<S>.npy, fragments<S>.npy and survivors<S>.npy of every surface, shaded<S>.png, depth<S>.png,
/// overdraw<S>.png, tiles<S>.png and quads<S>.png where `recorder` kept the sums, and stats.json.
/// `timed` is null where the fidelity has no time. Throws InputError.
void write_result_files(OutputFolder& folder, const Frame& frame, const Config& config,
                        const std::string& fidelity, const FrameResult& result, const TimedRun* timed,
                        const Recorder& recorder);

}  // namespace halfspace
