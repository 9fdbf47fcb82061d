/// The cycle table of docs/units/block_walker.md as the pins that follow from it:
///
///     accept(m)  = max(visible(m), done(m-1))
///     t          = max(t of the step before + 1, or accept(m) + 1, a credit is usable)
///     visible(n) = t + 2             of a block that leaves; only such a one uses the credit
///     done(m)    = t of the last step
///
/// and the slot of a triangle is written in the cycle after accept(m).
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "block_coverage.hpp"
#include "common/unit_timing.hpp"
#include "reference_walk.hpp"

namespace halfspace::tb {

class BlockTiming final : public UnitTiming {
 public:
  /// Counts what it sees in `coverage`.
  BlockTiming(const BlockWalkerParameters& parameters, BlockCoverage& coverage)
      : parameters_(parameters), words_(parameters.sizes.widths()), coverage_(coverage) {}

  std::optional<Failure> cycle(const UnitPins& pins) override;
  void clear() override;

 private:
  /// The triangle on its walk.
  struct Triangle {
    std::vector<BlockStep> steps;
    std::size_t next = 0;
    bool drawn = false;   ///< has given out a block
    bool waited = false;  ///< the next step, for a credit
    [[nodiscard]] bool done() const { return next == steps.size(); }
  };

  void step(std::uint64_t cycle);
  [[nodiscard]] std::optional<Failure> compare(const UnitPins& pins, bool ready) const;
  [[nodiscard]] std::optional<Failure> compare_slot(const UnitPins& pins) const;
  void take(const UnitPins& pins);

  BlockWalkerParameters parameters_;
  InputWords words_;
  BlockCoverage& coverage_;
  int credits_ = 0;
  bool after_reset_ = true;  ///< ready comes from a register that has yet to rise
  bool was_reset_ = false;   ///< at least once
  std::optional<Triangle> triangle_;
  std::deque<std::uint64_t> visible_at_;
  std::uint64_t left_ = 0;
  std::uint8_t slot_ = 0;
  std::vector<std::uint32_t> written_;  ///< equation and state to be written in this cycle; empty: none
};

}  // namespace halfspace::tb
