/// Functional coverage of tile_walker: what the runs of a bench have met, in bins that its configuration can
/// meet.
#pragma once

#include <array>
#include <cstdint>

#include "common/bins.hpp"
#include "common/edge_direction.hpp"
#include "halfspace/units/packets.hpp"
#include "parameters.hpp"

namespace halfspace::tb {

class TileCoverage {
 public:
  explicit TileCoverage(const TileWalkerParameters& parameters);

  /// A block is offered: its mask, and what its jobs are like. `at_once`: in the cycle after the block before
  /// was taken.
  void block(const BlockJob& block, bool at_once);
  /// A job of a block has waited for a credit.
  void waited(bool first, bool last);
  /// `begun`: a block had given some of its jobs; `waiting`: a job waited for a credit; `in_tile`: a tile had
  /// given some of its samples.
  void reset(bool begun, bool waiting, bool in_tile);

  [[nodiscard]] bool report() const { return bins_.report(); }

 private:
  void job(const TileJob& job, const std::array<std::size_t, 3>& direction);

  TileWalkerParameters parameters_;
  Bins bins_;
  // Counters by edge and direction, null where there is no such bin; of jobs by accept bits, and by side of
  // the tile, cut or not; by tile of the block, alone in the mask or not.
  std::array<std::array<std::uint64_t*, kDirections>, 3> edge_accepts_{};
  std::array<std::array<std::uint64_t*, kDirections>, 3> edge_does_not_{};
  std::array<std::uint64_t*, 8> accepts_{};
  std::array<std::array<std::uint64_t*, 2>, 4> cuts_{};
  std::array<std::array<std::uint64_t*, 2>, 64> tiles_{};
  std::array<std::uint64_t*, kMostSamples> samples_{};  ///< jobs of each sample of a pixel
};

}  // namespace halfspace::tb
