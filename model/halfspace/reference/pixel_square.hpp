/// Conservative coverage of a pixel, by definition: whether a triangle and a square have a point in common,
/// or the triangle holds the square. From vertices, corners and crossing sides, in exact integers; of the
/// units, which compare edge functions, it shares no formula.
#pragma once

#include "halfspace/reference/exact_triangle.hpp"

namespace halfspace::reference {

/// Corners in the grid of 1/2^subpixel_bits pixel, both in it.
struct PixelSquare {
  GridPoint least;
  GridPoint most;
};

/// Pixel (x, y), larger by `uncertainty` sub-pixels on each side.
[[nodiscard]] PixelSquare pixel_square(std::int64_t x, std::int64_t y, int subpixel_bits,
                                       std::int64_t uncertainty);

/// Whether `triangle`, either way round, with area or without, has a point of the square, sides included.
[[nodiscard]] bool touches(const GridTriangle& triangle, const PixelSquare& square);

/// Whether every point of the square lies in `triangle`, sides included. Without area it holds none.
[[nodiscard]] bool fills(const GridTriangle& triangle, const PixelSquare& square);

}  // namespace halfspace::reference
