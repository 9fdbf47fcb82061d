/// `float_epsilon`: edge functions in float32, and ties within a tolerance. A subject of study that is wrong:
/// it leaves gaps, and draws samples twice.
#pragma once

#include <vector>

#include "halfspace/reference/coverage_method.hpp"

namespace halfspace::reference {

/// What |E| may be, in square pixels, for a sample to count as on the edge.
inline constexpr float kEdgeEpsilon = 1e-3F;

/// E = A x + B y + C on the snapped vertices, with all numbers rounded to float32. C comes from the vertex at
/// which the edge begins, which is another one for the triangle on the other side: what the two find does not
/// quite cancel. A sample with |E| <= kEdgeEpsilon is taken for a tie, and the tie rule decides, so that each
/// edge moves by another distance and edges that met in a vertex no longer do.
void cover_with_epsilon(const Piece& piece, std::vector<Fragment>& fragments);

}  // namespace halfspace::reference
