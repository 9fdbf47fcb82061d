/// Depth at a sample from the depth equation of its triangle: the two ways that hardware offers, plane
/// (depth_plane.hpp) and barycentric (depth_barycentric.hpp). To the interpolated depth both add the
/// triangle's polygon offset, round the sum to a code, and clamp that to the range of the three vertices and
/// of the draw. Nothing of this changes what is covered. Cost, error and the proof of the bounds:
/// docs/numerics.md.
#pragma once

#include <array>
#include <cstdint>

#include "halfspace/numerics/depth.hpp"
#include "halfspace/units/packets.hpp"

namespace halfspace {

enum class DepthInterpolator : std::uint8_t { kPlane, kBarycentric };

/// Stored codes between which every fragment of a draw is kept: those of the depth range with depth clamp;
/// without, those of 0 and 1, or of all floats where the depth range is unrestricted.
struct DepthLimits {
  std::uint32_t least = 0;
  std::uint32_t most = largest_code(DepthFormat::kFloat32);  ///< on unorm no more than the code of 1
};

/// Fills `out`, all but `bias`, which must be set where the interpolator uses it. `v` in positive order, with
/// vertex i opposite to edge[i]; area2 > 0 is twice the area in squared sub-pixel units.
void make_depth_equation(const std::array<ScreenVertex, 3>& v, std::int64_t offset,
                         const std::array<Edge, 3>& edge, std::int64_t area2, DepthFormat format,
                         const DepthLimits& limits, DepthInterpolator interpolator, DepthEquation& out);

}  // namespace halfspace
