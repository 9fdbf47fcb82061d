/// Random meshes for quad merging.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "../timing/random_machine.hpp"
#include "halfspace/whatif/quad_merging.hpp"

namespace halfspace::testing {

/// Cells of a few pixels, or of less than one, with moved corners, drawn row by row or in any order; some
/// triangles are turned round, some draws share vertices by index, some cover others.
inline Frame meshed_frame(Random& random) {
  constexpr int kSize = 32;
  FrameBuilder builder(kSize);
  const auto real = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random.between(0, 1 << 20)) / (1 << 20);
  };
  for (auto draws = random.between(1, 3); draws > 0; --draws) {
    const double cell = pick(random, {0.4, 0.7, 1.0, 1.5, 2.0, 3.0, 7.0});
    const std::uint32_t cells = static_cast<std::uint32_t>(random.between(1, 24));
    const glm::dvec2 at(real(0, 8), real(0, 8));
    std::vector<glm::dvec3> corners;
    for (std::uint32_t i = 0; i < (cells + 1) * (cells + 1); ++i) {
      corners.emplace_back(at.x + cell * (i % (cells + 1) + real(-0.2, 0.2)),
                           at.y + cell * (i / (cells + 1) + real(-0.2, 0.2)), real(0.25, 0.75));
    }
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::uint32_t i = 0; i < cells * cells; ++i) {
      const std::uint32_t corner = i / cells * (cells + 1) + i % cells;
      triangles.push_back({corner, corner + 1, corner + cells + 1});
      triangles.push_back({corner + 1, corner + cells + 2, corner + cells + 1});
    }
    const bool turns = random.between(0, 2) == 0;
    const bool shuffles = random.between(0, 2) == 0;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      if (turns && random.between(0, 3) == 0) {
        std::swap(triangles[i][0], triangles[i][1]);
      }
      if (shuffles) {
        std::swap(triangles[i], triangles[static_cast<std::size_t>(random.between(0, static_cast<int>(i)))]);
      }
    }
    const bool by_index = random.between(0, 1) == 0;
    std::vector<glm::dvec3> window;
    std::vector<std::uint32_t> indices;
    for (const std::array<std::uint32_t, 3>& triangle : triangles) {
      for (const std::uint32_t corner : triangle) {
        window.push_back(corners[corner]);
        indices.push_back(corner);
      }
    }
    Command& draw = builder.draw(by_index ? corners : window);
    if (by_index) {
      builder.frame.indices.resize(draw.first_index);
      builder.frame.indices.insert(builder.frame.indices.end(), indices.begin(), indices.end());
      draw.index_count = static_cast<std::uint32_t>(indices.size());
    }
    draw.depth_func = pick(random, {DepthFunc::kLess, DepthFunc::kLess, DepthFunc::kAlways});
    draw.flags &= ~(random.between(0, 7) == 0 ? bits({Flag::kColorWrite}) : 0u);
  }
  return builder.frame;
}

/// Quads that a buffer may hold.
inline int random_buffer(Random& random) { return pick(random, {0, 1, 2, 3, 8, 32, 100, kMostMergeQuads}); }

}  // namespace halfspace::testing
