#include "halfspace/scene/gltf/attributes.hpp"

#include <glm/geometric.hpp>

namespace halfspace::gltf {

glm::dmat3 normal_matrix(const glm::dmat4& matrix) {
  const glm::dvec3 a(matrix[0]);
  const glm::dvec3 b(matrix[1]);
  const glm::dvec3 c(matrix[2]);
  return {glm::cross(b, c), glm::cross(c, a), glm::cross(a, b)};
}

void PrimitiveAttributes::store(std::size_t from, std::uint32_t to, AttributeBuilder& builder) const {
  if (uvs) builder.set_uv(to, glm::vec2(material.uv_transform * glm::dvec3(uvs->vec2(from), 1)));
  if (colors) {
    builder.set_color(
        to, colors->width() == 4 ? glm::vec4(colors->vec4(from)) : glm::vec4(colors->vec3(from), 1));
  }
}

std::optional<glm::dvec3> PrimitiveAttributes::normal(std::size_t vertex) const {
  if (!normals) return std::nullopt;
  const glm::dvec3 plain = normals->vec3(vertex);
  return morphed_normals ? plain + morphed_normals->displacement(vertex) : plain;
}

}  // namespace halfspace::gltf
