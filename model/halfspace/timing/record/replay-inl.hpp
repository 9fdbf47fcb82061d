/// A record through a recurrence. In the manner of Highway, as recurrence/core-inl.hpp.
#if defined(HALFSPACE_REPLAY_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HALFSPACE_REPLAY_INL
#undef HALFSPACE_REPLAY_INL
#else
#define HALFSPACE_REPLAY_INL
#endif

#include <hwy/highway.h>

#include <span>

#include "halfspace/timing/record/frame_record.hpp"
#include "halfspace/timing/record/z_trace.hpp"
#include "halfspace/timing/recurrence/core-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace halfspace::HWY_NAMESPACE {

/// Feeds `core` with the packets of `record`. Calls draw_done(core, bursts) after each draw, with whether it
/// had any bursts, and takes clear_cycles(tiles) for the time of a fast clear.
template <class Core, class ClearCycles, class DrawDone>
void replay(const FrameRecord& record, const ZTrace& trace, Core& core, const ClearCycles& clear_cycles,
            const DrawDone& draw_done) {
  core.start(trace.memory_lines);
  const RecordedTriangle* triangle = record.triangles.data();
  const RecordedJob* job = record.jobs.data();
  const ZMiss* miss = trace.misses.data();
  const std::uint32_t* miss_burst = trace.burst.data();
  std::uint32_t access = 0;
  for (const RecordedSegment& segment : record.segments) {
    if (segment.kind == RecordedSegment::Kind::kFastClear) {
      core.fast_clear(clear_cycles(record.surfaces[segment.surface].tiles));
      continue;
    }
    bool bursts = false;
    const RecordedTriangle* const last = triangle + segment.triangles;
    for (; triangle != last; ++triangle) {
      for (std::uint32_t i = 0; i < triangle->dropped_before; ++i) {
        core.dropped();
      }
      core.drawn();
      const RecordedJob* const end = job + triangle->jobs;
      for (; job != end; ++job) {
        JobWork work{.steps = job->steps(), .quads = job->quads()};
        if (segment.touches_depth != 0 && work.quads != 0) {
          const ZMiss* const first = miss;
          for (; *miss_burst == access; ++miss_burst) {
            ++miss;
          }
          work.misses = {first, miss};
          ++access;
        }
        bursts |= work.quads != 0;
        core.job(work);
      }
      core.walked(triangle->steps_after);
    }
    for (std::uint32_t i = 0; i < segment.dropped_after; ++i) {
      core.dropped();
    }
    if (segment.kind == RecordedSegment::Kind::kDraw) {
      draw_done(core, bursts);
    }
  }
}

}  // namespace halfspace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
