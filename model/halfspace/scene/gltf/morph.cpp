#include "halfspace/scene/gltf/morph.hpp"

namespace halfspace::gltf {

std::size_t count_targets(const Object& mesh) {
  return mesh.count("primitives") == 0 ? 0 : mesh.item("primitives", 0).count("targets");
}

std::vector<double> morph_weights(const Object& node, const Object& mesh, const Pose& pose) {
  if (pose.weights) return *pose.weights;
  const std::size_t targets = count_targets(mesh);
  if (node.has("weights")) return node.reals("weights", targets);
  if (mesh.has("weights")) return mesh.reals("weights", targets);
  return std::vector<double>(targets);
}

Morph::Morph(const Document& document, Buffers& buffers, const Object& primitive,
             const std::vector<double>& weights, std::size_t vertices, const char* attribute) {
  const std::size_t targets = primitive.count("targets");
  if (targets != weights.size()) {
    primitive.fail("targets has {} objects; legal: {}, as the mesh's first primitive", targets,
                   weights.size());
  }
  for (std::size_t i = 0; i < targets; ++i) {
    const Object target = primitive.item("targets", i);
    if (weights[i] == 0 || !target.has(attribute)) continue;
    Accessor values(document, buffers, target.number(attribute), kPositionUse);
    if (values.count() != vertices) {
      target.fail("{} has {} elements; legal: {}, as the primitive's", attribute, values.count(), vertices);
    }
    targets_.push_back({weights[i], values});
  }
}

glm::dvec3 Morph::displacement(std::size_t vertex) const {
  glm::dvec3 sum(0);
  for (const Target& target : targets_) sum += target.weight * target.values.vec3(vertex);
  return sum;
}

}  // namespace halfspace::gltf
