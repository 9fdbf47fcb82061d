/// `scanline`: the triangle is split at its middle vertex, and in each half two edges are active (J. Foley,
/// A. van Dam, S. Feiner, J. Hughes, "Computer Graphics: Principles and Practice", 2nd edition, 3.6, the
/// active-edge table). The edges step from row to row as in C. Hecker, "Perspective texture mapping, part 3:
/// endpoints and mapping", Game Developer, August/September 1995: whole pixels and an integer remainder.
#pragma once

#include <vector>

#include "halfspace/reference/coverage_method.hpp"

namespace halfspace::reference {

/// Exact: where an edge crosses a row of centres is a fraction, of which the step loses nothing. No edge
/// function is evaluated; the tie rule is which ends of rows and spans are closed.
void cover_by_scanlines(const Piece& piece, std::vector<Fragment>& fragments);

}  // namespace halfspace::reference
