/// What the machine makes of a frame, in every fidelity.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "halfspace/machine/core.hpp"
#include "halfspace/machine/packet_sums.hpp"
#include "halfspace/numerics/depth.hpp"
#include "halfspace/scene/frame.hpp"
#include "halfspace/units/counters.hpp"
#include "halfspace/units/tiled_image.hpp"

namespace halfspace {

inline constexpr std::uint32_t kNothingVisible = 0xFFFFFFFFu;

/// A depth surface, or a target without depth, and what happened to its samples: the images have a value for
/// each sample of each pixel. Without a clear depth starts at 1.
struct Surface {
  std::optional<std::uint32_t> target;  ///< without depth: the target that it is
  DepthFormat format = DepthFormat::kNone;
  TiledImage<std::uint32_t> codes;      ///< stored depth codes; without depth only their size counts
  TiledImage<std::uint16_t> fragments;  ///< fragments that covered each sample, at most 65535; on request
  TiledImage<std::uint16_t> survivors;  ///< fragments that passed early-Z, at most 65535; on request
  /// The triangle that wrote the depth last, counted through all draws, or kNothingVisible. On a surface
  /// where no draw writes depth, the one that passed last. Kept on request.
  TiledImage<std::uint32_t> visible;
  PacketSums sums;        ///< on request
  Counters counters;      ///< of all draws on the surface
  Counters drawn_clears;  ///< of its clears that went through the pipe as rectangles
};

/// One draw of the frame.
struct DrawStats {
  std::uint32_t command = 0;           ///< index in Frame::commands
  std::uint32_t surface = kNoSurface;  ///< depth surface
  Counters counters;
};

struct FrameResult {
  Core core = Core::kReadable;  ///< that made it
  /// By depth surface number; behind them the targets without depth that something is drawn to.
  std::vector<Surface> surfaces;
  std::vector<DrawStats> draws;
  Counters counters;                ///< of the whole frame
  Counters drawn_clears;            ///< of all surfaces
  std::uint64_t clears = 0;         ///< clears of depth
  std::uint64_t flushed_lines = 0;  ///< of the z cache, written back at the end
  std::uint64_t flushed_bytes = 0;
  std::uint64_t draws_not_filled = 0;  ///< skipped: their polygons are drawn as lines or points
};

}  // namespace halfspace
