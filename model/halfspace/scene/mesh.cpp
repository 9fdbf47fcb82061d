#include "halfspace/scene/mesh.hpp"

#include <fmt/format.h>

#include <vector>

#include "halfspace/numerics/error.hpp"
#include "halfspace/scene/byte_source.hpp"
#include "halfspace/scene/mesh_formats.hpp"
#include "halfspace/scene/quote.hpp"

namespace halfspace {

bool is_mesh(const std::filesystem::path& path) {
  const std::filesystem::path extension = path.extension();
  return extension == ".obj" || extension == ".ply" || extension == ".gltf" || extension == ".glb";
}

Mesh read_mesh(const std::filesystem::path& path) {
  const std::string name = display_name(path);
  if (!is_mesh(path)) {
    throw InputError(fmt::format("{}: extension is {}; legal: .obj, .ply, .gltf, .glb", name,
                                 quote(path.extension().string())));
  }
  const std::vector<std::byte> bytes = read_bytes(path);
  if (path.extension() == ".obj") return parse_obj(bytes, name);
  if (path.extension() == ".ply") return parse_ply(bytes, name);
  return parse_gltf(bytes, name, path.parent_path());
}

}  // namespace halfspace
