#include "halfspace/scene/mesh.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "halfspace/numerics/error.hpp"
#include "halfspace/scene/byte_source.hpp"
#include "halfspace/scene/input_name.hpp"
#include "halfspace/scene/mesh_formats.hpp"
#include "halfspace/scene/quote.hpp"

namespace halfspace {

void check_mesh_size(std::string_view name, std::uint64_t vertices, std::uint64_t triangles) {
  if (vertices > kMaxMeshVertices) {
    throw InputError(
        fmt::format("{}: mesh has {} vertices or more; legal: at most {}", name, vertices, kMaxMeshVertices));
  }
  if (triangles > kMaxMeshTriangles) {
    throw InputError(fmt::format("{}: mesh has {} triangles or more; legal: at most {}", name, triangles,
                                 kMaxMeshTriangles));
  }
}

void close_part(Mesh& mesh, std::string part_name) {
  const auto end = static_cast<std::uint32_t>(mesh.indices.size());
  const std::uint32_t begin =
      mesh.parts.empty() ? 0 : mesh.parts.back().first_index + mesh.parts.back().index_count;
  if (begin != end) mesh.parts.push_back({std::move(part_name), begin, end - begin});
}

Mesh finish_mesh(Mesh mesh, std::string_view name) {
  if (mesh.indices.empty()) {
    throw InputError(fmt::format("{}: mesh has {} vertices and 0 triangles; legal: 1 triangle or more", name,
                                 mesh.positions.size()));
  }
  return mesh;
}

Mesh read_mesh(const std::filesystem::path& path) {
  const std::string name = display_name(path);
  const InputName input = input_name(path);
  if (!input.is_mesh()) {
    throw InputError(fmt::format("{}: extension is {}; legal: {}, {}", name, quote(input.extension),
                                 kMeshExtensions, kPackedExtensions));
  }
  const std::vector<std::byte> bytes = read_bytes(path);
  if (input.kind == InputKind::kObj) return parse_obj(bytes, name);
  if (input.kind == InputKind::kPly) return parse_ply(bytes, name);
  return parse_gltf(bytes, name, path.parent_path());
}

}  // namespace halfspace
