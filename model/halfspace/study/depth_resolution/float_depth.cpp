#include "halfspace/study/depth_resolution/float_depth.hpp"

#include <cmath>

#include "halfspace/numerics/split_mix.hpp"

namespace halfspace::study {

std::vector<float> float_depths(const Planes& planes, Projection projection, Transform transform,
                                DepthFormat format, const std::vector<double>& distances) {
  const Camera camera(planes, projection, transform);
  SplitMix64 random(1);
  const double top = std::tan(0.65);  // the view: Reed's
  const double right = top * 16 / 9;
  std::vector<float> depths;
  for (const double distance : distances) {
    const double x = random.real(-right, right) * distance;
    const double y = random.real(-top, top) * distance;
    const glm::vec4 clip = camera.clip({x, y, distance});
    float depth = clip.z / clip.w;
    if (is_gl(projection)) {
      depth = 0.5F * depth + 0.5F;
    }
    depths.push_back(format == DepthFormat::kFloat32
                         ? depth
                         : std::nearbyint(depth * static_cast<float>(max_unorm_code(format))));
  }
  return depths;
}

}  // namespace halfspace::study
