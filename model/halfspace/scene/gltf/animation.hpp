/// Where animations put the nodes of a glTF file at their start.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <unordered_map>
#include <vector>

#include "halfspace/scene/gltf/buffers.hpp"
#include "halfspace/scene/gltf/document.hpp"
#include "halfspace/scene/mesh_builder.hpp"

namespace halfspace::gltf {

/// What stands in place of a node's own properties.
struct Pose {
  std::optional<glm::dvec3> translation;
  std::optional<glm::dvec4> rotation;
  std::optional<glm::dvec3> scale;
  std::optional<std::vector<double>> weights;

  [[nodiscard]] bool moves() const { return translation || rotation || scale; }
};

using Poses = std::unordered_map<std::size_t, Pose>;  // by node

/// The poses at t = 0. As many animations as do not contradict each other play at once, the first ones first,
/// as in Khronos's viewer; the others are left out, and said of the mesh.
[[nodiscard]] Poses poses_at_start(const Document& document, Buffers& buffers, MeshBuilder& mesh);

}  // namespace halfspace::gltf
