/// The cycle table of docs/units/tile_walker.md as the pins that follow from it, S being the step interval:
///
///     accept(m)  = max(visible(m), done(m-1))
///     x(n)       = max(x(n-1) + (r + 1) S, e(n - fifo) + 1)    after r steps without a job
///     visible(n) = x(n) + 2
///     done(m)    = x(last job) + S * (steps after it)
///
/// and the slot of a triangle is written in the cycle after accept(m).
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "common/unit_timing.hpp"
#include "reference_walk.hpp"
#include "walk_coverage.hpp"

namespace halfspace::tb {

class WalkTiming final : public UnitTiming {
 public:
  /// Counts what it sees in `coverage`.
  WalkTiming(const WalkerParameters& parameters, WalkCoverage& coverage)
      : parameters_(parameters), words_(parameters.widths()), coverage_(coverage) {}

  std::optional<Failure> cycle(const UnitPins& pins) override;
  void clear() override;

 private:
  /// The triangle on its walk.
  struct Triangle {
    std::vector<WalkStep> steps;
    std::size_t first = 0;  ///< the step after that of the last job
    std::size_t job = 0;    ///< the step of the next job, or the end
    std::uint64_t due = 0;  ///< cycle in which that step ends, but for credits; without a job: the walk
    bool drawn = false;     ///< has given out a job
    bool waited = false;    ///< this step, for a credit
  };

  void next_job(std::uint64_t from);
  void give_out(std::uint64_t cycle);
  [[nodiscard]] std::optional<Failure> compare(const UnitPins& pins, bool ready) const;
  [[nodiscard]] std::optional<Failure> compare_slot(const UnitPins& pins) const;
  void take(const UnitPins& pins);

  WalkerParameters parameters_;
  InputWords words_;
  WalkCoverage& coverage_;
  int credits_ = 0;
  bool after_reset_ = true;  ///< ready comes from a register that has yet to rise
  bool was_reset_ = false;   ///< at least once
  bool waiting_ = false;
  std::optional<Triangle> triangle_;
  std::deque<std::uint64_t> visible_at_;
  std::uint64_t left_ = 0;
  std::uint8_t slot_ = 0;
  std::vector<std::uint32_t> written_;  ///< equation and state to be written in this cycle; empty: none
};

}  // namespace halfspace::tb
