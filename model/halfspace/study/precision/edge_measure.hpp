/// How wrong an arithmetic of the edge function is, and how fast in software.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "halfspace/study/precision/edge_workloads.hpp"

namespace halfspace::study {

/// Of one arithmetic on some drawings. An arithmetic that snaps is judged on its own grid, but for `moved`.
struct EdgeTally {
  std::uint64_t triangles = 0;
  std::uint64_t samples = 0;  ///< in the bounding boxes
  std::uint64_t covered = 0;  ///< of these, by definition
  std::uint64_t wrong = 0;    ///< covered and not found, or found and not covered
  std::uint64_t moved = 0;    ///< the same against the triangle before snapping
  std::uint64_t pixels = 0;   ///< covered by anything, by definition
  std::uint64_t gaps = 0;     ///< of these, with fewer fragments than by definition
  std::uint64_t doubles = 0;  ///< of all, with more

  EdgeTally& operator+=(const EdgeTally& other);
};

/// One tally for each of edge_subjects(). Judged by reference::covers.
[[nodiscard]] std::vector<EdgeTally> measure_edges(const Drawing& drawing);

/// Of processor time, not of the clock on the wall: medians of rounds in which all take turns.
struct EdgeTime {
  double nanoseconds = 0;  ///< a sample of the bounding boxes
  double ratio = 0;        ///< to the baseline's of the same round
};

/// For each of edge_subjects().
[[nodiscard]] std::vector<EdgeTime> time_edges(std::span<const FloatTriangle> triangles,
                                               const PixelRect& target, int rounds);

}  // namespace halfspace::study
