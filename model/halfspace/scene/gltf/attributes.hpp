/// Attributes of a glTF primitive's vertices, for pictures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/mat3x3.hpp>
#include <optional>
#include <string>

#include "halfspace/scene/gltf/accessor.hpp"
#include "halfspace/scene/gltf/materials.hpp"
#include "halfspace/scene/gltf/morph.hpp"
#include "halfspace/scene/mesh_attributes.hpp"

namespace halfspace::gltf {

/// What normals are multiplied with where positions are multiplied with `matrix`: its cofactors, which are
/// those of its inverse, transposed, but for a factor, and are there for a flat matrix, too.
[[nodiscard]] glm::dmat3 normal_matrix(const glm::dmat4& matrix);

/// What a reader with attributes collects, and how far it is.
struct AttributeSource {
  AttributeSource(const Document& document, Buffers& buffers, MeshBuilder& mesh)
      : materials(document, buffers, mesh, builder) {}
  AttributeSource(const AttributeSource&) = delete;
  AttributeSource& operator=(const AttributeSource&) = delete;

  AttributeBuilder builder;
  Materials materials;
};

/// The attributes of a primitive, each of which it may have or not.
struct PrimitiveAttributes {
  MaterialUse material;
  std::optional<Accessor> normals;
  std::optional<Accessor> uvs;
  std::optional<Accessor> colors;
  std::optional<Morph> morphed_normals;  ///< what is added to the normals

  /// Stores those of vertex `from`, but the normal, as those of vertex `to` of the mesh.
  void store(std::size_t from, std::uint32_t to, AttributeBuilder& builder) const;
  /// The normal before it is placed; none where it has none.
  [[nodiscard]] std::optional<glm::dvec3> normal(std::size_t vertex) const;
};

}  // namespace halfspace::gltf
