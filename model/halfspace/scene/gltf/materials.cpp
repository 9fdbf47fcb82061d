#include "halfspace/scene/gltf/materials.hpp"

#include <fmt/format.h>

#include <cmath>
#include <span>
#include <vector>

#include "halfspace/numerics/error.hpp"

namespace halfspace::gltf {
namespace {

constexpr const char* kTransform = "KHR_texture_transform";

Wrap wrap_of(const Object& sampler, const char* key) {
  constexpr std::uint64_t kRepeat = 10497;  // glTF 2.0, 5.26.3
  constexpr std::uint64_t kMirroredRepeat = 33648;
  constexpr std::uint64_t kClampToEdge = 33071;
  switch (sampler.number_or(key, kRepeat)) {
    case kMirroredRepeat:
      return Wrap::kMirror;
    case kClampToEdge:
      return Wrap::kClamp;
    default:
      return Wrap::kRepeat;
  }
}

}  // namespace

glm::dmat3 texture_transform(const Object& extension) {
  const auto pair = [&](const char* key, double otherwise) {
    const std::vector<double> values = extension.reals(key, 2);
    return values.empty() ? glm::dvec2(otherwise) : glm::dvec2(values[0], values[1]);
  };
  const glm::dvec2 offset = pair("offset", 0);
  const glm::dvec2 scale = pair("scale", 1);
  const double angle = extension.find_real("rotation").value_or(0);
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {{c * scale.x, -s * scale.x, 0}, {s * scale.y, c * scale.y, 0}, {offset.x, offset.y, 1}};
}

MaterialUse Materials::use(const Object& primitive) {
  try {
    const auto index = document_.find_index(kMaterials, primitive, "material");
    if (!index) return {};
    const auto found = materials_.find(*index);
    if (found != materials_.end()) return found->second;
    return materials_.emplace(*index, read(document_.get(kMaterials, *index))).first->second;
  } catch (const InputError&) {
    mesh_.leave_out("materials that cannot be read");
    return {};
  }
}

MaterialUse Materials::read(const Object& material) {
  MaterialUse use;
  Material out;
  if (const auto metal = material.find_object("pbrMetallicRoughness")) {
    const std::vector<double> factor = metal->reals("baseColorFactor", 4);
    for (std::size_t i = 0; i < factor.size(); ++i) {
      out.base_color[static_cast<int>(i)] = static_cast<float>(factor[i]);
    }
    if (const auto info = metal->find_object("baseColorTexture")) out.texture = read_texture(*info, use);
  }
  use.number = attributes_.add_material(out);
  return use;
}

std::optional<Texture> Materials::read_texture(const Object& info, MaterialUse& use) {
  use.uv_set = info.number_or("texCoord", 0);
  if (const auto transform = info.extension(kTransform)) {
    use.uv_set = transform->number_or("texCoord", use.uv_set);
    use.uv_transform = texture_transform(*transform);
  }
  const Object texture = document_.get(kTextures, info.number("index"));
  const auto source = document_.find_index(kImages, texture, "source");
  if (!source) {
    mesh_.leave_out("textures without a PNG or JPEG image");
    return std::nullopt;
  }
  Texture out;
  if (const auto sampler = document_.find(kSamplers, texture, "sampler")) {
    out.wrap_u = wrap_of(*sampler, "wrapS");
    out.wrap_v = wrap_of(*sampler, "wrapT");
  }
  const auto number = image(*source);
  if (!number) return std::nullopt;
  out.image = *number;
  return out;
}

std::optional<std::uint32_t> Materials::image(std::size_t index) {
  const auto found = images_.find(index);
  if (found != images_.end()) return found->second;
  std::optional<std::uint32_t> number;
  try {
    number = attributes_.add_image(read_image(document_.get(kImages, index)));
  } catch (const InputError& error) {
    mesh_.leave_out(fmt::format("images that cannot be read: {}", error.what()));
  }
  return images_.emplace(index, number).first->second;
}

Image Materials::read_image(const Object& image) {
  if (const std::string* const uri = image.find_text("uri")) {
    return decode_image(buffers_.load(image, *uri), attributes_.texels_left());
  }
  return decode_image(buffers_.view(image.number("bufferView")).bytes, attributes_.texels_left());
}

}  // namespace halfspace::gltf
