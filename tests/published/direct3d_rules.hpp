/// Figures of Microsoft's documentation of Direct3D, as data.
#pragma once

#include <array>

namespace halfspace::published {

/// "Introduction to rasterization rules",
/// https://learn.microsoft.com/en-us/windows/uwp/graphics-concepts/introduction-to-rasterization-rules, and
/// "Rasterization Rules (Direct3D 9)": pixels of triangles by the top-left rule. There the centres of pixels
/// are at whole coordinates. The first two share an edge; each pixel of the rectangle belongs to one of them.
struct CountedTriangle {
  std::array<std::array<double, 2>, 3> corner;
  int pixels;
};
inline constexpr std::array<CountedTriangle, 2> kDirect3DTriangles{
    {{{{{0, 0}, {5, 0}, {5, 5}}}, 15}, {{{{0, 5}, {0, 0}, {5, 5}}}, 10}}};

/// Ibidem: rectangles of two triangles from the first corner to the second, and the first and last pixel that
/// each fills. "For either rectangle, the same pixels are affected."
struct CountedRectangle {
  std::array<double, 2> from;
  std::array<double, 2> to;
  std::array<int, 2> first;
  std::array<int, 2> last;
};
inline constexpr std::array<CountedRectangle, 3> kDirect3DRectangles{
    {{{0, 0}, {5, 5}, {0, 0}, {4, 4}},
     {{0.5, 0.5}, {2.5, 4.5}, {1, 1}, {2, 4}},
     {{1, 1}, {3, 5}, {1, 1}, {2, 4}}}};

}  // namespace halfspace::published
