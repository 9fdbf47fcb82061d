/// Cycles of a recorded frame on other machines, without rasterizing again.
#pragma once

#include <cstdint>
#include <list>
#include <optional>
#include <span>
#include <vector>

#include "halfspace/config/config.hpp"
#include "halfspace/timing/record/frame_record.hpp"
#include "halfspace/timing/record/frame_sample.hpp"
#include "halfspace/timing/record/frame_work.hpp"
#include "halfspace/timing/record/retimed_frame.hpp"
#include "halfspace/timing/record/z_trace.hpp"

namespace halfspace {

/// Throws InputError where `config` differs from the record's in a key that changes packets: then the frame
/// has to be recorded again.
void check_retimable(const FrameRecord& record, const Config& config);

/// Times a record on machines. What the z cache says is found once for each shape of it, for the recorded one
/// at the start, so a machine with another cache costs more the first time. Batches of machines go to up to
/// `threads` threads.
class Retimer {
 public:
  explicit Retimer(FrameRecord record, int threads = 1);

  [[nodiscard]] const FrameRecord& record() const { return record_; }

  /// Exactly the cycles of run_recurrence on `config`, which must be valid. Throws as check_retimable.
  RetimedFrame retime(const Config& config);

  /// The same for many machines: those with the same z cache share passes, a SIMD lane each.
  std::vector<RetimedFrame> retime(std::span<const Config> configs);

  /// Cycles of the frame, estimated from a sample of it (see FrameSample); exact where the record is so short
  /// that a sample does not pay. Throws as check_retimable.
  std::uint64_t estimate(const Config& config) { return estimate({&config, 1}).front(); }

  /// The same for many machines, as retime().
  std::vector<std::uint64_t> estimate(std::span<const Config> configs);

 private:
  struct Traced {
    ZCacheShape shape;
    ZTrace trace;
    FrameWork work;
    std::optional<SampleTrace> sample{};
  };
  /// Machines with the same z cache, by their index.
  struct Group {
    Traced* traced = nullptr;
    std::vector<std::size_t> machines;
  };
  /// Finds what these z caches say, where it is not known.
  void trace_all(std::span<const ZCacheShape> shapes);
  Traced& traced(const ZCacheShape& shape);
  /// Throws as check_retimable.
  std::vector<Group> groups(std::span<const Config> configs);

  FrameRecord record_;
  int threads_;
  std::list<Traced> traced_;           ///< a list: references stay valid
  std::optional<FrameSample> sample_;  ///< once something is estimated
};

namespace detail {

/// Machines whose z cache is that of `trace`, in lanes of 16 bits where they have room, else of 32. No time
/// may reach 2^32 (see longest_time). `most_empty`: blocks without a tile, from one block job to the next or
/// after the last of a triangle.
void retime_lanes(const FrameRecord& record, const ZTrace& trace, std::span<const Config> configs,
                  std::uint32_t most_empty, RetimedFrame* results);

/// Machines that fill the lanes of a pass of 16 bits on this processor: of two vectors, so even.
std::size_t pass_machines();

/// Lanes of 16 bits have room for so many cycles twice: before times are looked after, and until then.
inline constexpr std::uint64_t kNarrowRoom = 0x7FFF;

/// A bound on the cycles by which the latest time behind setup grows from one job to the next.
std::uint64_t longest_job(const Config& config, std::uint32_t most_empty);

}  // namespace detail
}  // namespace halfspace
