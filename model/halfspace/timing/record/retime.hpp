/// Cycles of a recorded frame on other machines, without rasterizing again.
#pragma once

#include <cstdint>
#include <list>
#include <span>
#include <vector>

#include "halfspace/config/config.hpp"
#include "halfspace/timing/analytic/analytic.hpp"
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

/// Times a record on machines. What the z cache says is found once for each shape of it, for the recorded one
/// at the start, so a machine with another cache costs more the first time.
class Retimer {
 public:
  explicit Retimer(FrameRecord record);

  [[nodiscard]] const FrameRecord& record() const { return record_; }

  /// Exactly the cycles of run_recurrence on `config`, which must be valid. Throws as check_retimable.
  RetimedFrame retime(const Config& config);

  /// The same for many machines: those with the same z cache share a pass, a SIMD lane each.
  std::vector<RetimedFrame> retime(std::span<const Config> configs);

  /// The analytic fidelity on `config`. Throws as check_retimable.
  AnalyticFrame analytic(const Config& config);

 private:
  struct Traced {
    ZCacheShape shape;
    ZTrace trace;
    FrameWork work;
  };
  const Traced& traced(const ZCacheShape& shape);

  FrameRecord record_;
  std::list<Traced> traced_;  ///< a list: references stay valid
};

namespace detail {

/// Machines in one pass.
inline constexpr std::size_t kLanes = 16;

/// At most kLanes machines whose z cache is that of `trace`. No time may reach 2^32 (see longest_time).
void retime_lanes(const FrameRecord& record, const ZTrace& trace, std::span<const Config> configs,
                  RetimedFrame* results);

/// A bound on the cycles of a frame: no packet overlaps with another.
std::uint64_t longest_time(const FrameWork& work, const Config& config);

}  // namespace detail
}  // namespace halfspace
