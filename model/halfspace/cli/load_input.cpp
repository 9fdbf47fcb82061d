#include "halfspace/cli/load_input.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>

#include "halfspace/scene/byte_source.hpp"
#include "halfspace/scene/load.hpp"

namespace halfspace {

Frame load_input(const std::filesystem::path& path, const Camera& camera) {
  Frame frame = load(path, camera);
  if (!frame.left_out.empty()) {
    const std::string line =
        fmt::format("halfspace: {}: left out: {}\n", display_name(path), fmt::join(frame.left_out, ", "));
    std::fputs(line.c_str(), stderr);
  }
  return frame;
}

}  // namespace halfspace
