#include "halfspace/scene/gltf/skin.hpp"

#include <optional>

namespace halfspace::gltf {

std::vector<glm::dmat4> joint_matrices(const Document& document, Buffers& buffers, const Nodes& nodes,
                                       const Object& skin) {
  const std::vector<std::size_t> joints = document.indices(kNodes, skin, "joints");
  std::optional<Accessor> inverse_bind;
  if (skin.has("inverseBindMatrices")) {
    inverse_bind.emplace(document, buffers, skin.number("inverseBindMatrices"), kInverseBindUse);
    if (inverse_bind->count() < joints.size()) {
      skin.fail("inverseBindMatrices has {} elements; legal: {} or more, one for each joint",
                inverse_bind->count(), joints.size());
    }
  }
  std::vector<glm::dmat4> matrices;
  matrices.reserve(joints.size());
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const glm::dmat4& world = nodes.world(joints[i]);
    matrices.push_back(inverse_bind ? world * inverse_bind->mat4(i) : world);
  }
  return matrices;
}

glm::dvec3 skinned(const Document& document, const std::vector<glm::dmat4>& joints,
                   const std::vector<Influences>& influences, std::size_t vertex, glm::dvec3 position) {
  glm::dvec4 sum(0);
  double total = 0;
  for (const Influences& four : influences) {
    const glm::dvec4 weights = four.weights.vec4(vertex);
    for (unsigned i = 0; i < 4; ++i) {
      const double weight = weights[static_cast<int>(i)];
      if (weight == 0) continue;
      const std::uint32_t joint = four.joints.whole(vertex, i);
      if (joint >= joints.size()) {
        document.fail("accessor {}: joint {} of vertex {} is {}; legal: below {}, the joints of the skin",
                      four.joints.index(), i, vertex, joint, joints.size());
      }
      sum += weight * (joints[joint] * glm::dvec4(position, 1));
      total += weight;
    }
  }
  return glm::dvec3(sum) / total;
}

}  // namespace halfspace::gltf
