/// Coverage in rational numbers, from the definitions: the judge of the references, with which it shares no
/// formula. Needs GMP, and is for tests.
#pragma once

#include <gmpxx.h>

#include <array>

#include "halfspace/reference/exact_triangle.hpp"

namespace halfspace::reference {

/// A point in the window, in pixels, y down.
struct RationalPoint {
  mpq_class x;
  mpq_class y;
};

using RationalTriangle = std::array<RationalPoint, 3>;

/// A point of the grid of 1/2^subpixel_bits pixel.
[[nodiscard]] RationalPoint rational_point(const GridPoint& p, int subpixel_bits);

/// Whether `triangle`, either way round, covers `sample`.
///
/// A tie rule says where a sample goes that lies on an edge, so it is a direction in which all samples move,
/// so little that none passes an edge that it does not lie on: first along x, and by the square of that along
/// y. Top-left moves to the right and down. No sample is then on an edge, and the signs of the three
/// determinants of its position with two vertices decide: they are all the same inside. Without area they
/// never are.
[[nodiscard]] bool rational_covers(const RationalTriangle& triangle, const RationalPoint& sample,
                                   TieRule rule);

}  // namespace halfspace::reference
