#include "halfspace/study/depth_resolution/pipeline_depth.hpp"

#include <array>
#include <stdexcept>

#include "halfspace/core/functional.hpp"
#include "halfspace/scene/frame_builder.hpp"

namespace halfspace::study {
namespace {

constexpr std::uint32_t kSize = 128;  // of the target: a pixel for each plane

struct Pixel {
  int x;
  int y;
};

Pixel pixel_of(std::size_t plane) {
  return {static_cast<int>(plane % kSize), static_cast<int>(plane / kSize)};
}

struct Corner {
  double x;  ///< from the middle of the pixel, in pixels; a whole number of sub-pixels
  double y;
  double nearer;  ///< of a tilted plane, as a part of the distance
};
constexpr std::array<Corner, 3> kCorners{
    {{-100.0 / 256, -90.0 / 256, -0.5}, {110.0 / 256, -70.0 / 256, 0.25}, {10.0 / 256, 120.0 / 256, 0.4}}};

}  // namespace

std::vector<std::uint32_t> pipeline_codes(const Planes& planes, Projection projection, Transform transform,
                                          DepthFormat format, DepthInterpolator interpolator, Slope slope,
                                          const std::vector<double>& distances) {
  if (distances.size() > std::size_t{kSize} * kSize) {
    throw std::invalid_argument("more planes than pixels");
  }
  const Camera camera(planes, projection, transform);
  FrameBuilder builder(kSize, format);
  Command& draw = builder.draw({});
  draw.depth_func = DepthFunc::kAlways;
  // Rounding may move a position beyond near or far; clamped, it is drawn all the same.
  draw.flags |= bits({Flag::kDepthClamp});
  if (is_gl(projection)) {
    draw.flags |= bits({Flag::kNdcZMinusOneToOne});
  }
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const auto [x, y] = pixel_of(i);
    const double middle_x = x + 0.5;
    const double middle_y = y + 0.5;
    for (const Corner& corner : kCorners) {
      const double distance = distances[i] * (slope == Slope::kTilted ? 1 + corner.nearer : 1);
      const auto view = [&](double pixels) { return (pixels * 2 / kSize - 1) * distance; };
      builder.frame.vertices.push_back(
          camera.clip({view(middle_x + corner.x), view(middle_y + corner.y), distance}));
      builder.frame.indices.push_back(draw.vertex_count++);
    }
  }
  draw.index_count = draw.vertex_count;
  Config config;
  config.depth.interpolator = interpolator;
  const FrameResult result = run_functional(builder.frame, config, Watch{.count_pixels = true});
  const Surface& surface = result.surfaces.at(0);
  std::vector<std::uint32_t> codes;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const auto [x, y] = pixel_of(i);
    if (surface.fragments.at(x, y) != 1) {
      throw std::logic_error("a plane does not cover its sample once");
    }
    codes.push_back(surface.codes.at(x, y));
  }
  return codes;
}

}  // namespace halfspace::study
