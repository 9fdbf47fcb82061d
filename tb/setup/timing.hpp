/// The cycle table of docs/units/setup.md: as a formula of a whole run, and as the pins that follow from it.
#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "common/unit_timing.hpp"
#include "coverage.hpp"
#include "models.hpp"

namespace halfspace::tb {

/// The cycle in which the last drawn triangle leaves, when neither source nor sink ever waits: the table's
/// formulas, with cull(0) in cycle 1. `drawn` has each triangle's verdict; at least one must be drawn.
[[nodiscard]] std::uint64_t last_leave_at_full_rate(const SetupModel& model, const std::vector<bool>& drawn);

/// Keeps the table in step with the pins.
class SetupTiming final : public UnitTiming {
 public:
  /// Counts what it sees in `coverage`.
  SetupTiming(const SetupModel& model, SetupCoverage& coverage) : model_(model), coverage_(coverage) {
    clear();
  }

  std::optional<Failure> cycle(const UnitPins& pins) override;
  /// After reset ready comes from a register that has yet to see the credits.
  void clear() override;

 private:
  /// A triangle in the cull stage or its queue.
  struct Judged {
    std::uint64_t visible_at = 0;
    bool drawn = false;
  };

  [[nodiscard]] std::optional<Failure> compare(const UnitPins& pins) const;
  void decide(const UnitPins& pins);

  const SetupModel& model_;
  SetupCoverage& coverage_;
  std::deque<Judged> queue_;
  std::deque<std::uint64_t> visible_at_;  ///< of the drawn ones that have not left
  std::uint64_t divider_next_ = 0;        ///< first cycle in which the divider takes another
  bool ready_ = false;
  bool slot_usable_ = false;
  std::uint64_t left_ = 0;
};

}  // namespace halfspace::tb
