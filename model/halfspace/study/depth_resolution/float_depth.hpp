/// Depth as the published experiment finds it: points, and float32 from the shader to the code.
#pragma once

#include <vector>

#include "halfspace/numerics/depth.hpp"
#include "halfspace/study/depth_resolution/camera.hpp"

namespace halfspace::study {

/// For each distance the code of a point somewhere in view, as a float32 number: the depth itself of float32.
std::vector<float> float_depths(const Planes& planes, Projection projection, Transform transform,
                                DepthFormat format, const std::vector<double>& distances);

}  // namespace halfspace::study
