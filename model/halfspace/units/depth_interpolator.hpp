/// Depth at a sample from the depth equation of its triangle: the two ways that hardware offers, plane
/// (depth_plane.hpp) and barycentric (depth_barycentric.hpp). Both keep the result between the depths of the
/// three vertices. Cost, error and the proof of the bounds: docs/numerics.md.
#pragma once

#include <array>
#include <cstdint>

#include "halfspace/numerics/depth.hpp"
#include "halfspace/units/packets.hpp"

namespace halfspace {

enum class DepthInterpolator : std::uint8_t { kPlane, kBarycentric };

/// Fills the fields of `out` that the interpolator and the format use. `v` in positive order, vertex i
/// opposite to edge[i]; out.bias must be set; area2 > 0 is twice the area in squared sub-pixel units.
void make_depth_equation(const std::array<ScreenVertex, 3>& v, const std::array<Edge, 3>& edge,
                         std::int64_t area2, DepthFormat format, DepthInterpolator interpolator,
                         DepthEquation& out);

}  // namespace halfspace
