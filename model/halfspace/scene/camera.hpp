/// A camera, and the frame it makes of a mesh.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "halfspace/scene/frame.hpp"
#include "halfspace/scene/mesh.hpp"

namespace halfspace {

/// A perspective camera. Where eye or at is not given it is chosen so that the whole mesh is seen. Or a
/// camera that stands in the mesh's file, which says all but the picture's size.
struct Camera {
  /// Name of one of Mesh::cameras, or its number from 0 where none has that name.
  std::optional<std::string> of_mesh;
  std::optional<glm::dvec3> eye;  ///< position; default: from the front right, a little above
  std::optional<glm::dvec3> at;   ///< the point looked at; default: the middle of the mesh's bounding box
  /// Points up in the picture, of any length; default: y, or -z where the camera looks along y.
  std::optional<glm::dvec3> up;
  double fov_degrees = 60;     ///< vertical angle of view, above 0 and below 180
  std::uint32_t width = 1920;  ///< of the target, 1 to kMaxTargetSize pixels
  std::uint32_t height = 1080;
};

/// One target with a 24-bit depth surface 0; a clear of colour and depth (to 1), then one draw for each part
/// of the mesh: depth test LESS with write, no culling, clip volume -w <= z <= w, window y down. Near and far
/// enclose the mesh, or are those of the file's camera; where its aspect ratio is not that of the picture,
/// the picture shows more at two sides. Positions stay double until clip space: a mesh far from the origin
/// gives the picture of the same mesh at the origin. Those that are not finite stay in (their triangles are
/// dropped when drawn) but do not count for the bounding box. Throws OptionError when the field of view or a
/// size is out of range, eye, at or up is not finite, eye and at are the same, up is 0 or along the line of
/// sight, the whole mesh is behind the eye, or the file does not have the camera; InputError when no position
/// of the mesh is finite, the mesh is too far away or too large for floats, or the file's camera makes no
/// picture.
[[nodiscard]] Frame frame_from_mesh(const Mesh& mesh, const Camera& camera, std::string_view name);

}  // namespace halfspace
