/// What each stage of the functional model costs, by prefixes of its work: a run that stops behind the walker
/// takes so much longer than one that stops behind setup.
///
/// A difference holds the stage's unit, its counters, and the hand-over of its packets; where a prefix ends,
/// its packets are dropped in memory, so a stage that could keep them in registers for the next looks a
/// little dearer, and the next cheaper. Stages that differ little from their noise can come out below zero.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "halfspace/config/config.hpp"
#include "halfspace/scene/frame.hpp"

namespace halfspace {

struct StageCost {
  std::string_view stage;
  std::string_view item;             ///< what it works on: "triangle", "decision", ...
  std::uint64_t items = 0;           ///< of the frame; those of clears that are drawn are not counted
  std::vector<double> milliseconds;  ///< of each pass
};

struct StageCosts {
  std::vector<StageCost> stages;  ///< in order; those of a pass add up to a whole run
  std::vector<double>
      functional;  ///< milliseconds of run_functional() on the readable core in the same passes
};

/// Runs every prefix in turn, `repeat` times and once more to warm up.
StageCosts stage_costs(const Frame& frame, const Config& config, int repeat);

}  // namespace halfspace
