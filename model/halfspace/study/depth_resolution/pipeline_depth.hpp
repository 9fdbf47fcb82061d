/// Depth as this pipeline finds it: planes drawn as triangles, and codes read from the depth surface.
#pragma once

#include <cstdint>
#include <vector>

#include "halfspace/numerics/depth.hpp"
#include "halfspace/study/depth_resolution/camera.hpp"
#include "halfspace/units/depth_interpolator.hpp"

namespace halfspace::study {

/// How planes lie.
enum class Slope : std::uint8_t {
  kFacing,  ///< all of a plane at its distance
  kTilted,  ///< vertices nearer and farther by up to half of the distance
};

/// For each distance, of which there may be 16,384, the stored code of a sample of its plane. The triangles
/// of all planes are alike on the screen, so the codes should be in the order of the distances.
std::vector<std::uint32_t> pipeline_codes(const Planes& planes, Projection projection, Transform transform,
                                          DepthFormat format, DepthInterpolator interpolator, Slope slope,
                                          const std::vector<double>& distances);

}  // namespace halfspace::study
