/// The cycle table of docs/units/quad_generator.md as the pins that follow from it:
///
///     g(n)       = max(arrive(n), g(n-1) + max(1, beats(n-1)), leave(k - capacity) + 1)
///     visible(i) = g(n) + 2 + i of beat i, after the beats before it have left
///
/// and the job is told to hi_z in g(n) + 1,
/// where leave() is the cycle in which the last beat of a burst leaves.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "common/unit_timing.hpp"
#include "halfspace/numerics/widths.hpp"
#include "quad_coverage.hpp"

namespace halfspace::tb {

class BurstTiming final : public UnitTiming {
 public:
  /// Counts what it sees in `coverage`.
  BurstTiming(const Widths& widths, int capacity, QuadCoverage& coverage)
      : widths_(widths), capacity_(capacity), credits_(capacity), coverage_(coverage) {}

  std::optional<Failure> cycle(const UnitPins& pins) override;
  void clear() override;

 private:
  struct Burst {
    std::uint64_t visible = 0;  ///< cycle of its first beat
    int quads = 0;
    int beats = 0;
    int left = 0;  ///< beats that have left
    bool stalled_at_first = false;
    bool stalled_later = false;
  };

  [[nodiscard]] std::optional<Failure> compare(const UnitPins& pins, bool ready, bool visible) const;
  [[nodiscard]] std::optional<Failure> compare_job(const UnitPins& pins) const;
  void take(const UnitPins& pins, bool returned);

  Widths widths_;
  int capacity_;
  int credits_;
  QuadCoverage& coverage_;
  bool after_reset_ = true;       ///< ready comes from a register that has yet to see the credits
  bool was_reset_ = false;        ///< at least once
  std::uint64_t free_from_ = 0;   ///< first cycle in which a coverage may be taken but for credits
  std::uint64_t made_until_ = 0;  ///< cycle in which the last beat of the last burst is made
  bool taken_ = false;            ///< a coverage, in the cycle before
  bool taken_burst_ = false;      ///< with a quad
  std::uint64_t now_ = 0;         ///< the cycle after the last one seen
  std::deque<Burst> bursts_;
  std::uint64_t packets_ = 0;  ///< beats that have left
};

}  // namespace halfspace::tb
