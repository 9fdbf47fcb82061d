#include "halfspace/speed/grid_meshes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <glm/vec3.hpp>
#include <iterator>
#include <span>
#include <string>
#include <string_view>

#include "halfspace/scene/byte_source.hpp"

namespace halfspace {
namespace {

struct Grid {
  std::vector<glm::vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

Grid make_grid(std::uint32_t side) {
  Grid grid;
  grid.positions.reserve(std::size_t{side} * side);
  for (std::uint32_t z = 0; z < side; ++z) {
    for (std::uint32_t x = 0; x < side; ++x) {
      const std::uint32_t height = (x * 2654435761u ^ z * 2246822519u) * 3266489917u >> 16;
      const auto unit = 10.f / static_cast<float>(side - 1);
      grid.positions.emplace_back(static_cast<float>(x) * unit - 5, static_cast<float>(height) / 65536,
                                  static_cast<float>(z) * unit - 5);
    }
  }
  grid.triangles.reserve(std::size_t{2} * (side - 1) * (side - 1));
  for (std::uint32_t z = 0; z + 1 < side; ++z) {
    for (std::uint32_t x = 0; x + 1 < side; ++x) {
      const std::uint32_t a = z * side + x;
      grid.triangles.push_back({a, a + side, a + side + 1});
      grid.triangles.push_back({a, a + side + 1, a + 1});
    }
  }
  return grid;
}

using Sink = std::back_insert_iterator<std::string>;

std::string obj(const Grid& grid, bool attributes) {
  std::string out;
  Sink sink(out);
  for (const glm::vec3 p : grid.positions) fmt::format_to(sink, "v {:.6f} {:.6f} {:.6f}\n", p.x, p.y, p.z);
  if (attributes) {
    for (const glm::vec3 p : grid.positions) fmt::format_to(sink, "vt {:.6f} {:.6f}\n", p.x / 10, p.z / 10);
    for (const glm::vec3 p : grid.positions)
      fmt::format_to(sink, "vn {:.4f} {:.4f} {:.4f}\n", p.y, 1 - p.y, p.y);
  }
  for (const auto& t : grid.triangles) {
    if (attributes) {
      fmt::format_to(sink, "f {0}/{0}/{0} {1}/{1}/{1} {2}/{2}/{2}\n", t[0] + 1, t[1] + 1, t[2] + 1);
    } else {
      fmt::format_to(sink, "f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
    }
  }
  return out;
}

template <typename T>
void append(std::string& out, T value, std::endian order) {
  auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
  out.append(raw.data(), raw.size());
}

std::string ply_header(const Grid& grid, std::string_view format) {
  return fmt::format(
      "ply\nformat {} 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      format, grid.positions.size(), grid.triangles.size());
}

std::string ascii_ply(const Grid& grid) {
  std::string out = ply_header(grid, "ascii");
  Sink sink(out);
  for (const glm::vec3 p : grid.positions) fmt::format_to(sink, "{:.6f} {:.6f} {:.6f}\n", p.x, p.y, p.z);
  for (const auto& t : grid.triangles) fmt::format_to(sink, "3 {} {} {}\n", t[0], t[1], t[2]);
  return out;
}

std::string binary_ply(const Grid& grid, std::endian order) {
  std::string out =
      ply_header(grid, order == std::endian::little ? "binary_little_endian" : "binary_big_endian");
  for (const glm::vec3 p : grid.positions) {
    for (int axis = 0; axis < 3; ++axis) append(out, p[axis], order);
  }
  for (const auto& t : grid.triangles) {
    out += '\3';
    for (const std::uint32_t corner : t) append(out, corner, order);
  }
  return out;
}

/// Positions, then indices: a multiple of 3 and of 4 bytes.
std::string gltf_buffer(const Grid& grid) {
  std::string out;
  for (const glm::vec3 p : grid.positions) {
    for (int axis = 0; axis < 3; ++axis) append(out, p[axis], std::endian::little);
  }
  for (const auto& t : grid.triangles) {
    for (const std::uint32_t corner : t) append(out, corner, std::endian::little);
  }
  return out;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | static_cast<unsigned char>(bytes[i + k]);
    for (int shift = 18; shift >= 0; shift -= 6) out += kDigits[group >> shift & 63];
  }
  return out;
}

/// `uri` of the buffer; empty in a GLB.
std::string gltf(const Grid& grid, std::string_view uri) {
  const std::size_t positions = grid.positions.size() * 12;
  const std::size_t indices = grid.triangles.size() * 12;
  return fmt::format(
      R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],)"
      R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],)"
      R"("accessors":[{{"bufferView":0,"componentType":5126,"count":{},"type":"VEC3","min":[-5,0,-5],"max":[5,1,5]}},)"
      R"({{"bufferView":1,"componentType":5125,"count":{},"type":"SCALAR"}}],)"
      R"("bufferViews":[{{"buffer":0,"byteLength":{}}},{{"buffer":0,"byteOffset":{},"byteLength":{}}}],)"
      R"("buffers":[{{{}"byteLength":{}}}]}})",
      grid.positions.size(), 3 * grid.triangles.size(), positions, positions, indices,
      uri.empty() ? "" : fmt::format(R"("uri":"{}",)", uri), positions + indices);
}

std::string glb(const Grid& grid) {
  std::string json = gltf(grid, "");
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::string buffer = gltf_buffer(grid);
  std::string out = "glTF";
  const auto put = [&out](std::size_t value) {
    append(out, static_cast<std::uint32_t>(value), std::endian::little);
  };
  put(2);
  put(12 + 8 + json.size() + 8 + buffer.size());
  put(json.size());
  out += "JSON" + json;
  put(buffer.size());
  out.append("BIN\0", 4);
  return out + buffer;
}

}  // namespace

std::vector<std::filesystem::path> write_grid_meshes(const std::filesystem::path& folder,
                                                     std::uint32_t side) {
  const Grid grid = make_grid(side);
  const auto write = [&folder](std::string_view name, const std::string& content) {
    write_bytes(folder / name, std::as_bytes(std::span(content)));
    return folder / name;
  };
  return {
      write("grid.obj", obj(grid, false)),
      write("grid_attributes.obj", obj(grid, true)),
      write("grid_ascii.ply", ascii_ply(grid)),
      write("grid_little.ply", binary_ply(grid, std::endian::little)),
      write("grid_big.ply", binary_ply(grid, std::endian::big)),
      write("grid.glb", glb(grid)),
      write("grid.gltf", gltf(grid, "data:application/octet-stream;base64," + base64(gltf_buffer(grid))))};
}

}  // namespace halfspace
