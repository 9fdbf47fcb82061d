#include "halfspace/scene/obj_attributes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <system_error>
#include <utility>

#include "halfspace/numerics/error.hpp"
#include "halfspace/scene/byte_source.hpp"
#include "halfspace/scene/srgb.hpp"

namespace halfspace {
namespace {

/// The number of `count` that the text stands for: from 1, or from -1 down.
std::uint32_t index_of(std::string_view text, std::size_t count, MeshBuilder& mesh) {
  if (text.empty()) return kNoAttribute;
  std::int64_t number = 0;
  const char* const first = text.data() + (text.front() == '+' ? 1 : 0);
  const auto [stop, error] = std::from_chars(first, text.data() + text.size(), number);
  const auto all = static_cast<std::int64_t>(count);
  const std::int64_t at = number > 0 ? number - 1 : all + number;
  if (error != std::errc() || stop != text.data() + text.size() || number == 0 || at < 0 || at >= all) {
    mesh.leave_out("corners whose texture coordinates or normal are not there");
    return kNoAttribute;
  }
  return static_cast<std::uint32_t>(at);
}

glm::vec3 light_of(double r, double g, double b) {
  const auto light = [](double stored) {
    return srgb_to_linear(static_cast<float>(std::clamp(stored, 0.0, 1.0)));
  };
  return {light(r), light(g), light(b)};
}

}  // namespace

void ObjAttributes::add_color(std::uint32_t vertex, const std::vector<double>& numbers) {
  const std::size_t n = numbers.size();
  if (n != 3 && n != 4) return;
  builder_.set_color(vertex, {light_of(numbers[n - 3], numbers[n - 2], numbers[n - 1]), 1});
}

void ObjAttributes::add_uv(const std::vector<double>& numbers) {
  const double v = numbers.size() > 1 ? numbers[1] : 0;
  builder_.add_uv({numbers.empty() ? 0 : numbers[0], 1 - v});
}

void ObjAttributes::add_normal(const std::vector<double>& numbers) {
  builder_.add_normal(numbers.size() < 3 ? glm::vec3(0) : glm::vec3(numbers[0], numbers[1], numbers[2]));
}

void ObjAttributes::add_corner(std::string_view corner) {
  const std::size_t slash = std::min(corner.find('/'), corner.size());
  const std::string_view behind = corner.substr(std::min(slash + 1, corner.size()));
  const std::size_t second = std::min(behind.find('/'), behind.size());
  corners_.push_back(
      {index_of(behind.substr(0, second), builder_.uv_count(), mesh_),
       index_of(behind.substr(std::min(second + 1, behind.size())), builder_.normal_count(), mesh_)});
}

void ObjAttributes::end_face(const std::vector<std::uint32_t>& order) {
  for (const std::uint32_t at : order) builder_.add_corner(corners_[at].uv, corners_[at].normal);
  corners_.clear();
}

void ObjAttributes::add_libraries(const std::string& names) {
  if (add_library(names)) return;
  std::size_t begin = 0;
  while (begin < names.size()) {
    const std::size_t end = std::min(names.find(' ', begin), names.size());
    if (!add_library(names.substr(begin, end - begin)))
      mesh_.leave_out("material libraries that are missing");
    begin = end + 1;
  }
}

bool ObjAttributes::add_library(const std::string& name) {
  const auto path = file_below(folder_, name);
  if (!path) return false;
  try {
    const std::vector<std::byte> bytes = read_raw_bytes(*path, kMaxInputBytes);
    parse_mtl({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, library_);
  } catch (const InputError&) {
    mesh_.leave_out("material libraries that cannot be read");
  }
  return true;
}

void ObjAttributes::end_part(const std::string& material) {
  builder_.end_parts(mesh_.part_count(), number_of(material));
  builder_.end_corners(mesh_.index_count());
}

std::uint32_t ObjAttributes::number_of(const std::string& material) {
  const auto known = materials_.find(material);
  if (known != materials_.end()) return known->second;
  const auto found = library_.find(material);
  if (found == library_.end()) {
    if (!material.empty()) mesh_.leave_out("materials that no library has");
    return kNoAttribute;
  }
  const MtlMaterial& from = found->second;
  Material out{.base_color = {light_of(from.diffuse.r, from.diffuse.g, from.diffuse.b), 1}, .texture = {}};
  if (!from.image.empty()) {
    const Wrap wrap = from.clamp ? Wrap::kClamp : Wrap::kRepeat;
    if (const auto number = image(from.image)) {
      out.texture = Texture{.image = *number, .wrap_u = wrap, .wrap_v = wrap};
    }
    if (from.has_options) mesh_.leave_out("options of images of materials");
  }
  return materials_[material] = builder_.add_material(out);
}

std::optional<std::uint32_t> ObjAttributes::image(const std::string& name) {
  const auto known = images_.find(name);
  if (known != images_.end()) return known->second;
  std::optional<std::uint32_t> number;
  try {
    const auto path = file_below(folder_, name);
    if (!path) throw InputError("file is missing; legal: in the mesh's folder or below");
    number = builder_.add_image(decode_image(read_raw_bytes(*path, kMaxInputBytes), builder_.texels_left()));
  } catch (const InputError& error) {
    mesh_.leave_out(fmt::format("images that cannot be read: {}", error.what()));
  }
  return images_[name] = number;
}

void ObjAttributes::finish(Mesh& mesh) && { std::move(builder_).finish(mesh); }

}  // namespace halfspace
