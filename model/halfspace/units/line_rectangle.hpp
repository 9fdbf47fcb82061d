/// The corners of a rectangular line on the sub-pixel grid: Vulkan 1.3, "Basic Line Segment Rasterization".
/// Two sides are parallel to the line, each half of its width away; the others pass through its ends.
#pragma once

#include <array>
#include <cstdint>

#include "halfspace/units/thin_line.hpp"

namespace halfspace {

/// The integer nearest to value / sqrt(square), halves away from 0. |value| is below 2^62, square above 0 and
/// below 2^54, and the result below 2^31.
std::int64_t divide_by_root(std::int64_t value, std::int64_t square);

/// From the line from `a` to `b`, which must differ, to a long side: `width` sub-pixels / 2 at a right angle,
/// each coordinate rounded to the grid. The other long side is as far on the other side, so the four corners
/// are a parallelogram, and lines that share an end and a direction share their corners there.
LinePoint rectangle_offset(const LinePoint& a, const LinePoint& b, std::int64_t width);

/// The point `distance` sub-pixels from `a` towards `b`, rounded to the grid; `b` where that lies behind it.
LinePoint along_line(const LinePoint& a, const LinePoint& b, std::int64_t distance);

/// The length of the line in pixels, rounded up.
std::int64_t pixels_long(const LinePoint& a, const LinePoint& b, int sub_pixel_bits);

}  // namespace halfspace
