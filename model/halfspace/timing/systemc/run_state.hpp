/// What the modules of one pipeline share: the draws at work, and where results are collected.
#pragma once

#include <deque>
#include <exception>
#include <systemc>
#include <vector>

#include "halfspace/config/config.hpp"
#include "halfspace/scene/frame.hpp"
#include "halfspace/timing/cycle_stats.hpp"
#include "halfspace/timing/frame_result.hpp"
#include "halfspace/timing/frame_source.hpp"
#include "halfspace/timing/pipeline.hpp"
#include "halfspace/timing/stall_plan.hpp"
#include "halfspace/timing/systemc/sim_clock.hpp"

namespace halfspace::systemc {

/// Every token points to its own: each unit is at another draw.
using DrawWork = DrawContext;

/// Counts the packets between source and sink.
class PacketsInPipe {
 public:
  void add() { ++count_; }
  void remove() {
    if (--count_ == 0) {
      empty_.notify();
    }
  }
  /// Suspends the calling thread until the last one has left.
  void wait_until_empty() {
    while (count_ != 0) {
      sc_core::wait(empty_);
    }
  }

 private:
  std::uint64_t count_ = 0;
  sc_core::sc_event empty_{sc_core::sc_gen_unique_name("pipe_empty")};
};

struct RunState {
  explicit RunState(const Config& machine) : config(machine) {}

  const Config config;
  SimClock clock;
  PacketsInPipe in_pipe;
  std::exception_ptr error;  ///< what a process threw

  // Of the frame.
  const Frame* frame = nullptr;
  StallPlan stalls;
  PacketObserver* observer = nullptr;
  PacketTimes* times = nullptr;
  FrameResult result;
  std::vector<ZSurface> places;  ///< by surface
  std::deque<DrawWork> works;    ///< tokens point into it
  FrameCycles cycles;

  void record(std::vector<std::uint64_t> PacketTimes::*stream, Cycle cycle) const {
    if (times != nullptr) {
      (times->*stream).push_back(cycle);
    }
  }

  /// The body of a process. The kernel would turn an exception into a report of its own; this keeps it for
  /// RasterPipeline::check. The process ends, and so the pipeline comes to rest.
  template <class Body>
  void guard(Body&& body) {
    try {
      body();
    } catch (const sc_core::sc_unwind_exception&) {
      throw;
    } catch (...) {
      error = std::current_exception();
    }
  }
};

/// Of processes that call observers, which may write files.
inline constexpr std::size_t kStackBytes = 512 * 1024;

/// Calls visit(std::integral_constant<int, tile size>) with the size of the configuration.
template <class Visit>
auto with_tile_size(int tile_size, Visit&& visit) {
  switch (tile_size) {
    case 4:
      return visit(std::integral_constant<int, 4>{});
    case 16:
      return visit(std::integral_constant<int, 16>{});
    default:
      return visit(std::integral_constant<int, 8>{});
  }
}

}  // namespace halfspace::systemc
