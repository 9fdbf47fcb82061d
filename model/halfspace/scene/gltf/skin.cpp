#include "halfspace/scene/gltf/skin.hpp"

namespace halfspace::gltf {

Skin::Skin(const Document& document, Buffers& buffers, const Nodes& nodes, std::size_t skin)
    : document_(document), nodes_(nodes) {
  const Object object = document.get(kSkins, skin);
  joints_ = document.indices(kNodes, object, "joints");
  if (!object.has("inverseBindMatrices")) return;
  inverse_bind_.emplace(document, buffers, object.number("inverseBindMatrices"), kInverseBindUse);
  if (inverse_bind_->count() < joints_.size()) {
    object.fail("inverseBindMatrices has {} elements; legal: {} or more, one for each joint",
                inverse_bind_->count(), joints_.size());
  }
}

const glm::dmat4& Skin::matrix(std::uint32_t joint) {
  const auto found = matrices_.find(joint);
  if (found != matrices_.end()) return found->second;
  const glm::dmat4 world = nodes_.world(joints_[joint]);
  return matrices_.emplace(joint, inverse_bind_ ? world * inverse_bind_->mat4(joint) : world).first->second;
}

glm::dvec3 Skin::place(const std::vector<Influences>& influences, std::size_t vertex, glm::dvec3 position) {
  glm::dvec4 sum(0);
  double total = 0;
  for (const Influences& four : influences) {
    const glm::dvec4 weights = four.weights.vec4(vertex);
    for (unsigned i = 0; i < 4; ++i) {
      const double weight = weights[static_cast<int>(i)];
      if (weight == 0) continue;
      const std::uint32_t joint = four.joints.whole(vertex, i);
      if (joint >= joints_.size()) {
        document_.fail("accessor {}: joint {} of vertex {} is {}; legal: below {}, the joints of the skin",
                       four.joints.index(), i, vertex, joint, joints_.size());
      }
      sum += weight * (matrix(joint) * glm::dvec4(position, 1));
      total += weight;
    }
  }
  return glm::dvec3(sum) / total;
}

glm::dmat4 Skin::blended(const std::vector<Influences>& influences, std::size_t vertex) {
  glm::dmat4 sum(0);
  for (const Influences& four : influences) {
    const glm::dvec4 weights = four.weights.vec4(vertex);
    for (unsigned i = 0; i < 4; ++i) {
      const double weight = weights[static_cast<int>(i)];
      if (weight != 0) sum += weight * matrix(four.joints.whole(vertex, i));
    }
  }
  return sum;
}

}  // namespace halfspace::gltf
