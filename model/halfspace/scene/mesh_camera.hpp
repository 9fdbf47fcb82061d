/// Cameras that stand in a mesh's file.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <string_view>

#include "halfspace/scene/mesh.hpp"

namespace halfspace {

/// World to clip space, -w <= z <= w: first the eye is subtracted, which is exact or nearly so however far
/// both are from the origin, then the rest is applied.
struct View {
  glm::dvec3 eye;
  glm::dmat4 from_eye;
};

/// What the mesh's camera of this name, else of this number, sees on a picture of this width / height: the
/// matrices of glTF 2.0, 3.10.3; where its own aspect ratio is another, more at two sides. Throws OptionError
/// when the mesh does not have the camera, InputError when the camera makes no picture or has all `points`
/// behind it.
[[nodiscard]] View view_of_mesh_camera(const Mesh& mesh, const std::string& wanted, double picture_aspect,
                                       std::span<const glm::dvec3> points, std::string_view name);

}  // namespace halfspace
