/// The cycles of a frame and of its draws, for engines whose stages work on different draws at the same time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "halfspace/machine/draw_context.hpp"
#include "halfspace/timing/cycle_stats.hpp"

namespace halfspace {

class CycleBook {
 public:
  /// Calls count(CycleStats&) for the frame, and for the draw. Cycles of a clear that is drawn, and of no
  /// draw (null), are the frame's only.
  template <class Count>
  void count(const DrawContext* draw, Count&& count) {
    count(frame_.stats);
    if (draw != nullptr && !draw->is_clear()) {
      count(of(draw->draw).stats);
    }
  }

  /// The last beat of a burst is in the sink, or in the interpolator before it.
  void burst_left(const DrawContext& draw, std::uint64_t cycle) {
    if (!draw.is_clear()) {
      std::uint64_t& end = of(draw.draw).end;
      end = std::max(end, cycle);
    }
  }

  [[nodiscard]] CycleStats& frame() { return frame_.stats; }

  /// The frame had `cycles` and `draws`.
  FrameCycles finish(std::uint64_t cycles, std::size_t draws) {
    frame_.cycles = cycles;
    frame_.draws.resize(draws);
    std::uint64_t end = 0;
    for (DrawCycles& draw : frame_.draws) {
      draw.end = end = std::max(end, draw.end);  // 0: it had no burst
    }
    return std::exchange(frame_, {});
  }

 private:
  DrawCycles& of(std::uint32_t draw) {
    if (draw >= frame_.draws.size()) {
      frame_.draws.resize(draw + std::size_t{1});
    }
    return frame_.draws[draw];
  }

  FrameCycles frame_;
};

}  // namespace halfspace
