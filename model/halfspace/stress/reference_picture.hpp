/// The picture of a textbook rasterizer.
#pragma once

#include "halfspace/reference/rasterizer.hpp"
#include "halfspace/stress/subject.hpp"

namespace halfspace::stress {

/// Clips at the limit of the window only, as the pipeline does.
inline Picture reference_picture(const Frame& frame, int sub_pixel_bits, const reference::Method& method) {
  const reference::Options options{.subpixel_bits = sub_pixel_bits, .guard_band = 1e9};
  const reference::Surface surface = reference::rasterize(frame, options, method).at(0);
  return {.width = surface.width,
          .height = surface.height,
          .fragments = {surface.fragments.begin(), surface.fragments.end()},
          .survivors = {surface.survivors.begin(), surface.survivors.end()},
          .codes = surface.codes};
}

}  // namespace halfspace::stress
