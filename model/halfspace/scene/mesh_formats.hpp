/// The readers behind read_mesh(), on bytes in memory. `name` stands in front of errors; each throws
/// InputError.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "halfspace/scene/mesh.hpp"

namespace halfspace {

[[nodiscard]] Mesh parse_obj(std::span<const std::byte> bytes, std::string_view name);
[[nodiscard]] Mesh parse_ply(std::span<const std::byte> bytes, std::string_view name);

/// Text or binary, by content. Buffers named in the file are read from `folder`.
[[nodiscard]] Mesh parse_gltf(std::span<const std::byte> bytes, std::string_view name,
                              const std::filesystem::path& folder);

/// Throws unless a mesh of that size is legal.
void check_mesh_size(std::string_view name, std::uint64_t vertices, std::uint64_t triangles);

/// Ends the last part: all indices after those of the other parts, if there are any.
void close_part(Mesh& mesh, std::string part_name);

/// The mesh, once it has been checked to have triangles.
[[nodiscard]] Mesh finish_mesh(Mesh mesh, std::string_view name);

}  // namespace halfspace
