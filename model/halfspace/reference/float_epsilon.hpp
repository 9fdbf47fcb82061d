/// `float_epsilon`: edge functions in float32, and ties within a tolerance. A subject of study that is wrong:
/// it leaves gaps, and draws samples twice.
#pragma once

#include <vector>

#include "halfspace/reference/coverage_method.hpp"

namespace halfspace::reference {

/// What |E| may be, in square pixels, for a sample to count as on the edge.
inline constexpr float kEdgeEpsilon = 1e-3F;

/// E = A x + B y + C with all numbers rounded to float32, on the snapped vertices. A sample with |E| <=
/// kEdgeEpsilon is taken for a tie, and the tie rule decides.
void cover_with_epsilon(const Piece& piece, std::vector<Fragment>& fragments);

}  // namespace halfspace::reference
