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
  /// A burst is all the way through `core`.
  template <class Core>
  void burst(const Core& /*core*/) {}
};

/// How far a part of a stream has been read.
struct StreamCursor {
  const StreamTriangle* triangle;
  const StreamBlock* block;
  const StreamJob* job;
  const ZMiss* miss;
  const std::uint32_t* miss_burst;
  const StreamLate* late;
  const std::uint64_t* live = nullptr;  ///< only of machines with the interpolator
  std::uint32_t access = 0;
  bool continues_triangle;
};

/// What the z cache says to the next access.
HWY_INLINE void next_access(StreamCursor& at, JobWork& work) {
  const ZMiss* const first = at.miss;
  for (; *at.miss_burst == at.access; ++at.miss_burst) {
    ++at.miss;
  }
  work.misses = {first, at.miss};
  if (HWY_UNLIKELY(at.late->access == at.access)) {
    work.late_done = at.late->done;
    work.late = at.late->leaves;
    ++at.late;
  }
  ++at.access;
}

/// The triangles of a segment; `open`: it goes on in the next part. Works with copies: a function without
/// other calls that owns the core keeps its times in registers.
template <class Core, class Hooks>
HWY_NOINLINE void replay_triangles(const StreamView& part, const StreamSegment& segment, bool open,
                                   StreamCursor& cursor, Core& kept, Hooks& hooks, bool& bursts) {
  Core core = kept;
  StreamCursor at = cursor;
  bool any = false;
  const StreamTriangle* const last = at.triangle + segment.triangles;
  for (; at.triangle != last; ++at.triangle) {
    if (!at.continues_triangle) {
      for (std::uint32_t i = at.triangle->dropped_before; i > 0; --i) {
        core.dropped();
      }
      core.drawn();
    }
    at.continues_triangle = false;
    for (const StreamBlock* const end = at.block + at.triangle->blocks; at.block != end; ++at.block) {
      core.block(at.block->empty_before(), at.block->jobs());
      for (const StreamJob* const jobs_end = at.job + at.block->jobs(); at.job != jobs_end; ++at.job) {
        JobWork work{.quads = *at.job, .misses = {}};
        if (segment.touches_depth != 0 && work.quads != 0) {
          next_access(at, work);
        }
        if constexpr (Core::kInterpolates) {
          work.live = work.quads != 0 ? *at.live++ : 0;
        }
        hooks.job(static_cast<std::size_t>(at.job - part.jobs.data()));
        core.job(work);
        if (work.quads != 0) {
          any = true;
          hooks.burst(core);
        }
      }
      if (at.block->jobs() != 0) {
        core.block_done();
      }
    }
    if (!open || !part.open_triangle || at.triangle + 1 != last) {
      core.walked(at.triangle->empty_after);
    }
  }
  if (!open) {
    for (std::uint32_t i = segment.dropped_after; i > 0; --i) {
      core.dropped();
    }
  }
  bursts |= any;
  cursor = at;
  kept = core;
}

/// Feeds `core` with the packets of a part of a stream. `bursts` is kept from part to part: whether the
/// segment that is open had any. `clear_cycles(surface)` is the time of a fast clear.
template <class Core, class Hooks, class ClearCycles>
void replay(const StreamView& part, Core& core, Hooks& hooks, bool& bursts, const ClearCycles& clear_cycles) {
  StreamCursor at{.triangle = part.triangles.data(),
                  .block = part.blocks.data(),
                  .job = part.jobs.data(),
                  .miss = part.misses.data(),
                  .miss_burst = part.miss_burst.data(),
                  .late = part.late.data(),
                  .live = part.live.data(),
                  .continues_triangle = part.continues_triangle};
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
    replay_triangles(part, segment, open, at, core, hooks, bursts);
    if (!open) {
      hooks.end_segment(segment, bursts);
    }
  }
}

}  // namespace halfspace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
