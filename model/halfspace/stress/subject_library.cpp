#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "halfspace/numerics/error.hpp"
#include "halfspace/stress/halfspace_rasterizer.h"
#include "halfspace/stress/subject.hpp"

namespace halfspace::stress {
namespace {

halfspace_scene_command scene_command(const Command& c) {
  return {.kind = static_cast<std::uint32_t>(c.kind),
          .flags = c.flags,
          .depth_func = static_cast<std::uint32_t>(c.depth_func),
          .first_index = c.first_index,
          .index_count = c.index_count,
          .first_vertex = c.first_vertex,
          .viewport = {c.viewport.x, c.viewport.y, c.viewport.z, c.viewport.w},
          .depth_range = {c.depth_range.x, c.depth_range.y},
          .clear_depth = c.clear_depth,
          .offset_factor = c.offset_factor,
          .offset_units = c.offset_units,
          .offset_clamp = c.offset_clamp,
          .scissor = {c.scissor.x, c.scissor.y, c.scissor.width, c.scissor.height}};
}

class Library final : public Subject {
 public:
  Library(std::filesystem::path file, int sub_pixel_bits)
      : file_(std::move(file)),
        sub_pixel_bits_(sub_pixel_bits),
        library_(dlopen(std::filesystem::absolute(file_).c_str(), RTLD_NOW | RTLD_LOCAL), &dlclose) {
    if (library_ == nullptr) {
      throw InputError(fmt::format("{} cannot be loaded: {}", file_.string(), dlerror()));
    }
    draw_ = reinterpret_cast<decltype(&halfspace_rasterize)>(dlsym(library_.get(), "halfspace_rasterize"));
    if (draw_ == nullptr) {
      throw InputError(
          fmt::format("{} has no function halfspace_rasterize; see halfspace_rasterizer.h", file_.string()));
    }
  }

  [[nodiscard]] std::string name() const override {
    return fmt::format("library {}", file_.filename().string());
  }

  Picture draw(const Frame& frame) override {
    const Target& target = frame.targets.front();
    const std::size_t pixels = std::size_t{target.width} * target.height;
    std::vector<halfspace_scene_command> commands;
    for (const Command& command : frame.commands) {
      commands.push_back(scene_command(command));
    }
    const halfspace_scene scene{.width = target.width,
                                .height = target.height,
                                .depth_format = static_cast<std::uint32_t>(target.depth_format),
                                .sub_pixel_bits = static_cast<std::uint32_t>(sub_pixel_bits_),
                                .command_count = static_cast<std::uint32_t>(commands.size()),
                                .commands = commands.data(),
                                .index_count = static_cast<std::uint32_t>(frame.indices.size()),
                                .indices = frame.indices.data(),
                                .vertex_count = static_cast<std::uint32_t>(frame.vertices.size()),
                                .vertices = frame.vertices.empty() ? nullptr : &frame.vertices.front().x};
    Picture picture{.width = target.width,
                    .height = target.height,
                    .fragments = std::vector<std::uint32_t>(pixels),
                    .survivors = std::vector<std::uint32_t>(pixels),
                    .codes = std::vector<std::uint32_t>(pixels)};
    halfspace_scene_picture out{picture.fragments.data(), picture.survivors.data(), picture.codes.data()};
    std::array<char, 256> error{};
    if (draw_(&scene, &out, error.data(), error.size()) != 0) {
      error.back() = '\0';
      throw std::runtime_error(fmt::format("{}: {}", file_.filename().string(), error.data()));
    }
    return picture;
  }

 private:
  std::filesystem::path file_;
  int sub_pixel_bits_;
  std::unique_ptr<void, int (*)(void*)> library_;
  decltype(&halfspace_rasterize) draw_ = nullptr;
};

}  // namespace

std::unique_ptr<Subject> library_subject(const std::filesystem::path& file, int sub_pixel_bits) {
  return std::make_unique<Library>(file, sub_pixel_bits);
}

}  // namespace halfspace::stress
