/// Morph targets of a glTF mesh.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "halfspace/scene/gltf/accessor.hpp"
#include "halfspace/scene/gltf/animation.hpp"
#include "halfspace/scene/gltf/document.hpp"

namespace halfspace::gltf {

/// How many targets each of the mesh's primitives has.
[[nodiscard]] std::size_t count_targets(const Object& mesh);

/// The weights of the node's mesh: of the pose, else the node's, else the mesh's, else zeros.
[[nodiscard]] std::vector<double> morph_weights(const Object& node, const Object& mesh, const Pose& pose);

/// What is added to a primitive's positions, or another attribute of three numbers.
class Morph {
 public:
  /// `weights`: one for each target. `attribute`: which. Throws InputError where the primitive has another
  /// number of targets, or one with another number of vertices.
  Morph(const Document& document, Buffers& buffers, const Object& primitive,
        const std::vector<double>& weights, std::size_t vertices, const char* attribute = "POSITION");

  [[nodiscard]] glm::dvec3 displacement(std::size_t vertex) const;

 private:
  struct Target {
    double weight;
    Accessor values;
  };
  std::vector<Target> targets_;  // those with an effect
};

}  // namespace halfspace::gltf
