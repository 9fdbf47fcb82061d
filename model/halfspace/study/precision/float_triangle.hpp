/// The triangles of the study: in window coordinates, as float32 has them before they are snapped.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include "halfspace/numerics/error.hpp"
#include "halfspace/reference/exact_triangle.hpp"
#include "halfspace/reference/float_edges.hpp"
#include "halfspace/reference/pixel_rect.hpp"

namespace halfspace::study {

using FloatTriangle = std::array<reference::FloatPoint<float>, 3>;
using reference::PixelRect;

/// A grid that holds every float32 position of 2^-17 pixel or more, and those of multiples of 2^-40.
inline constexpr int kPositionBits = 40;

/// On the grid of 1/2^bits pixel, halves to even: as the front end snaps.
inline reference::GridPoint snapped(const reference::FloatPoint<float>& p, int bits) {
  const double scale = std::ldexp(1.0, bits);
  return {std::llrint(double{p.x} * scale), std::llrint(double{p.y} * scale)};
}

inline reference::GridTriangle snapped(const FloatTriangle& t, int bits) {
  return {snapped(t[0], bits), snapped(t[1], bits), snapped(t[2], bits)};
}

/// The triangle where it is. Throws InputError for one that has no place on the grid.
inline reference::GridTriangle in_place(const FloatTriangle& t) {
  const reference::GridTriangle grid = snapped(t, kPositionBits);
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::ldexp(static_cast<double>(grid[i].x), -kPositionBits) != double{t[i].x} ||
        std::ldexp(static_cast<double>(grid[i].y), -kPositionBits) != double{t[i].y}) {
      throw InputError("position is (" + std::to_string(t[i].x) + ", " + std::to_string(t[i].y) +
                       "); it must be a multiple of 2^-40 pixel");
    }
  }
  return grid;
}

/// The pixels of `target` that the bounding box touches.
inline PixelRect touched(const FloatTriangle& t, const PixelRect& target) {
  const auto [x_min, x_max] = std::minmax({t[0].x, t[1].x, t[2].x});
  const auto [y_min, y_max] = std::minmax({t[0].y, t[1].y, t[2].y});
  const auto pixel = [](float value) { return static_cast<std::int64_t>(value); };
  return reference::intersect(
      {pixel(std::floor(x_min)), pixel(std::floor(y_min)), pixel(std::ceil(x_max)), pixel(std::ceil(y_max))},
      target);
}

}  // namespace halfspace::study
