/// Skins: meshes whose vertices follow several nodes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <unordered_map>
#include <vector>

#include "halfspace/scene/gltf/accessor.hpp"
#include "halfspace/scene/gltf/document.hpp"
#include "halfspace/scene/gltf/nodes.hpp"

namespace halfspace::gltf {

/// Four joints and weights of each vertex: JOINTS_n and WEIGHTS_n.
struct Influences {
  Accessor joints;
  Accessor weights;
};

class Skin {
 public:
  Skin(const Document& document, Buffers& buffers, const Nodes& nodes, std::size_t skin);

  /// The vertex in the world (glTF 2.0, 3.7.3): the transform of the node that has the mesh is not applied.
  /// It is not finite when its weights are all zero. Weights count as parts of their sum, which glTF wants to
  /// be one: as on a GPU, where a position is divided by its fourth coordinate. Throws InputError when a
  /// joint with a weight is not in the skin.
  [[nodiscard]] glm::dvec3 place(const std::vector<Influences>& influences, std::size_t vertex,
                                 glm::dvec3 position);

  /// The matrix of the vertex: the joints', by their weights.
  [[nodiscard]] glm::dmat4 blended(const std::vector<Influences>& influences, std::size_t vertex);

 private:
  /// From the mesh's space to the world; made when it is first used, since a file can list joints by the
  /// million.
  [[nodiscard]] const glm::dmat4& matrix(std::uint32_t joint);

  const Document& document_;
  const Nodes& nodes_;
  std::vector<std::size_t> joints_;  // nodes
  std::optional<Accessor> inverse_bind_;
  std::unordered_map<std::uint32_t, glm::dmat4> matrices_;
};

}  // namespace halfspace::gltf
