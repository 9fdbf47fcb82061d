#include "halfspace/scene/mesh_attributes.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "halfspace/scene/mesh.hpp"

namespace halfspace {
namespace {

/// Sets one value; those before it that were never set are none.
template <typename Value>
void set(std::vector<Value>& values, std::uint32_t at, const Value& value) {
  if (at >= values.size()) values.resize(std::size_t{at} + 1, Value(std::numeric_limits<float>::quiet_NaN()));
  values[at] = value;
}

/// One for each of `size` vertices, where there are any.
template <typename Value>
void fill_up(std::vector<Value>& values, std::size_t size) {
  if (!values.empty()) values.resize(size, Value(std::numeric_limits<float>::quiet_NaN()));
}

bool is_plain(const Material& material) { return !material.texture && material.base_color == glm::vec4(1); }

}  // namespace

void AttributeBuilder::set_color(std::uint32_t vertex, glm::vec4 color) { set(all_.colors, vertex, color); }
void AttributeBuilder::set_uv(std::uint32_t vertex, glm::vec2 uv) { set(all_.uvs, vertex, uv); }
void AttributeBuilder::set_normal(std::uint32_t vertex, glm::vec3 normal) {
  set(all_.normals, vertex, normal);
}

void AttributeBuilder::add_corner(std::uint32_t uv, std::uint32_t normal) {
  all_.uv_of.push_back(uv);
  all_.normal_of.push_back(normal);
}

void AttributeBuilder::end_corners(std::size_t corners) {
  all_.uv_of.resize(corners, kNoAttribute);
  all_.normal_of.resize(corners, kNoAttribute);
}

std::uint32_t AttributeBuilder::add_material(const Material& material) {
  all_.materials.push_back(material);
  return static_cast<std::uint32_t>(all_.materials.size() - 1);
}

std::uint32_t AttributeBuilder::add_image(Image image) {
  texels_left_ -= std::min<std::uint64_t>(texels_left_, image.texels.size());
  all_.images.push_back(std::move(image));
  return static_cast<std::uint32_t>(all_.images.size() - 1);
}

void AttributeBuilder::finish(Mesh& mesh) && {
  if (all_.colors.empty() && all_.uvs.empty() && all_.normals.empty() &&
      std::ranges::all_of(all_.materials, is_plain)) {
    return;
  }
  fill_up(all_.colors, mesh.positions.size());
  if (all_.uv_of.empty()) fill_up(all_.uvs, mesh.positions.size());
  if (all_.normal_of.empty()) fill_up(all_.normals, mesh.positions.size());
  all_.vertex_of = mesh.indices;
  all_.material_of.resize(mesh.parts.size(), kNoAttribute);
  mesh.attributes = std::make_shared<const MeshAttributes>(std::move(all_));
}

}  // namespace halfspace
