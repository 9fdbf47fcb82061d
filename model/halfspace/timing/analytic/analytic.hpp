/// Fidelity `analytic`: a draw takes as long as the unit that has the most to do, and a frame the sum of its
/// draws. Its error against the recurrence is measured: `halfspace bench analytic`.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "halfspace/config/config.hpp"
#include "halfspace/machine/frame_result.hpp"
#include "halfspace/machine/packet_observer.hpp"
#include "halfspace/timing/analytic/draw_work.hpp"

namespace halfspace {

/// What can bound a draw.
enum class Bound : std::uint8_t {
  kSetup,
  kTileWalker,
  kEdgeEvaluator,
  kQuadGenerator,
  kEarlyZ,
  kMemoryRead,     ///< bytes a cycle
  kMemoryLatency,  ///< fill buffers: so many misses in flight
  kMemoryWrite,
};
inline constexpr std::size_t kBounds = 8;
inline constexpr std::array<std::string_view, kBounds> kBoundName{
    "setup",   "tile_walker", "edge_evaluator", "quad_generator",
    "early_z", "memory_read", "memory_latency", "memory_write"};

struct AnalyticDraw {
  std::uint64_t cycles = 0;  ///< of the busiest unit, among draws that follow each other without a gap
  Bound bound = Bound::kSetup;
};

struct AnalyticFrame {
  std::uint64_t cycles = 0;  ///< draws, clears, fill, drain and flush
  std::vector<AnalyticDraw> draws;
};

/// From the first triangle into an empty machine to its first quad at the sink, and so from the last of the
/// busiest unit to the end, at most.
std::uint64_t fill_cycles(const Config& config);

/// The bound of one draw; under a microsecond.
AnalyticDraw analytic_draw(const DrawWork& work, const Config& config);

AnalyticFrame analytic_frame(const FrameWork& work, const Config& config);

struct AnalyticResult {
  FrameResult frame;
  AnalyticFrame estimate;
};

/// Runs `frame` as run_functional does, and estimates its time.
AnalyticResult run_analytic(const Frame& frame, const Config& config, const Watch& watch = {});

}  // namespace halfspace
