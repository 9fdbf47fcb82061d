/// `incremental`: edge functions by addition (J. Pineda, "A parallel algorithm for polygon rasterization",
/// SIGGRAPH 1988).
#pragma once

#include <vector>

#include "halfspace/reference/coverage_method.hpp"

namespace halfspace::reference {

/// Each edge function is evaluated at the first pixel of the box, and then only steps: by A to the right, by
/// B down. In integers no step rounds. An edge that does not own its samples begins 1 lower, so that the sign
/// alone decides.
void cover_by_increments(const Piece& piece, std::vector<Fragment>& fragments);

}  // namespace halfspace::reference
