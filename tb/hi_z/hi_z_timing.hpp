/// The cycles of docs/units/hi_z.md, as the pins that follow from them:
///
///     a(i)       = max(ready(i), a(i-1) + 1, h(k-1) + 1)             seen(k-1) <= i < seen(k)
///     h(k)       = max(visible(k), h(k-1) + 1, a(seen(k) - 1), leave(n + 3 - fifo) + 1)
///     visible(n) = h(k) + 6
///
/// n counts the blocks up to k-4 that leave. The unit applies a job in the cycle before a(i).
///
/// A block that is rejected is in the unit until h(k) + 4. A triangle is written to its slot 5 cycles after
/// the h(k) of its first block that leaves.
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "common/failure.hpp"
#include "hi_z/hi_z_coverage.hpp"
#include "hi_z/models.hpp"
#include "hi_z/workload.hpp"

namespace halfspace::tb {

class HiZTiming {
 public:
  HiZTiming(const HiZShape& shape, const HiZWorkload& workload, HiZCoverage& coverage)
      : shape_(shape), workload_(workload), coverage_(coverage) {
    clear();
  }

  /// A job can be applied from cycle `at` on. In the order of jobs.
  void ready(std::uint64_t at) { ready_at_.push_back(at); }

  /// Compares the pins of a cycle with what they must be, and takes note of what moves in it. `command`: the
  /// block that is offered, or null.
  std::optional<Failure> cycle(std::uint64_t cycle, const HiZCommand* command, bool left_ready,
                               const HiZInputs& in, const HiZOutputs& out, bool left_valid);

  /// The surface of a clear holds its code; the end of a frame; a reset.
  void cleared(const HiZCommand& command);
  void forget();
  void clear();

  [[nodiscard]] std::uint64_t unapplied() const { return jobs_.size() - applied_; }

 private:
  struct Job {
    std::uint32_t number = 0;
    std::uint8_t tile = 0;
    DepthMoves moves;
    HiZUpdate update;
    std::uint32_t clear_code = 0;
  };
  enum class State : std::uint8_t { kUnknown, kCleared, kStored };

  /// A triangle that gets a slot.
  struct Kept {
    std::uint64_t cycle = 0;
    std::size_t triangle = 0;
    std::uint8_t slot = 0;
  };

  std::optional<Failure> compare_slot(std::uint64_t cycle, const HiZOutputs& out);
  void apply(std::uint64_t cycle);
  /// Jobs that the next block sees.
  [[nodiscard]] std::uint64_t must_see() const;
  void take(std::uint64_t cycle, const HiZCommand& command);
  void cover_slot(const HiZCommand& command, bool rejected);

  HiZShape shape_;
  const HiZWorkload& workload_;
  HiZCoverage& coverage_;
  bool was_reset_ = false;
  bool waited_ = false;
  bool has_applied_ = false;  ///< a job in the cycle before
  int blocks_in_ = 0;
  std::deque<std::uint64_t> rejected_at_;
  std::deque<std::uint64_t> visible_at_;
  std::deque<Kept> kept_at_;
  std::uint64_t left_ = 0;
  std::vector<Job> jobs_;
  std::deque<std::uint64_t> ready_at_;  ///< of all jobs of the frame
  std::uint64_t applied_ = 0;
  std::uint64_t passed_ = 0;               ///< blocks that leave, of those taken
  std::deque<std::uint64_t> jobs_before_;  ///< as in HiZ
  std::deque<std::uint64_t> passed_before_;
  std::uint64_t seen_ = 0;
  // For coverage.
  struct Event {
    std::uint64_t cycle = std::numeric_limits<std::uint64_t>::max() - 1000;
    std::uint32_t number = 0;
  };
  std::size_t triangle_ = std::numeric_limits<std::size_t>::max();  ///< of the last block
  std::uint64_t triangle_blocks_ = 0;
  std::uint64_t triangle_left_ = 0;  ///< of these
  std::vector<HiZWord> words_;
  std::vector<State> states_;
  std::deque<Event> blocks_;  ///< the last ones, the newest first
  std::deque<Event> applies_;
};

}  // namespace halfspace::tb
