/// line_setup: from a thin line on the sub-pixel grid to two edges, bounds and a depth equation, or to the
/// reason it is dropped. What it makes is a packet as setup makes it, so walkers, edge_evaluator and early_z
/// draw it as they draw a triangle.
#pragma once

#include "halfspace/units/packets.hpp"
#include "halfspace/units/setup.hpp"
#include "halfspace/units/thin_line.hpp"

namespace halfspace {

/// The ends of a thin line.
inline LinePoint line_start(const ScreenTriangle& line) { return {line.v[0].x, line.v[0].y}; }
inline LinePoint line_end(const ScreenTriangle& line) { return {line.v[1].x, line.v[1].y}; }

/// A triangle whose depth is that of the line, at the same column (row, where the line is y-major): the line,
/// and a third vertex beside the start, as deep as it. The ends must differ along the major axis.
std::array<ScreenVertex, 3> line_depth_triangle(const ScreenTriangle& line, bool x_major, int sub_pixel_bits);

/// Fills `out` when the verdict is kDrawn; a line is never culled. Edge 2 has every sample inside, and depth
/// is only made with the interpolator `plane`: edges of a thin line are no weights.
SetupVerdict line_setup(const ScreenTriangle& in, const SetupState& state, SetupTriangle& out);

}  // namespace halfspace
