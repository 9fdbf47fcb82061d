/// What a large depth surface costs a run, by frames that draw on none, on few and on many of its tiles. Each
/// run is one in a process of its own, whose memory is fresh, as that of `halfspace run` is.
#pragma once

#include <cstdint>
#include <functional>

#include "halfspace/scene/frame.hpp"

namespace halfspace {

/// Square frames with one unorm24 surface. Sides in pixels; those of tiles are a power of two, and divide the
/// frame's.
struct SurfaceFrames {
  std::uint32_t side = 16384;
  std::uint32_t tile_side = 8;

  /// Nothing but so many clears of the whole surface.
  [[nodiscard]] Frame cleared(int clears) const;
  /// A clear, and a square of two triangles in the middle that covers tiles x tiles tiles whole.
  [[nodiscard]] Frame block(std::uint32_t tiles) const;
  /// A clear, and a triangle inside of each of `tiles` tiles that are spread over the whole surface.
  [[nodiscard]] Frame scattered(std::uint32_t tiles) const;
};

struct RunCost {
  double milliseconds = 0;
  double megabytes = 0;  ///< of memory (10^6 bytes), at the peak, more than before
};

/// What run() costs in a process of its own. Throws std::runtime_error where there is none, or it fails.
RunCost cost_of_fresh_run(const std::function<void()>& run);

}  // namespace halfspace
