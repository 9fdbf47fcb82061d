/// Triangles whose depth the packet of a triangle cannot hold everywhere. The front end gives them to setup
/// as often as it takes, each time with other pixels and, where it must, with one depth for all vertices;
/// edges stay as they are, so every sample is covered once, or not, as if z were nothing. Depth of such
/// samples is that of the plane, rounded as doubles round.
///
/// Far: a vertex is too far outside the depth range. Depth clamp lets that happen, where a triangle comes
/// close to the eye: z / w has no bound. Samples outside the depth range take its ends, in few pieces; inside
/// it a sample is a piece, of which there are few, as z changes by much from one to the next.
///
/// Tiny: a float32 depth far below the largest vertex, next to where the plane meets 0. A unit of its last
/// place is less than what the interpolator `plane` keeps, whose error is a fixed part of the largest vertex
/// (docs/numerics.md). That is a sample in a row or none, unless a row of centres lies along the line at
/// which depth is 0.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "halfspace/numerics/depth.hpp"
#include "halfspace/units/packets.hpp"

namespace halfspace {

/// What depths are kept within: those of float32 surfaces may leave [0, 1].
struct DepthRange {
  double least;
  double most;
};

/// What is drawn where: the grid of sub-pixels and the pixels of the target.
struct SampleGrid {
  int sub_pixel_bits;
  int square_reach;  ///< as numerics/conservative.hpp has it
  PixelRect screen;
};

/// True where a float32 triangle may have tiny depths within `limits`: one vertex is far less than another.
bool may_be_tiny(const std::array<double, 3>& z, const DepthRange& limits);

/// Appends pieces of the triangle. `z` is that of the vertices, one of them far, with polygon offset. Outer
/// pixels whose centres are outside have the plane's depth there, within that of the vertices.
void emit_far(const ScreenTriangle& triangle, const std::array<double, 3>& z, const DepthRange& limits,
              DepthFormat format, const SampleGrid& grid, std::vector<ScreenTriangle>& out);

/// Appends the triangle of a float32 surface as it is, or in pieces where it has tiny depths; returns whether
/// it has. `z` is that of the vertices as floats, without the offset, which the pieces keep.
bool emit_tiny(const ScreenTriangle& triangle, const std::array<double, 3>& z, const SampleGrid& grid,
               std::vector<ScreenTriangle>& out);

}  // namespace halfspace
