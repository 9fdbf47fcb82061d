/// What must hold of a glTF file before it is given to a library.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace halfspace {

/// Most nested arrays and objects, and most values, of a glTF file's JSON.
inline constexpr std::uint64_t kMaxJsonDepth = 64;
inline constexpr std::uint64_t kMaxJsonValues = std::uint64_t{1} << 22;

/// Whether the bytes start as a binary glTF file (GLB).
[[nodiscard]] bool is_glb(std::span<const std::byte> bytes);

/// Throws InputError unless the bytes are a GLB container of version 2 with sound chunk sizes, or text; and
/// its JSON is sound, within the limits above, of glTF version 2, and has at most one buffer in the file
/// itself, so that neither the stack nor memory can be exhausted by a small file.
void check_gltf(std::span<const std::byte> bytes, std::string_view name);

}  // namespace halfspace
