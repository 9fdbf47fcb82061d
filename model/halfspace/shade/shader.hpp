/// A deferred shader for pictures: which triangle is visible at a pixel is known, and what that triangle's
/// attributes are there the unit interpolator says, for quads with their helpers.
#pragma once

#include <cstddef>

#include "halfspace/machine/attribute_planes.hpp"
#include "halfspace/machine/frame_result.hpp"
#include "halfspace/scene/frame.hpp"
#include "halfspace/shade/picture.hpp"

namespace halfspace {

/// The base colour of the material, times the colour of the vertices, times the texture, lit by a lamp where
/// the eye is. A mesh with texture coordinates and no image has a checker texture. Normals are the mesh's, or
/// where a triangle has none its own; triangles have two sides. Needs Surface::visible and Frame::attributes.
[[nodiscard]] Picture shade(const Frame& frame, const FrameResult& result, std::size_t surface,
                            int sub_pixel_bits, Interpolation how);

}  // namespace halfspace
