/// Buffer views packed by EXT_meshopt_compression.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "halfspace/scene/gltf/object.hpp"

namespace halfspace::gltf {

/// The view's bytes; `packed` is the extension's object in the view, `bytes` what it names. Throws InputError
/// when they contradict the extension's rules. Unpacked bytes are at most 64 times the packed ones.
[[nodiscard]] std::vector<std::byte> unpack_meshopt(const Object& packed, std::span<const std::byte> bytes);

}  // namespace halfspace::gltf
