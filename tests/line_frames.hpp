/// Frames of lines and points for tests.
#pragma once

#include "halfspace/config/config.hpp"
#include "halfspace/scene/frame_builder.hpp"
#include "property/random.hpp"
#include "timing/random_machine.hpp"

namespace halfspace::testing {

/// Lines and points in window coordinates on a grid of 1/256 pixel, with every rule that the machine takes.
/// `thin`: thin lines may be among them.
inline Frame random_lines(Random& random, bool thin) {
  const int size = static_cast<int>(pick(random, {16, 64, 128}));
  FrameBuilder builder(static_cast<std::uint32_t>(size),
                       pick(random, {DepthFormat::kUnorm16, DepthFormat::kUnorm24, DepthFormat::kFloat32}));
  for (auto draws = random.between(1, 6); draws > 0; --draws) {
    const std::int64_t grid = pick(random, {1, 32, 128, 256});
    const std::int64_t reach = size * pick(random, {256, 512});
    std::vector<glm::dvec3> vertices;
    const auto primitive = static_cast<Primitive>(random.between(0, 3));
    for (auto n = 6 * random.between(1, 6); n > 0; --n) {
      const auto at = [&] {
        return static_cast<double>(random.between(-reach / 8, reach) / grid * grid) / 256;
      };
      vertices.emplace_back(at(), at(), static_cast<double>(random.between(0, 64)) / 64);
    }
    Command& draw = builder.draw(vertices);
    draw.primitive = primitive;
    if (primitive == Primitive::kTriangles) {
      draw.polygon_mode = static_cast<PolygonMode>(random.between(0, 2));
      draw.flags |= random.between(0, 3) == 0 ? bits({Flag::kPolygonOffset, Flag::kCullBack}) : 0;
      draw.offset_units = static_cast<float>(random.between(-2, 2));
      draw.offset_factor = static_cast<float>(random.between(-1, 1));
    }
    if (primitive == Primitive::kLineStrip) {
      const std::size_t first = draw.first_index;
      for (std::size_t i = first + 2; i < builder.frame.indices.size(); i += 2) {
        if (random.between(0, 4) != 0) {
          builder.frame.indices[i] = builder.frame.indices[i - 1];
        }
      }
    }
    draw.line_rule = thin ? static_cast<LineRule>(random.between(0, 4)) : LineRule::kRectangular;
    draw.line_width = pick(random, {1.0F, 1.0F, 0.4F, 2.5F, 7.0F});
    draw.point_size = pick(random, {1.0F, 0.4F, 3.5F, 8.0F, 21.25F});
    if (random.between(0, 2) == 0) {
      draw.stipple = {.factor = static_cast<std::uint16_t>(random.between(1, 5)),
                      .pattern = static_cast<std::uint16_t>(random.between(0, 0xFFFF))};
    }
    draw.flags |= random.between(0, 3) == 0 ? bits({Flag::kBottomLeftRule}) : 0;
    draw.depth_func =
        pick(random, {DepthFunc::kLess, DepthFunc::kLess, DepthFunc::kGreater, DepthFunc::kAlways});
    if (random.between(0, 3) == 0) {
      draw.scissor = random_scissor(random, size);
    }
  }
  return builder.frame;
}

/// Whether the machine draws thin lines.
inline bool takes_thin_lines(const Config& config) {
  return config.depth.interpolator == DepthInterpolator::kPlane;
}

}  // namespace halfspace::testing
