/// Small glTF files, made here, and what they must draw.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "fixture.hpp"
#include "halfspace/core/functional.hpp"
#include "halfspace/scene/camera.hpp"
#include "halfspace/scene/mesh.hpp"
#include "halfspace/scene/mesh_formats.hpp"

namespace halfspace::test {

template <typename Number>
constexpr int component_type() {
  if constexpr (std::is_same_v<Number, std::int8_t>) return 5120;
  if constexpr (std::is_same_v<Number, std::uint8_t>) return 5121;
  if constexpr (std::is_same_v<Number, std::int16_t>) return 5122;
  if constexpr (std::is_same_v<Number, std::uint16_t>) return 5123;
  if constexpr (std::is_same_v<Number, std::uint32_t>) return 5125;
  if constexpr (std::is_same_v<Number, double>) return 5130;
  return 5126;
}

inline int width_of_type(const std::string& type) {
  return type == "SCALAR" ? 1 : type == "MAT4" ? 16 : type.back() - '0';
}

/// One node that draws one primitive, whose attributes are still to be given, and a buffer that grows.
struct GltfSample {
  nlohmann::json root = {{"asset", {{"version", "2.0"}}},
                         {"scene", 0},
                         {"scenes", {{{"nodes", {0}}}}},
                         {"nodes", {{{"mesh", 0}}}},
                         {"meshes", {{{"primitives", {{{"attributes", nlohmann::json::object()}}}}}}}};
  std::string buffer;

  nlohmann::json& primitive() { return root["meshes"][0]["primitives"][0]; }
  nlohmann::json& attributes() { return primitive()["attributes"]; }
  nlohmann::json& node(int index = 0) { return root["nodes"][index]; }

  int add_bytes(std::string_view bytes) {
    buffer.resize((buffer.size() + 7) / 8 * 8);
    root["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes.size()}});
    buffer += bytes;
    return static_cast<int>(root["bufferViews"].size()) - 1;
  }

  template <typename Number>
  int add_view(const std::vector<Number>& values) {
    return add_bytes({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Number)});
  }

  /// An accessor with a view of its own. `more`: other properties.
  template <typename Number>
  int add(const std::string& type, const std::vector<Number>& values, const nlohmann::json& more = {}) {
    const int view = add_view(values);
    return add_bare<Number>(type, values.size() / static_cast<std::size_t>(width_of_type(type)),
                            nlohmann::json{{"bufferView", view}}, more);
  }

  /// An accessor without data, but for what `more` gives it.
  template <typename Number>
  int add_bare(const std::string& type, std::uint64_t count, const nlohmann::json& more = {},
               const nlohmann::json& also = {}) {
    nlohmann::json accessor = {{"componentType", component_type<Number>()}, {"type", type}, {"count", count}};
    if (more.is_object()) accessor.update(more);
    if (also.is_object()) accessor.update(also);
    root["accessors"].push_back(accessor);
    return static_cast<int>(root["accessors"].size()) - 1;
  }

  /// The file, with its buffer inside.
  [[nodiscard]] std::string text() const {
    nlohmann::json json = root;
    const std::string uri = "data:application/octet-stream;base64," + base64(buffer);
    json["buffers"][0] = {{"byteLength", buffer.size()}, {"uri", uri}};
    return json.dump();
  }

  /// `padding` follows the JSON in its chunk.
  [[nodiscard]] std::string binary(const std::string& padding = "") const {
    nlohmann::json json = root;
    json["buffers"][0] = {{"byteLength", buffer.size()}};
    return glb(json.dump() + padding, buffer);
  }

  [[nodiscard]] Mesh read() const { return parse_gltf(as_bytes(text()), "f", "/nonexistent"); }
  [[nodiscard]] std::string error() const {
    return error_of([&] { return read(); });
  }
};

/// The points from (x0, y0) to (x1, y1), counter-clockwise.
template <typename Number = float>
std::vector<Number> quad_points(Number x0, Number y0, Number x1, Number y1, Number z = 0) {
  return {x0, y0, z, x1, y0, z, x1, y1, z, x0, y1, z};
}

inline const std::vector<std::uint16_t> kQuadIndices{0, 1, 2, 0, 2, 3};

/// A file that draws the square from (-1, -1) to (1, 1).
inline GltfSample quad_sample() {
  GltfSample sample;
  sample.attributes()["POSITION"] = sample.add("VEC3", quad_points(-1.0f, -1.0f, 1.0f, 1.0f));
  sample.primitive()["indices"] = sample.add("SCALAR", kQuadIndices);
  return sample;
}

/// The corners of all triangles, in order.
inline std::vector<glm::dvec3> drawn(const Mesh& mesh) {
  std::vector<glm::dvec3> out;
  for (const std::uint32_t index : mesh.indices) out.push_back(mesh.positions.at(index));
  return out;
}

struct Rect {
  double x0, y0, x1, y1;
};

/// The corners of the rectangles' triangles, as the samples' indices draw them.
inline std::vector<glm::dvec3> corners_of(const std::vector<Rect>& rects) {
  std::vector<glm::dvec3> out;
  for (const Rect& r : rects) {
    const glm::dvec3 points[] = {{r.x0, r.y0, 0}, {r.x1, r.y0, 0}, {r.x1, r.y1, 0}, {r.x0, r.y1, 0}};
    for (const std::uint16_t index : kQuadIndices) out.push_back(points[index]);
  }
  return out;
}

/// 32 rows of 32 pixels, a digit for the fragments of each. The camera is at (0, 0, 4) and looks at the
/// origin with 90 degrees: at z = 0 a pixel is a quarter wide, and the left upper corner is (-4, 4).
inline std::string picture(const Mesh& mesh) {
  Camera camera;
  camera.eye = glm::dvec3(0, 0, 4);
  camera.at = glm::dvec3(0);
  camera.fov_degrees = 90;
  camera.width = camera.height = 32;
  const FrameResult result = run_functional(frame_from_mesh(mesh, camera, "f"), {});
  std::string out;
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) {
      const int count = result.surfaces.at(0).fragments.at(x, y);
      out += count == 0 ? '.' : static_cast<char>('0' + std::min(count, 9));
    }
    out += '\n';
  }
  return out;
}

/// The same picture of rectangles at z = 0: those pixels whose centres are in them.
inline std::string picture_of(const std::vector<Rect>& rects) {
  std::string out;
  for (int row = 0; row < 32; ++row) {
    for (int column = 0; column < 32; ++column) {
      const double x = -4 + (column + 0.5) / 4;
      const double y = 4 - (row + 0.5) / 4;
      const auto covers = [&](const Rect& r) {
        return std::min(r.x0, r.x1) < x && x < std::max(r.x0, r.x1) && std::min(r.y0, r.y1) < y &&
               y < std::max(r.y0, r.y1);
      };
      const auto count = std::count_if(rects.begin(), rects.end(), covers);
      out += count == 0 ? '.' : static_cast<char>('0' + std::min<std::ptrdiff_t>(count, 9));
    }
    out += '\n';
  }
  return out;
}

}  // namespace halfspace::test
