/// Small frames, meshes and folders for the tests of what goes in.
#pragma once

#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/numerics/error.hpp"
#include "halfspace/scene/frame.hpp"

namespace halfspace::test {

/// A folder of its own, removed at the end.
class TempFolder {
 public:
  TempFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "halfspace_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~TempFolder() { std::filesystem::remove_all(path_); }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  [[nodiscard]] std::filesystem::path path(std::string_view name) const { return path_ / name; }

  std::filesystem::path write(std::string_view name, std::string_view content) const {
    std::filesystem::create_directories(path(name).parent_path());
    std::ofstream(path(name), std::ios::binary) << content;
    return path(name);
  }

 private:
  std::filesystem::path path_;
};

inline std::span<const std::byte> as_bytes(std::string_view text) {
  return {reinterpret_cast<const std::byte*>(text.data()), text.size()};
}

inline std::string as_text(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

inline std::vector<std::byte> to_vector(std::string_view text) {
  const auto bytes = as_bytes(text);
  return {bytes.begin(), bytes.end()};
}

/// what() of the InputError that `action` throws; "no error" when it throws none.
template <typename Action>
std::string error_of(Action action) {
  try {
    (void)action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

/// Two targets, a clear and a draw of a quad.
inline Frame small_frame() {
  Frame frame;
  frame.name = "small";
  frame.targets = {{.width = 8,
                    .height = 6,
                    .samples = 1,
                    .depth_format = DepthFormat::kUnorm24,
                    .color_count = 1,
                    .presented = true,
                    .depth_surface = 0},
                   {.width = 4, .height = 4, .samples = 1, .color_count = 1}};
  Command clear;
  clear.kind = CommandKind::kClear;
  clear.source_event = 6;
  clear.flags = static_cast<std::uint32_t>(Flag::kClearDepth);
  clear.clear_depth = 0.5f;
  clear.scissor = {-1, 0, 8, 6};
  Command draw;
  draw.source_event = 7;
  draw.flags = static_cast<std::uint32_t>(Flag::kDepthTest) | static_cast<std::uint32_t>(Flag::kDepthWrite);
  draw.depth_func = DepthFunc::kLequal;
  draw.first_index = 0;
  draw.index_count = 6;
  draw.first_vertex = 1;
  draw.vertex_count = 4;
  draw.viewport = {0, 6, 8, -6};
  draw.depth_range = {0.25f, 0.75f};
  draw.clear_depth = 1;
  draw.offset_factor = -1;
  draw.offset_units = 2;
  draw.offset_clamp = 0.125f;
  frame.commands = {clear, draw};
  frame.vertices = {{9, 9, 9, 1}, {-1, -1, 0, 1}, {1, -1, 0, 1}, {1, 1, 0, 1}, {-1, 1, 0, 1}};
  frame.indices = {0, 1, 2, 0, 2, 3};
  frame.meta = "{\"application\": \"test\"}";
  return frame;
}

/// The same bits, NaN included.
template <typename T>
bool same_bits(const T& a, const T& b) {
  return std::memcmp(&a, &b, sizeof(T)) == 0;
}

inline constexpr std::array<glm::dvec3, 8> kCubeCorners{
    glm::dvec3(-1, -1, -1), glm::dvec3(1, -1, -1), glm::dvec3(1, 1, -1), glm::dvec3(-1, 1, -1),
    glm::dvec3(-1, -1, 1),  glm::dvec3(1, -1, 1),  glm::dvec3(1, 1, 1),  glm::dvec3(-1, 1, 1)};
inline constexpr std::array<std::array<std::uint32_t, 4>, 6> kCubeFaces{
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 4, 7, 3}, {1, 2, 6, 5}}};

/// Twelve triangles, each face a fan around its first corner.
inline std::vector<std::uint32_t> cube_indices() {
  std::vector<std::uint32_t> indices;
  for (const auto& f : kCubeFaces) indices.insert(indices.end(), {f[0], f[1], f[2], f[0], f[2], f[3]});
  return indices;
}

template <typename T>
void append(std::string& out, const T& value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

inline std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      out += i + k <= bytes.size() ? kDigits[group >> (18 - 6 * k) & 63] : '=';
    }
  }
  return out;
}

/// The cube as binary: 96 bytes of positions, then 36 indices of 16 bits.
inline std::string cube_buffer() {
  std::string out;
  for (const glm::dvec3& p : kCubeCorners) append(out, glm::vec3(p));
  for (const std::uint32_t index : cube_indices()) append(out, static_cast<std::uint16_t>(index));
  return out;
}

/// One node with the cube, its buffer inside the text.
inline nlohmann::json cube_gltf() {
  const std::string buffer = cube_buffer();
  return {
      {"asset", {{"version", "2.0"}}},
      {"scene", 0},
      {"scenes", {{{"nodes", {0}}}}},
      {"nodes", {{{"mesh", 0}}}},
      {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}}},
      {"accessors",
       {{{"bufferView", 0}, {"componentType", 5126}, {"count", 8}, {"type", "VEC3"}},
        {{"bufferView", 1}, {"componentType", 5123}, {"count", 36}, {"type", "SCALAR"}}}},
      {"bufferViews",
       {{{"buffer", 0}, {"byteLength", 96}}, {{"buffer", 0}, {"byteOffset", 96}, {"byteLength", 72}}}},
      {"buffers",
       {{{"byteLength", buffer.size()}, {"uri", "data:application/octet-stream;base64," + base64(buffer)}}}},
  };
}

/// The container of a binary glTF file.
inline std::string glb(std::string json, std::string_view buffer) {
  while (json.size() % 4 != 0) json += ' ';
  std::string out = "glTF";
  append(out, std::uint32_t{2});
  append(out, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + buffer.size()));
  append(out, static_cast<std::uint32_t>(json.size()));
  out += "JSON" + json;
  append(out, static_cast<std::uint32_t>(buffer.size()));
  out.append("BIN\0", 4).append(buffer);
  return out;
}

}  // namespace halfspace::test
