/// Colours for vertices: a frame has none.
#pragma once

#include <cmath>
#include <cstdint>

#include "halfspace/reference/clip.hpp"

namespace halfspace::reference {

/// A bright colour whose hue is `index` steps of the golden ratio round the circle, so that neighbours
/// differ.
inline Color vertex_color(std::uint32_t index) {
  constexpr double kGoldenRatio = 0.6180339887498949;
  const double turns = index * kGoldenRatio;
  Color color;
  for (std::size_t i = 0; i < 3; ++i) {
    // Each channel is highest at its own third of the circle.
    const double turn = turns - static_cast<double>(i) / 3;
    const double away = std::abs(turn - std::nearbyint(turn));  // 0 to 1/2
    color[i] = std::fmin(std::fmax(2 - 6 * away, 0), 1);
  }
  return color;
}

}  // namespace halfspace::reference
