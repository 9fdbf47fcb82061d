/// Coverage without a walk: the samples of a triangle by its edge functions, pixel by pixel. The ledger takes
/// from here what there is to account for, so that no unit is asked what it skipped.
#pragma once

#include <cstdint>

#include "halfspace/units/packets.hpp"

namespace halfspace::ledger {

struct Covered {
  std::uint64_t samples = 0;
  std::uint64_t quads = 0;  ///< aligned 2x2 pixels with a covered sample
};

Covered covered(const SetupTriangle& triangle, int sub_pixel_bits);

}  // namespace halfspace::ledger
