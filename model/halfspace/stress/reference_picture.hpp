/// The picture of a textbook rasterizer.
#pragma once

#include "halfspace/reference/rasterizer.hpp"
#include "halfspace/stress/case.hpp"
#include "halfspace/stress/subject.hpp"

namespace halfspace::stress {

/// Clips far outside of the pipeline's guard band, so that nothing is cut that the definition has whole; a
/// depth is rounded once.
inline Picture reference_picture(const Frame& frame, const Precision& precision,
                                 const reference::Method& method) {
  const reference::Options options{.rule = precision.rule,
                                   .subpixel_bits = precision.sub_pixel_bits,
                                   .guard_band = 1e9,
                                   .window_limit = 1 << 20,
                                   .float32_depth = false};
  const reference::Surface surface = reference::rasterize(frame, options, method).at(0);
  return {.width = surface.width,
          .height = surface.height,
          .fragments = {surface.fragments.begin(), surface.fragments.end()},
          .survivors = {surface.survivors.begin(), surface.survivors.end()},
          .codes = surface.codes};
}

}  // namespace halfspace::stress
