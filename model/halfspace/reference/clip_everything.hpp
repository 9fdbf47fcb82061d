/// `clip_everything`: cuts a triangle by all six planes of the clip volume before it is filled (I.
/// Sutherland, G. Hodgman, "Reentrant polygon clipping", CACM 17(1), 1974), without a guard band.
#pragma once

#include "halfspace/reference/triangle_method.hpp"

namespace halfspace::reference {

/// A cut is where the parametric line from the inner to the outer vertex meets the plane. It is a new vertex
/// that is snapped like any other, so cut edges are not quite where they were; the fill is exact.
[[nodiscard]] DrawnTriangle draw_clipped_by_everything(const ClipTriangle& triangle, const DrawState& draw);

}  // namespace halfspace::reference
