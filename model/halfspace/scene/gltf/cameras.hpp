/// Cameras that stand in a glTF scene.
#pragma once

#include <cstddef>
#include <glm/mat4x4.hpp>

#include "halfspace/scene/gltf/document.hpp"
#include "halfspace/scene/mesh.hpp"

namespace halfspace::gltf {

/// The camera of this number, at a node. Its name is the node's, else its own, else "camera N". Its
/// numbers are checked when it is used.
[[nodiscard]] MeshCamera read_camera(const Document& document, std::size_t number, const Object& node,
                                     const glm::dmat4& world);

}  // namespace halfspace::gltf
