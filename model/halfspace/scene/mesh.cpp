#include "halfspace/scene/mesh.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "halfspace/numerics/error.hpp"
#include "halfspace/scene/byte_source.hpp"
#include "halfspace/scene/input_name.hpp"
#include "halfspace/scene/mesh_formats.hpp"
#include "halfspace/scene/quote.hpp"

namespace halfspace {

bool is_finite(glm::dvec3 position) {
  return std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(position.z);
}

Mesh read_mesh(const std::filesystem::path& path, MeshContent content) {
  const std::string name = display_name(path);
  const InputName input = input_name(path);
  if (!input.is_mesh()) {
    throw InputError(fmt::format("{}: extension is {}; legal: {}, {}", name, quote(input.extension),
                                 kMeshExtensions, kPackedExtensions));
  }
  const std::vector<std::byte> bytes = read_bytes(path);
  if (input.kind == InputKind::kObj) return parse_obj(bytes, name, path.parent_path(), content);
  if (input.kind == InputKind::kPly) return parse_ply(bytes, name, content);
  return parse_gltf(bytes, name, path.parent_path(), content);
}

}  // namespace halfspace
