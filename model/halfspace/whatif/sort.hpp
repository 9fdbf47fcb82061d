/// What if the draws came in another order?
#pragma once

#include "halfspace/whatif/draw_ranges.hpp"

namespace halfspace::whatif {

enum class SortOrder { kFrontToBack, kBackToFront };

/// How far a draw that may move reaches: the largest window depth of its triangles where they are between
/// near and far, and the negative of the least where the draw tests GREATER or GEQUAL, for then a larger
/// depth is nearer. Minus infinity where nothing is there. The sides of the screen do not clip, nor does
/// polygon offset count. By this key a floor that begins at the viewer's feet is behind what stands on it; by
/// the nearest depth it would be in front of everything.
[[nodiscard]] double farthest_depth(const Frame& frame, const Command& draw);

/// Sorts the draws of each range (draw_ranges.hpp) by farthest_depth, those at the same depth in their order.
/// The triangles of a draw stay in theirs. The depth of every sample at the end of a range stays the same.
Acted sort(Frame& frame, SortOrder order);

/// Walks each range backwards: the last triangle of the last draw comes first. The depth of every sample at
/// the end of a range stays the same.
Acted reverse(Frame& frame);

}  // namespace halfspace::whatif
