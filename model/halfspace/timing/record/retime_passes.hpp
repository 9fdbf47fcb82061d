/// Passes over a record, in which machines are timed: independent of each other, so threads share them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "halfspace/config/config.hpp"
#include "halfspace/timing/record/frame_record.hpp"
#include "halfspace/timing/record/frame_work.hpp"
#include "halfspace/timing/record/retimed_frame.hpp"
#include "halfspace/timing/record/z_trace.hpp"

namespace halfspace {

/// Machines with the same z cache, and what it says to a record.
struct RetimeGroup {
  const FrameRecord* record = nullptr;
  const ZTrace* trace = nullptr;
  const FrameWork* work = nullptr;    ///< of record and trace
  std::vector<std::size_t> machines;  ///< by their index
};

/// On the machine of `config`, whose z cache is that of `trace`.
RetimedFrame retime_one(const FrameRecord& record, const ZTrace& trace, const Config& config);

/// Times the machines of all groups on up to `threads` threads. `configs` and `results`: by index.
void retime_groups(std::span<const RetimeGroup> groups, std::span<const Config> configs, int threads,
                   std::span<RetimedFrame> results);

}  // namespace halfspace
