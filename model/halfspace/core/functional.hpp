/// Fidelity `functional`: a frame through the units, without time.
#pragma once

#include <optional>

#include "halfspace/config/config.hpp"
#include "halfspace/fast/fast_core.hpp"
#include "halfspace/machine/frame_result.hpp"
#include "halfspace/machine/packet_observer.hpp"

namespace halfspace {

/// Runs `frame`, which must be valid (scene/validate.hpp), on the machine of `config`, which must be valid
/// too. Memory: 8 bytes a pixel of all depth surfaces. Throws InputError where `watch.core` does not cover
/// the run.
FrameResult run_functional(const Frame& frame, const Config& config, const Watch& watch = {});

/// Runs frames one after the other, as run_functional does, in the memory of the run before.
class FunctionalRuns {
 public:
  explicit FunctionalRuns(const Config& config, const Watch& watch = {});

  /// Counters of the frame.
  const Counters& run(const Frame& frame);
  /// The result of the last run, which is then gone.
  FrameResult take();

 private:
  Config config_;
  Watch watch_;
  std::optional<fast::FastCore> fast_;  ///< where it covers the runs
  FrameResult readable_;                ///< else
};

}  // namespace halfspace
