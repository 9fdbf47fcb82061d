/// A packet stream through a recurrence: the one loop that feeds it. In the manner of Highway, as
/// core-inl.hpp.
#if defined(HALFSPACE_REPLAY_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HALFSPACE_REPLAY_INL
#undef HALFSPACE_REPLAY_INL
#else
#define HALFSPACE_REPLAY_INL
#endif

#include <hwy/highway.h>

#include <cstdint>
#include <span>

#include "halfspace/machine/packet_stream.hpp"
#include "halfspace/timing/recurrence/core-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace halfspace::HWY_NAMESPACE {

/// What a reader of the stream does beside feeding the core; derive from it and hide what is needed. Called
/// statically.
struct ReplayHooks {
  /// A draw, or a clear that is drawn, begins.
  void begin_segment(const StreamSegment& /*segment*/) {}
  /// It is done; `bursts`: it had some.
  void end_segment(const StreamSegment& /*segment*/, bool /*bursts*/) {}
  /// The next job's place in StreamView::jobs.
  void job(std::size_t /*index*/) {}
  /// A burst is all the way through.
  void burst() {}
};

/// Feeds `core` with the packets of a part of a stream. `bursts` is kept from part to part: whether the
/// segment that is open had any. `clear_cycles(surface)` is the time of a fast clear.
template <class Core, class Hooks, class ClearCycles>
void replay(const StreamView& part, Core& core, Hooks& hooks, bool& bursts, const ClearCycles& clear_cycles) {
  const StreamTriangle* triangle = part.triangles.data();
  const StreamJob* job = part.jobs.data();
  const ZMiss* miss = part.misses.data();
  const std::uint32_t* miss_burst = part.miss_burst.data();
  std::uint32_t access = 0;
  bool continues_triangle = part.continues_triangle;
  for (const StreamSegment& segment : part.segments) {
    if (segment.kind == StreamSegment::Kind::kFastClear) {
      core.fast_clear(clear_cycles(segment.surface));
      continue;
    }
    if (&segment != &part.segments.front() || !part.continues_segment) {
      bursts = false;
      hooks.begin_segment(segment);
    }
    const bool open = part.open_segment && &segment == &part.segments.back();
    const StreamTriangle* const last = triangle + segment.triangles;
    for (; triangle != last; ++triangle) {
      if (!continues_triangle) {
        for (std::uint32_t i = 0; i < triangle->dropped_before; ++i) {
          core.dropped();
        }
        core.drawn();
      }
      continues_triangle = false;
      const StreamJob* const end = job + triangle->jobs;
      for (; job != end; ++job) {
        JobWork work{.steps = job->steps(), .quads = job->quads(), .misses = {}};
        if (segment.touches_depth != 0 && work.quads != 0) {
          const ZMiss* const first = miss;
          for (; *miss_burst == access; ++miss_burst) {
            ++miss;
          }
          work.misses = {first, miss};
          ++access;
        }
        hooks.job(static_cast<std::size_t>(job - part.jobs.data()));
        core.job(work);
        if (work.quads != 0) {
          bursts = true;
          hooks.burst();
        }
      }
      if (!open || !part.open_triangle || triangle + 1 != last) {
        core.walked(triangle->steps_after);
      }
    }
    if (!open) {
      for (std::uint32_t i = 0; i < segment.dropped_after; ++i) {
        core.dropped();
      }
      hooks.end_segment(segment, bursts);
    }
  }
}

}  // namespace halfspace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
