/// What if meshes had no more detail than the screen shows?
#pragma once

#include "halfspace/whatif/draw_ranges.hpp"

namespace halfspace::whatif {

/// Simplifies each draw that may move (draw_ranges.hpp) by meshoptimizer, which collapses edges to one of
/// their ends by the quadric error (M. Garland, P. Heckbert, "Surface Simplification Using Quadric Error
/// Metrics", SIGGRAPH 97). Vertices in the same place are one, and each part of the draw that hangs together
/// is taken by itself. Draws with a vertex that is not finite or not in front of the eye (w not positive) are
/// left alone.
///
/// The space is the window's: x and y in pixels; and depth, scaled so that the draw is as deep as it is wide
/// or high, whichever is larger. Projection maps triangles to triangles there. Every point of the old surface
/// is within `pixels` of the new one, and the other way round. That is checked, not assumed
/// (surface_distance.hpp), for a quadric error is a mean: a bisection finds the largest error to ask the
/// simplifier for with which the check holds. A part for which none does stays as it is.
///
/// Vertices keep their positions; only indices change. Nothing else of a vertex counts, for a frame has
/// nothing else. Where two parts meet they may come apart by up to twice `pixels`. `pixels` is above 0.
Acted simplify(Frame& frame, double pixels);

}  // namespace halfspace::whatif
