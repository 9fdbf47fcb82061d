/// What the z cache of one shape says to the bursts of a record: found once, used by every machine with that
/// shape, since it does not depend on time.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "halfspace/timing/analytic/draw_work.hpp"
#include "halfspace/timing/record/frame_record.hpp"

namespace halfspace {

struct ZTrace {
  std::uint32_t memory_lines = 0;
  std::vector<ZMiss> misses;         ///< of all bursts, in order
  std::vector<std::uint32_t> burst;  ///< the access each miss belongs to; then one that no access has
  std::vector<ZFlush> flush;         ///< at the end of the frame
};

ZTrace trace_z_cache(const FrameRecord& record, const ZCacheShape& shape);

/// The sums of a record on machines with the z cache of `trace`.
FrameWork record_work(const FrameRecord& record, const ZTrace& trace);

}  // namespace halfspace
