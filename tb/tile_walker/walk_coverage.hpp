/// Functional coverage of tile_walker: what the runs of a bench have met, counted in named bins. Bins that a
/// configuration cannot meet do not exist in it.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "reference_walk.hpp"

namespace halfspace::tb {

class WalkCoverage {
 public:
  explicit WalkCoverage(const WalkerParameters& parameters);

  /// A triangle is taken: every decision by the edges that made it and their directions, the jobs' accept
  /// bits and bounds.
  void taken(std::span<const std::uint32_t> triangle, const Walk& walk, std::uint8_t slot);
  /// A triangle came when nothing was there.
  void loaded_when_idle();
  /// The last step of a triangle; `next` tells that the next is loaded in it.
  void triangle_done(StepKind last, bool next);
  /// A step has waited for a credit.
  void waited(bool first_step, bool last_step);
  void reset(bool under_way, bool waiting);

  [[nodiscard]] std::size_t bins() const { return bins_.size(); }
  /// Names of the bins that nothing has hit.
  [[nodiscard]] std::vector<std::string> missed() const;

 private:
  void hit(const std::string& name);
  /// The counter of what may have no bin.
  void hit_decision(StepKind kind, std::size_t edge, std::size_t direction);
  [[nodiscard]] bool possible(StepKind kind) const;

  WalkerParameters parameters_;
  std::map<std::string, std::uint64_t> bins_;
  /// The counters of decisions, by kind, edge and direction; null where there is no such bin.
  std::array<std::array<std::array<std::uint64_t*, 9>, 3>, kStepKinds> decisions_{};
  std::array<std::uint64_t*, 8> accepts_{};              ///< the counters of jobs, by accept bits
  std::array<std::array<std::uint64_t*, 2>, 4> cuts_{};  ///< by side of the tile, cut or not
};

}  // namespace halfspace::tb
