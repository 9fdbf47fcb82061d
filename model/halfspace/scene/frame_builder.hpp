/// Frames built from window coordinates.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "halfspace/scene/frame.hpp"

namespace halfspace {

/// One square target, cleared to 1, and draws given in window coordinates. The side is a power of two of at
/// most 1024, so that positions on the grid of 1/256 pixel survive the way through clip space unrounded.
class FrameBuilder {
 public:
  explicit FrameBuilder(std::uint32_t size, DepthFormat format = DepthFormat::kUnorm24) : size_(size) {
    frame.name = "built";
    frame.targets.push_back({.width = size,
                             .height = size,
                             .samples = 1,
                             .depth_format = format,
                             .color_count = 1,
                             .presented = true,
                             .depth_surface = 0});
    clear(1);
  }

  Command& clear(float depth) {
    Command command;
    command.kind = CommandKind::kClear;
    command.flags = bits({Flag::kClearDepth});
    command.clear_depth = depth;
    frame.commands.push_back(command);
    return frame.commands.back();
  }

  /// A draw of triangles, three (x, y, depth) each; tests LESS and writes unless the caller changes it.
  Command& draw(const std::vector<glm::dvec3>& window) {
    Command command;
    command.flags = bits({Flag::kDepthTest, Flag::kDepthWrite, Flag::kFrontPositiveArea, Flag::kColorWrite});
    command.depth_func = DepthFunc::kLess;
    command.viewport = {0, 0, size_, size_};
    command.first_index = static_cast<std::uint32_t>(frame.indices.size());
    command.first_vertex = static_cast<std::uint32_t>(frame.vertices.size());
    command.index_count = static_cast<std::uint32_t>(window.size());
    command.vertex_count = static_cast<std::uint32_t>(window.size());
    for (std::uint32_t i = 0; i < window.size(); ++i) {
      const glm::dvec3& v = window[i];
      frame.indices.push_back(i);
      frame.vertices.emplace_back(v.x * 2 / size_ - 1, v.y * 2 / size_ - 1, v.z, 1);
    }
    frame.commands.push_back(command);
    return frame.commands.back();
  }

  Frame frame;

 private:
  double size_;
};

}  // namespace halfspace
