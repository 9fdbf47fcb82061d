#include "halfspace/cli/load_input.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>

#include "halfspace/scene/byte_source.hpp"
#include "halfspace/scene/load.hpp"

namespace halfspace {

void say_left_out(const std::filesystem::path& path, const std::vector<std::string>& left_out) {
  if (!left_out.empty()) {
    const std::string line =
        fmt::format("halfspace: {}: left out: {}\n", display_name(path), fmt::join(left_out, ", "));
    std::fputs(line.c_str(), stderr);
  }
}

Frame load_input(const std::filesystem::path& path, const Camera& camera, MeshContent content) {
  Frame frame = load(path, camera, content);
  say_left_out(path, frame.left_out);
  return frame;
}

Frame load_input(const std::filesystem::path& path, const Camera& camera) {
  return load_input(path, camera, MeshContent::kGeometry);
}

}  // namespace halfspace
