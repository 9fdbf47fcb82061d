/// The node hierarchy of a glTF file.
#pragma once

#include <cstddef>
#include <glm/ext/matrix_double4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "halfspace/scene/gltf/animation.hpp"
#include "halfspace/scene/gltf/document.hpp"
#include "halfspace/scene/mesh_builder.hpp"

namespace halfspace::gltf {

/// Scale, then rotation by a quaternion (x, y, z, w), then translation.
[[nodiscard]] glm::dmat4 compose(glm::dvec3 translation, glm::dvec4 rotation, glm::dvec3 scale);

class Nodes {
 public:
  /// Throws InputError unless the nodes are trees and their transforms sound.
  Nodes(const Document& document, const Poses& poses);

  /// From the node's space to the world.
  [[nodiscard]] const glm::dmat4& world(std::size_t node) const { return world_[node]; }

  /// The nodes to draw, parents before children: those of the default scene, else of the first, else all.
  /// Says of the mesh which nodes are hidden (KHR_node_visibility).
  [[nodiscard]] std::vector<std::size_t> shown(MeshBuilder& mesh) const;

 private:
  [[nodiscard]] glm::dmat4 local(std::size_t node, const Poses& poses) const;
  [[nodiscard]] std::vector<std::size_t> scene_roots() const;

  const Document& document_;
  std::vector<std::size_t> roots_;
  std::vector<glm::dmat4> world_;
};

}  // namespace halfspace::gltf
