/// What is exchangeable in the rasterizer of a frame: how a triangle in clip space becomes fragments.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "halfspace/reference/clip.hpp"
#include "halfspace/reference/depth_code.hpp"
#include "halfspace/reference/options.hpp"
#include "halfspace/reference/pixel_rect.hpp"
#include "halfspace/scene/frame.hpp"

namespace halfspace::reference {

/// Everything about a draw that its triangles share.
struct DrawState {
  const Command& command;
  const Options& options;
  Storage storage;
  PixelRect window;  ///< scissor, viewport and target: no other pixel may be drawn
  TieRule rule;
};

/// A covered sample on its way to the depth test.
struct Fragment {
  std::int64_t x = 0;
  std::int64_t y = 0;
  double depth = 0;
  Color color = {};  ///< of a method that has colours
};

/// In rising order: a triangle has the highest of its pieces.
enum class Fate { kClippedAway, kDegenerate, kCulled, kDrawn };

/// What became of a triangle. Clipping may cut it into several pieces; each covers a sample at most once, and
/// its fragments are in any order.
struct DrawnTriangle {
  Fate fate = Fate::kClippedAway;
  std::vector<std::vector<Fragment>> pieces;
};

/// Three finite positions in clip space, with the colours of the vertices.
using ClipTriangle = std::array<Corner, 3>;

using TriangleMethod = DrawnTriangle (*)(const ClipTriangle& triangle, const DrawState& draw);

}  // namespace halfspace::reference
