/// The same points in this pipeline: the front end snaps them, and edges are integers.
#pragma once

#include <array>
#include <vector>

#include "halfspace/reference/exact_triangle.hpp"
#include "halfspace/study/baseline.hpp"
#include "halfspace/study/orientation/grid.hpp"

namespace halfspace::study {

/// The unit of the paper in pixels: a power of two, so that nothing is rounded, and as large as leaves r
/// inside the guard band.
inline constexpr int kPixels = 1024;

using SnappedTriple = std::array<reference::GridPoint, 3>;

/// What the front end makes of the vertices p, q and r, whose coordinates must be float32, and the
/// orientation that setup finds.
struct Snapped {
  SnappedTriple points;
  int orientation;
};
std::vector<Snapped> snapped(const Grid& grid);

/// How often two triangles on both sides of the line through q and r cover a sample at p: the fast core draws
/// them.
int covered(const SnappedTriple& points);

}  // namespace halfspace::study
