/// Any input that halfspace takes, as a frame.
#pragma once

#include <filesystem>

#include "halfspace/scene/camera.hpp"
#include "halfspace/scene/frame.hpp"

namespace halfspace {

/// The frame in a file, by extension: .ptf, .ptf.gz and .ptf.xz are frames; .obj, .ply, .gltf and .glb are
/// meshes, which are seen through the camera (frames pass over it). The frame is valid and is named after the
/// file. Throws InputError for any other extension, and as read_ptf(), read_mesh() and frame_from_mesh() do.
[[nodiscard]] Frame load(const std::filesystem::path& path, const Camera& camera = {});

}  // namespace halfspace
