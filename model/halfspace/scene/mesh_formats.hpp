/// The readers behind read_mesh(), on bytes in memory. `name` stands in front of errors; each throws
/// InputError.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

#include "halfspace/scene/mesh.hpp"

namespace halfspace {

[[nodiscard]] Mesh parse_obj(std::span<const std::byte> bytes, std::string_view name);
/// Material libraries and images are read from `folder`.
[[nodiscard]] Mesh parse_obj(std::span<const std::byte> bytes, std::string_view name,
                             const std::filesystem::path& folder, MeshContent content);
[[nodiscard]] Mesh parse_ply(std::span<const std::byte> bytes, std::string_view name);
[[nodiscard]] Mesh parse_ply(std::span<const std::byte> bytes, std::string_view name, MeshContent content);

/// Text or binary, by content. Buffers named in the file are read from `folder`.
[[nodiscard]] Mesh parse_gltf(std::span<const std::byte> bytes, std::string_view name,
                              const std::filesystem::path& folder);
[[nodiscard]] Mesh parse_gltf(std::span<const std::byte> bytes, std::string_view name,
                              const std::filesystem::path& folder, MeshContent content);

}  // namespace halfspace
