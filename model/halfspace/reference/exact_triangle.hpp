/// Exact coverage of a triangle at pixel centres, by definition: no increments, no rounding, no rejection
/// tests.
#pragma once

#include <array>
#include <cstdint>

#include "halfspace/reference/tie_rule.hpp"

namespace halfspace::reference {

/// 128 bits, so that no range has to be argued about: coordinates of up to 62 bits are exact.
__extension__ typedef __int128 Int128;

/// A point in window coordinates, y down, in units of 1/2^s pixel; s (4 to 8) is given beside it.
struct GridPoint {
  std::int64_t x = 0;
  std::int64_t y = 0;
};

using GridTriangle = std::array<GridPoint, 3>;

/// Twice the signed area, (bx-ax)(cy-ay) - (cx-ax)(by-ay): positive when a, b, c run clockwise on the screen.
[[nodiscard]] Int128 twice_area(const GridPoint& a, const GridPoint& b, const GridPoint& c);

/// The same three vertices in an order of positive area. The area must not be zero.
[[nodiscard]] GridTriangle clockwise(const GridTriangle& triangle);

/// The centre of pixel (x, y) on the grid of 1/2^subpixel_bits pixel.
[[nodiscard]] GridPoint pixel_centre(std::int64_t x, std::int64_t y, int subpixel_bits);

/// The place in pixel (x, y) that is `right` and `down` sixteenths of a pixel from its top left corner, on
/// the same grid; subpixel_bits of 4 or more.
[[nodiscard]] GridPoint place_in_pixel(std::int64_t x, std::int64_t y, int right, int down,
                                       int subpixel_bits);

/// Whether `triangle` covers `sample`. Either winding; a triangle without area covers nothing.
[[nodiscard]] bool covers(const GridTriangle& triangle, const GridPoint& sample, TieRule rule);

}  // namespace halfspace::reference
