/// `exact`: coverage by its definition, of pixel centres or of pixels.
#pragma once

#include <vector>

#include "halfspace/reference/coverage_method.hpp"

namespace halfspace::reference {

/// Asks covers(), touches() or fills() for each pixel of the bounding box.
void cover_exactly(const Piece& piece, std::vector<Fragment>& fragments);

}  // namespace halfspace::reference
