/// Triangles with a vertex too far outside [0, 1] for a vertex depth. Depth clamp lets that happen, where a
/// triangle comes close to the eye: z / w has no bound.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "halfspace/numerics/depth.hpp"
#include "halfspace/units/packets.hpp"

namespace halfspace {

/// The depth range of a draw, in [0, 1].
struct DepthRange {
  double least;
  double most;
};

/// True where the packet of a triangle cannot hold it: a vertex depth, or an offset.
bool is_far(double depth);

/// Appends the triangle as often as it takes, each time with other pixels of `screen` and one depth for all
/// of them; its edges stay as they are, so every sample is covered once, or not, as if z were nothing. Where
/// depth is outside `range` that takes a few pieces a row, inside a piece a sample, of which there are few: z
/// changes by much from one to the next. `z` is that of the vertices, with polygon offset; those beyond
/// +-2^27 count as if they were there. Returns the number of pieces.
std::size_t emit_by_sample(const ScreenTriangle& triangle, const std::array<double, 3>& z,
                           const DepthRange& range, DepthFormat format, int sub_pixel_bits,
                           const PixelRect& screen, std::vector<ScreenTriangle>& out);

}  // namespace halfspace
