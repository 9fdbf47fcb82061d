/// EXT_mesh_gpu_instancing: one node draws its mesh several times.
#pragma once

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <optional>

#include "halfspace/scene/gltf/accessor.hpp"
#include "halfspace/scene/gltf/document.hpp"

namespace halfspace::gltf {

class Instances {
 public:
  /// `instancing`: the extension's object in the node.
  Instances(const Document& document, Buffers& buffers, const Object& instancing);

  [[nodiscard]] std::size_t count() const { return count_; }
  /// How many of them no byte of the file stands for.
  [[nodiscard]] std::size_t bare() const { return bare_; }
  /// From the mesh's space to the node's.
  [[nodiscard]] glm::dmat4 transform(std::size_t instance) const;

 private:
  std::optional<Accessor> translation_;
  std::optional<Accessor> rotation_;
  std::optional<Accessor> scale_;
  std::size_t count_ = 0;
  std::size_t bare_ = 0;
};

}  // namespace halfspace::gltf
