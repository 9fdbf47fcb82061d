/// What the modules of one pipeline share: the draws at work, and where results are collected.
#pragma once

#include <array>
#include <deque>
#include <exception>
#include <systemc>
#include <vector>

#include "halfspace/config/config.hpp"
#include "halfspace/machine/draw_context.hpp"
#include "halfspace/machine/frame_result.hpp"
#include "halfspace/machine/packet_observer.hpp"
#include "halfspace/machine/surfaces.hpp"
#include "halfspace/scene/frame.hpp"
#include "halfspace/timing/cycle_book.hpp"
#include "halfspace/timing/stall_plan.hpp"
#include "halfspace/timing/systemc/sim_clock.hpp"

namespace halfspace::systemc {

class CreditLinkBase;
class StageMeter;

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
  void wait_until_empty(SimClock& clock) {
    while (count_ != 0) {
      clock.wait_for(empty_);
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
  // Each puts itself here when it is made.
  std::array<CreditLinkBase*, kFifos> fifos{};
  std::array<StageMeter*, kStages> meters{};

  // Of the frame.
  const Frame* frame = nullptr;
  StallPlan stalls;
  PacketObserver* observer = nullptr;
  bool notes_times = false;
  PacketTimes times;  ///< where they are noted
  FrameResult result;
  std::vector<ZSurface> places;   ///< by depth surface
  std::deque<DrawContext> draws;  ///< tokens point into it
  CycleBook book;

  void record(std::vector<std::uint64_t> PacketTimes::*stream, Cycle cycle) {
    if (notes_times) {
      (times.*stream).push_back(cycle);
    }
  }

  /// What a draw is drawn on.
  [[nodiscard]] Surface& surface(const DrawContext& draw) { return result.surfaces[draw.drawn_on]; }

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

}  // namespace halfspace::systemc
