/// A triangle's passage through setup: the unit, its counters and events.
#pragma once

#include "halfspace/machine/draw_context.hpp"
#include "halfspace/units/setup.hpp"

namespace halfspace::passage {

/// True where the triangle goes on to the walker; then `out` is filled.
inline bool setup(const ScreenTriangle& in, DrawContext& draw, SetupTriangle& out) {
  const SetupVerdict verdict = halfspace::setup(in, draw.setup, out);
  SetupCounters& counters = draw.counters.setup;
  ++counters.triangles;
  switch (verdict) {
    case SetupVerdict::kDrawn:
      ++counters.drawn;
      break;
    case SetupVerdict::kZeroArea:
      ++counters.zero_area;
      break;
    case SetupVerdict::kCulled:
      ++counters.culled;
      break;
    case SetupVerdict::kNoSample:
      ++counters.no_sample;
      break;
    case SetupVerdict::kOutside:
      ++counters.outside;
      break;
  }
  const bool drawn = verdict == SetupVerdict::kDrawn;
  if (draw.record_walk) {
    draw.observer->set_up({.draw = draw.draw,
                           .triangle = in.triangle,
                           .surface = draw.surface,
                           .verdict = verdict,
                           .screen = &in,
                           .drawn = drawn ? &out : nullptr});
  }
  return drawn;
}

}  // namespace halfspace::passage
