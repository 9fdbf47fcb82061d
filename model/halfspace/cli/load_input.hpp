/// Loading for the command line.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "halfspace/scene/camera.hpp"
#include "halfspace/scene/frame.hpp"
#include "halfspace/scene/mesh.hpp"

namespace halfspace {

/// A line on stderr of what of the file is not in its frame or mesh; none where nothing is left out.
void say_left_out(const std::filesystem::path& path, const std::vector<std::string>& left_out);

/// load(), which says what is left out.
[[nodiscard]] Frame load_input(const std::filesystem::path& path, const Camera& camera = {});
[[nodiscard]] Frame load_input(const std::filesystem::path& path, const Camera& camera, MeshContent content);

}  // namespace halfspace
