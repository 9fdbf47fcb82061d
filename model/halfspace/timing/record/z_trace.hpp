/// What the z cache of one shape says to the bursts of a record: found once, used by every machine with that
/// shape, since it does not depend on time.
#pragma once

#include <cstdint>
#include <vector>

#include "halfspace/timing/record/frame_record.hpp"

namespace halfspace {

struct ZTrace {
  std::uint32_t rows = 0;  ///< of the table of times that misses name by `line` and `victim`
  ZMissStream z;
  std::vector<ZFlush> flush;  ///< at the end of the frame
};

/// Each line of memory is a row.
ZTrace trace_lines(const FrameRecord& record, const ZCacheShape& shape);

/// Few rows, which stay in the processor's cache: those of lines that some machine may have to wait for. The
/// cycles are the same.
ZTrace trace_z_cache(const FrameRecord& record, const ZCacheShape& shape);

/// The record as a stream on machines with the z cache of `trace`. Both must outlive it.
StreamView whole_stream(const FrameRecord& record, const ZTrace& trace);

}  // namespace halfspace
