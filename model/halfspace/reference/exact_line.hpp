/// Whether a line produces the fragment of a pixel, from the words of the specifications: the judge of
/// units/thin_line.hpp, with which it shares no formula. It looks at one pixel, and knows nothing of columns.
#pragma once

#include <cstdint>
#include <vector>

namespace halfspace::reference {

/// Coordinates of a line's ends in 1/2^subpixel_bits pixel, y down; at most 2^18 in magnitude.
struct GridLine {
  std::int64_t ax = 0;
  std::int64_t ay = 0;
  std::int64_t bx = 0;
  std::int64_t by = 0;
};

struct PixelPlace {
  std::int64_t x = 0;
  std::int64_t y = 0;
  friend auto operator<=>(const PixelPlace&, const PixelPlace&) = default;
};

/// Vulkan 1.3, "Bresenham Line Segment Rasterization", in its words: both ends are moved by (-e, -e^2); the
/// fragment is produced if the moved segment meets the open diamond |x - xf| + |y - yf| < 1/2, and its end is
/// not in it. e is so small that any smaller one gives the same.
[[nodiscard]] bool leaves_vulkan_diamond(const GridLine& line, const PixelPlace& pixel, int subpixel_bits);

/// Direct3D 11, "Line Rasterization Rules (Aliased, Without Multisampling)": the line leaves the diamond of
/// the pixel. The diamond has its lower left and lower right edge and its bottom corner, and for lines that
/// are not x-major (slope -1 to 1) its right corner.
[[nodiscard]] bool leaves_direct3d_diamond(const GridLine& line, const PixelPlace& pixel, int subpixel_bits);

/// Bresenham's algorithm as textbooks have it, with a decision variable, octant by octant: from the pixel of
/// `a` to that of `b`, which is left out. In order.
[[nodiscard]] std::vector<PixelPlace> midpoint_line(const PixelPlace& a, const PixelPlace& b);

/// The digital differential analyser of the textbooks, in steps of a column (row), with a slope rounded to
/// `fraction_bits`; halves are rounded up. From the pixel of `a` to that of `b`, which is left out. In order.
[[nodiscard]] std::vector<PixelPlace> dda_line(const PixelPlace& a, const PixelPlace& b, int fraction_bits);

}  // namespace halfspace::reference
