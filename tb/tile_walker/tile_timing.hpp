/// The cycle table of docs/units/tile_walker.md as the pins that follow from it:
///
///     x(n)       = max(visible(block), x(n-1) + 1, a credit is usable)
///     visible(n) = x(n) + 3
///
/// and the block is taken in the cycle of its last job: a tile has one for each sample of a pixel.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "common/unit_timing.hpp"
#include "parameters.hpp"
#include "tile_coverage.hpp"

namespace halfspace::tb {

class TileTiming final : public UnitTiming {
 public:
  /// Counts what it sees in `coverage`.
  TileTiming(const TileWalkerParameters& parameters, TileCoverage& coverage)
      : parameters_(parameters), coverage_(coverage) {}

  std::optional<Failure> cycle(const UnitPins& pins) override;
  void clear() override;

 private:
  [[nodiscard]] std::optional<Failure> compare(const UnitPins& pins, bool ready) const;
  void make_job(std::uint64_t cycle, std::uint64_t tiles);
  [[nodiscard]] bool is_last_sample() const { return sample_ + 1 == parameters_.sizes.samples; }

  TileWalkerParameters parameters_;
  TileCoverage& coverage_;
  int credits_ = 0;
  bool usable_ = false;       ///< a credit is, in this cycle
  bool was_reset_ = false;    ///< at least once
  bool begun_ = false;        ///< the block at the input has given a job
  bool waited_ = false;       ///< its next job, for a credit
  bool was_done_ = false;     ///< a block was taken in the cycle before
  std::uint64_t passed_ = 0;  ///< tiles all of whose jobs are made
  int sample_ = 0;            ///< of the next job
  std::deque<std::uint64_t> visible_at_;
  std::uint64_t left_ = 0;
};

}  // namespace halfspace::tb
