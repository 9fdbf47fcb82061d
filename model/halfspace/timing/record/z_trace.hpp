/// What the z cache of one shape says to the bursts of a record: found once, used by every machine with that
/// shape, since it does not depend on time.
#pragma once

#include <cstdint>
#include <vector>

#include "halfspace/timing/record/frame_record.hpp"

namespace halfspace {

struct ZTrace {
  std::uint32_t memory_lines = 0;
  ZMissStream z;
  std::vector<ZFlush> flush;  ///< at the end of the frame
};

ZTrace trace_z_cache(const FrameRecord& record, const ZCacheShape& shape);

/// The record as a stream on machines with the z cache of `trace`. Both must outlive it.
StreamView whole_stream(const FrameRecord& record, const ZTrace& trace);

}  // namespace halfspace
