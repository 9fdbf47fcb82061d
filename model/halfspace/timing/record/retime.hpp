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

  /// The same for many machines: those with the same z cache share passes, a SIMD lane each.
  std::vector<RetimedFrame> retime(std::span<const Config> configs);

  /// The analytic fidelity on `config`. Throws as check_retimable.
  AnalyticFrame analytic(const Config& config);

 private:
  struct Traced {
    ZCacheShape shape;
    ZTrace trace;
    FrameWork work;
    DrawWork sum;  ///< of all draws and drawn clears
  };
  const Traced& traced(const ZCacheShape& shape);
  /// Those of `configs` whose positions are in `group`: all have the z cache of `known`.
  void retime_group(const Traced& known, std::span<const Config> configs, std::span<const std::size_t> group,
                    std::span<RetimedFrame> results) const;

  FrameRecord record_;
  std::uint32_t most_steps_ = 0;  ///< see detail::retime_lanes
  std::list<Traced> traced_;      ///< a list: references stay valid
};

namespace detail {

/// Machines whose z cache is that of `trace`, in lanes of 16 bits where they have room, else of 32. No time
/// may reach 2^32 (see longest_time). `most_steps`: of the walker from one job to the next, or after the last
/// of a triangle.
void retime_lanes(const FrameRecord& record, const ZTrace& trace, std::span<const Config> configs,
                  std::uint32_t most_steps, RetimedFrame* results);

/// Lanes of 16 bits have room for so many cycles twice: before times are looked after, and until then.
inline constexpr std::uint64_t kNarrowRoom = 0x7FFF;

/// A bound on the cycles by which the latest time behind setup grows from one job to the next.
std::uint64_t longest_job(const Config& config, std::uint32_t most_steps);

/// A bound on the cycles of a frame: no packet overlaps with another.
/// `sum` is that of all draws and drawn clears of `work`.
std::uint64_t longest_time(const FrameWork& work, const DrawWork& sum, const Config& config);

}  // namespace detail
}  // namespace halfspace
