/// A sample of a record: some stretches of its packets, which stand for all of them. Its cycles on a machine
/// give an estimate of the frame's, at a cost that does not grow with the frame.
///
/// The record is cut into stretches of like work. Some of them, spread over the frame, are copied, each
/// behind the one before it, which brings the machine into the state that it has in mid-frame. A stretch
/// counts with a weight: its share of the frame, calibrated so that the weighted counts of the sample (jobs,
/// blocks, quads, fetches, ...) are those of the frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "halfspace/config/config.hpp"
#include "halfspace/timing/record/frame_record.hpp"
#include "halfspace/timing/record/frame_work.hpp"
#include "halfspace/timing/record/retimed_frame.hpp"
#include "halfspace/timing/record/stretch.hpp"
#include "halfspace/timing/record/z_trace.hpp"

namespace halfspace {

/// How a record is cut, and how many of its stretches are timed.
struct SampleSize {
  std::uint64_t work = 256;  ///< of a stretch
  std::size_t stretches = 96;
  std::uint32_t warm_up_jobs = 64;  ///< before each, or somewhat more
};

/// The sample on machines with z caches of one shape.
struct SampleTrace {
  ZTrace trace;
  FrameWork work;
  std::vector<double> weight;  ///< by stretch that counts
};

class FrameSample {
 public:
  explicit FrameSample(const FrameRecord& record, const SampleSize& size = {});

  /// It is much shorter than the record.
  [[nodiscard]] bool pays() const { return pays_; }

  /// The stretches, as draws: what a machine is timed on.
  [[nodiscard]] const FrameRecord& packets() const { return packets_; }

  /// `trace`: of the whole record.
  [[nodiscard]] SampleTrace trace(const ZTrace& trace) const;

  /// Of the late writes of the whole record those of the sample.
  [[nodiscard]] std::vector<StreamLate> late(const std::vector<StreamLate>& all) const;

  /// Cycles of the frame on `config`, from those of packets() on it.
  [[nodiscard]] std::uint64_t cycles(const Config& config, const RetimedFrame& retimed,
                                     const SampleTrace& trace) const;

 private:
  void choose(const SampleSize& size);
  [[nodiscard]] std::vector<StretchCounts> counts(const ZTrace& trace) const;

  std::vector<Stretch> stretches_;      ///< of the whole record
  std::vector<double> share_;           ///< by stretch: how many it stands for; 0: it does not count
  std::vector<bool> copied_;            ///< by stretch
  std::vector<std::size_t> draws_end_;  ///< by stretch: see StretchCopy
  std::uint32_t accesses_ = 0;          ///< of the whole record
  FrameRecord packets_;
  std::vector<std::uint32_t> fast_clears_;  ///< tiles of each
  bool clears_first_ = false;               ///< the frame begins with one
  bool pays_ = false;
};

}  // namespace halfspace
