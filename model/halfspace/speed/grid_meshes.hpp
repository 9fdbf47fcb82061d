/// The mesh of a rough square of ground in a file of each format, to measure the readers with.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace halfspace {

/// Writes the same mesh of side x side vertices and 2 (side - 1)^2 triangles as OBJ, bare and with normals
/// and texture coordinates, as PLY, ascii and binary of both byte orders, as GLB, and as glTF with its buffer
/// in base64. Returns the meshes' paths. `side` is at least 2. Throws InputError when a file cannot be
/// written.
std::vector<std::filesystem::path> write_grid_meshes(const std::filesystem::path& folder, std::uint32_t side);

}  // namespace halfspace
