/// Materials of a glTF file: base colour and its texture.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <optional>
#include <string>
#include <unordered_map>

#include "halfspace/scene/gltf/buffers.hpp"
#include "halfspace/scene/gltf/document.hpp"
#include "halfspace/scene/mesh_attributes.hpp"
#include "halfspace/scene/mesh_builder.hpp"

namespace halfspace::gltf {

/// What a primitive needs to know of its material.
struct MaterialUse {
  std::uint32_t number = kNoAttribute;  ///< in the attributes
  std::uint64_t uv_set = 0;             ///< TEXCOORD_n of the texture
  glm::dmat3 uv_transform{1};           ///< from these coordinates to those of the image
};

/// Reads each material and image when it is first used. What cannot be read is left out, and said of the
/// mesh.
class Materials {
 public:
  Materials(const Document& document, Buffers& buffers, MeshBuilder& mesh, AttributeBuilder& attributes)
      : document_(document), buffers_(buffers), mesh_(mesh), attributes_(attributes) {}

  [[nodiscard]] MaterialUse use(const Object& primitive);

 private:
  [[nodiscard]] MaterialUse read(const Object& material);
  [[nodiscard]] std::optional<Texture> read_texture(const Object& info, MaterialUse& use);
  [[nodiscard]] std::optional<std::uint32_t> image(std::size_t index);
  [[nodiscard]] Image read_image(const Object& image);

  const Document& document_;
  Buffers& buffers_;
  MeshBuilder& mesh_;
  AttributeBuilder& attributes_;
  std::unordered_map<std::size_t, MaterialUse> materials_;
  std::unordered_map<std::size_t, std::optional<std::uint32_t>> images_;
};

/// From coordinates to those of the image: KHR_texture_transform. A positive rotation turns coordinates
/// counter-clockwise where v goes down, as its text says; the GLSL beside the text turned them the other way
/// (github.com/KhronosGroup/glTF/issues/1563).
[[nodiscard]] glm::dmat3 texture_transform(const Object& extension);

}  // namespace halfspace::gltf
