/// What the studies take from the baseline machine.
#pragma once

#include "halfspace/config/config.hpp"

namespace halfspace::study {

inline constexpr int kSubPixelBits = Config{}.raster.sub_pixel_bits;

}  // namespace halfspace::study
