/// Skins: meshes whose vertices follow several nodes.
#pragma once

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "halfspace/scene/gltf/accessor.hpp"
#include "halfspace/scene/gltf/document.hpp"
#include "halfspace/scene/gltf/nodes.hpp"

namespace halfspace::gltf {

/// The matrices of a skin's joints, from the mesh's space to the world (glTF 2.0, 3.7.3). The transform of
/// the node that has the mesh is not in them, and is not to be applied.
[[nodiscard]] std::vector<glm::dmat4> joint_matrices(const Document& document, Buffers& buffers,
                                                     const Nodes& nodes, const Object& skin);

/// Four joints and weights of each vertex: JOINTS_n and WEIGHTS_n.
struct Influences {
  Accessor joints;
  Accessor weights;
};

/// The vertex in the world; not finite when its weights are all zero. Weights count as parts of their sum,
/// which glTF wants to be one: as on a GPU, where a position is divided by its fourth coordinate. Throws
/// InputError when a joint with a weight is not in the skin.
[[nodiscard]] glm::dvec3 skinned(const Document& document, const std::vector<glm::dmat4>& joints,
                                 const std::vector<Influences>& influences, std::size_t vertex,
                                 glm::dvec3 position);

}  // namespace halfspace::gltf
