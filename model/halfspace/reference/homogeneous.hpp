/// `homogeneous`: M. Olano and T. Greer, "Triangle scan conversion using 2D homogeneous coordinates",
/// Graphics Hardware 1997. Nothing is clipped, and no vertex is divided by its w, which may be 0 or negative.
#pragma once

#include "halfspace/reference/triangle_method.hpp"

namespace halfspace::reference {

/// Double precision, on vertices that are not snapped: a sample closer to an edge than snapping moves it is
/// covered differently. Triangles that share an edge still cover each sample once.
[[nodiscard]] DrawnTriangle draw_homogeneously(const ClipTriangle& triangle, const DrawState& draw);

}  // namespace halfspace::reference
