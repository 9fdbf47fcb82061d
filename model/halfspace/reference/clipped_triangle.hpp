/// The way of a triangle that most rasterizers share: clip, project, snap, cull, fill.
#pragma once

#include <vector>

#include "halfspace/reference/coverage_method.hpp"
#include "halfspace/reference/triangle_method.hpp"

namespace halfspace::reference {

/// A rectangle of pixels that holds the triangle.
[[nodiscard]] PixelRect bounding_box(const GridTriangle& t, int subpixel_bits);

/// The planes of the clip volume's depth, unless the draw clamps depth, and of the guard band.
[[nodiscard]] std::vector<Homogeneous> guard_band(const DrawState& draw);

/// Clips `triangle` by `planes` and fills what is left, a fan around its first corner, by `cover`.
[[nodiscard]] DrawnTriangle draw_clipped(const ClipTriangle& triangle, const DrawState& draw,
                                         const std::vector<Homogeneous>& planes, CoverageMethod cover);

}  // namespace halfspace::reference
