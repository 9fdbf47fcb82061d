/// What is exchangeable in the rasterizer of a triangle that was clipped, projected and snapped: which
/// samples it covers.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "halfspace/reference/exact_triangle.hpp"
#include "halfspace/reference/pixel_rect.hpp"
#include "halfspace/reference/triangle_method.hpp"
#include "halfspace/reference/window.hpp"

namespace halfspace::reference {

/// A triangle in window coordinates.
struct Piece {
  GridTriangle grid;  ///< on the grid of 1/2^subpixel_bits pixel, either way round; with area but for touched
                      ///< pixels
  int subpixel_bits = 8;
  TieRule rule = TieRule::kTopLeft;
  Pixels pixels = Pixels::kCentres;
  int uncertainty = 0;  ///< of squares, in sub-pixels
  PixelRect bounds;     ///< the pixels that may be drawn and that its box touches, or that lie next to one of
                        ///< these; not below 0
  DepthPlane plane;     ///< through the vertices before snapping
  std::array<double, 3> depth = {};  ///< of the vertices
  std::array<Color, 3> color = {};   ///< of the vertices

  /// The centre of a pixel on the grid.
  [[nodiscard]] GridPoint centre(std::int64_t x, std::int64_t y) const {
    return pixel_centre(x, y, subpixel_bits);
  }
  /// The fragment of a covered pixel, with the depth of the plane.
  [[nodiscard]] Fragment fragment(std::int64_t x, std::int64_t y) const {
    return {x, y, plane.at(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5), {}};
  }
};

/// Appends a fragment for each pixel of `piece.bounds` that the triangle covers, in any order.
using CoverageMethod = void (*)(const Piece& piece, std::vector<Fragment>& fragments);

}  // namespace halfspace::reference
