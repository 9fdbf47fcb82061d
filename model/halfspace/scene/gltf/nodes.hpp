/// The node hierarchy of a glTF file.
#pragma once

#include <cstddef>
#include <glm/ext/matrix_double4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <unordered_map>
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

  /// From the node's space to the world, for a node that draws, has a camera, or is a joint.
  [[nodiscard]] const glm::dmat4& world(std::size_t node) const { return world_.at(node); }

  /// The nodes to draw, parents before children: those of the default scene, else of the first, else all.
  /// Says of the mesh which nodes are hidden (KHR_node_visibility).
  [[nodiscard]] std::vector<std::size_t> shown(MeshBuilder& mesh) const;

 private:
  [[nodiscard]] glm::dmat4 local(std::size_t node, const Poses& poses) const;
  [[nodiscard]] std::vector<std::size_t> scene_roots() const;
  [[nodiscard]] std::vector<bool> find_roots();
  [[nodiscard]] std::vector<bool> placed_nodes() const;

  const Document& document_;
  std::vector<std::size_t> roots_;
  std::unordered_map<std::size_t, glm::dmat4>
      world_;  // those of which it is asked: others have no need of 128 bytes
};

}  // namespace halfspace::gltf
