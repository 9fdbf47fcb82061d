/// Cycles of a recorded frame on other machines, without rasterizing again.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "halfspace/config/config.hpp"
#include "halfspace/timing/record/frame_record.hpp"
#include "halfspace/timing/record/z_trace.hpp"

namespace halfspace {

struct RetimedFrame {
  std::uint64_t cycles = 0;
  std::vector<std::uint64_t> draw_end;  ///< by draw, as DrawCycles::end

  friend bool operator==(const RetimedFrame&, const RetimedFrame&) = default;
};

/// Throws InputError where `config` differs from the record's in a key that changes packets: then the frame
/// has to be recorded again.
void check_retimable(const FrameRecord& record, const Config& config);

/// Exactly the cycles of run_recurrence on `config`. Both must be valid and check_retimable.
RetimedFrame retime(const FrameRecord& record, const Config& config);

/// The same for many machines: those with the same z cache share a pass, a SIMD lane each.
std::vector<RetimedFrame> retime(const FrameRecord& record, std::span<const Config> configs);

namespace detail {

/// Machines in one pass.
inline constexpr std::size_t kLanes = 16;

/// At most kLanes machines whose z cache is that of `trace`. No time may reach 2^32 (see longest_time).
void retime_lanes(const FrameRecord& record, const ZTrace& trace, std::span<const Config> configs,
                  RetimedFrame* results);

/// A bound on the cycles of the record on a machine: every packet waits for every other.
std::uint64_t longest_time(const FrameRecord& record, const ZTrace& trace, const Config& config);

}  // namespace detail
}  // namespace halfspace
