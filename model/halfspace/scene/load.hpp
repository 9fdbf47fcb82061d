/// Any input that halfspace takes, as a frame.
#pragma once

#include <filesystem>

#include "halfspace/scene/camera.hpp"
#include "halfspace/scene/frame.hpp"
#include "halfspace/scene/mesh.hpp"

namespace halfspace {

/// The frame in a file, by extension, in small letters or capitals: .ptf is a frame; .obj, .ply, .gltf and
/// .glb are meshes, which are seen through the camera (frames pass over it); each may be packed, with .gz or
/// .xz behind it. "synthetic:NAME" is a frame built in memory (scene/synthetic.hpp). The frame is valid and
/// is named after the file. `content`: of a
/// mesh; its geometry where it is not given. Throws InputError for any other extension, and as
/// read_ptf(), read_mesh(), frame_from_mesh() and synthetic_frame() do.
[[nodiscard]] Frame load(const std::filesystem::path& path, const Camera& camera = {});
[[nodiscard]] Frame load(const std::filesystem::path& path, const Camera& camera, MeshContent content);

}  // namespace halfspace
