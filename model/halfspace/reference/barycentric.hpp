/// `barycentric`: barycentric coordinates of each pixel of the bounding box. They say whether it is covered,
/// and they weigh what the vertices carry: depth, and the colour of H. Gouraud, "Continuous shading of curved
/// surfaces", IEEE Transactions on Computers C-20(6), 1971.
#pragma once

#include <vector>

#include "halfspace/reference/coverage_method.hpp"

namespace halfspace::reference {

/// Exact integers decide coverage; depth and colour are double. Depth is that of the plane through the
/// vertices as they were snapped.
void cover_barycentrically(const Piece& piece, std::vector<Fragment>& fragments);

}  // namespace halfspace::reference
