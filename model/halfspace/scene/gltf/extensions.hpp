/// Which extensions of glTF may be in a file.
#pragma once

#include "halfspace/scene/gltf/document.hpp"
#include "halfspace/scene/mesh_builder.hpp"

namespace halfspace::gltf {

/// Throws InputError when the file requires an extension that is not read and may touch geometry; says of the
/// mesh when it uses one.
void check_extensions(const Document& document, MeshBuilder& mesh);

}  // namespace halfspace::gltf
