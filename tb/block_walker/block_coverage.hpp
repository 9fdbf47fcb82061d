/// Functional coverage of block_walker: what the runs of a bench have met, in bins that its configuration can
/// meet.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/bins.hpp"
#include "common/edge_direction.hpp"
#include "reference_walk.hpp"

namespace halfspace::tb {

class BlockCoverage {
 public:
  explicit BlockCoverage(const BlockWalkerParameters& parameters);

  /// A triangle is taken: what the edges do to its tiles, and what its blocks are like.
  void taken(const std::vector<BlockStep>& steps, std::uint8_t slot);
  /// A triangle came when nothing was there.
  void loaded_when_idle() { bins_.hit("taken when idle"); }
  /// The last step of a triangle; `next` tells that the next is loaded in it.
  void triangle_done(const BlockStep& last, bool next);
  /// A step has waited for a credit.
  void waited(bool first_step, bool last_step, bool leaves);
  void reset(bool under_way, bool waiting);

  [[nodiscard]] bool report() const { return bins_.report(); }

 private:
  using Counters = std::array<std::uint64_t*, 64>;
  using EdgeCounters = std::array<std::array<std::uint64_t*, kDirections>, 3>;

  void step(const BlockStep& step, const std::array<std::size_t, 3>& direction);
  void few_samples(const BlockStep& step);
  void shape(const std::vector<BlockStep>& steps);

  BlockWalkerParameters parameters_;
  Bins bins_;
  // Counters by edge and direction, and by tile of the block; null where there is no such bin.
  EdgeCounters edge_outside_{};  ///< of this edge alone
  EdgeCounters edge_crosses_{};
  EdgeCounters edge_inside_{};
  Counters tile_kept_{};
  std::array<Counters, 3> tile_outside_{};  ///< by edge
  Counters tile_untouched_{};
  std::array<std::array<std::uint64_t*, 2>, 4> cuts_{};  ///< by side of the block, cut or not
};

}  // namespace halfspace::tb
