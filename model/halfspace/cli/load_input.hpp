/// Loading for the command line.
#pragma once

#include <filesystem>

#include "halfspace/scene/camera.hpp"
#include "halfspace/scene/frame.hpp"

namespace halfspace {

/// load(); a line on stderr says what of the file is not in the frame.
[[nodiscard]] Frame load_input(const std::filesystem::path& path, const Camera& camera = {});

}  // namespace halfspace
