// Do the readers agree on the same mesh, and do they follow the parts of their formats that change it?
#include "halfspace/scene/mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "fixture.hpp"
#include "halfspace/scene/byte_source.hpp"
#include "halfspace/scene/compression.hpp"

using namespace halfspace;
using namespace halfspace::test;

namespace {

/// The corners of all triangles, in order.
std::vector<glm::dvec3> corners(const Mesh& mesh) {
  std::vector<glm::dvec3> out;
  for (const std::uint32_t index : mesh.indices) out.push_back(mesh.positions.at(index));
  return out;
}

std::vector<glm::dvec3> cube_corners() {
  std::vector<glm::dvec3> out;
  for (const std::uint32_t index : cube_indices()) out.push_back(kCubeCorners.at(index));
  return out;
}

std::string obj_cube() {
  std::string out = "# cube\n";
  for (const glm::dvec3& p : kCubeCorners) out += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
  for (const auto& f : kCubeFaces)
    out += fmt::format("f {} {} {} {}\n", f[0] + 1, f[1] + 1, f[2] + 1, f[3] + 1);
  return out;
}

template <typename T>
void append_ordered(std::string& out, T value, bool big) {
  std::string raw;
  append(raw, value);
  if (big) std::reverse(raw.begin(), raw.end());
  out += raw;
}

std::string ply_cube(const std::string& format) {
  std::string out = "ply\nformat " + format + " 1.0\ncomment cube\n";
  out += "element vertex 8\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n";
  out += "element face 6\nproperty list uchar int vertex_indices\nend_header\n";
  if (format == "ascii") {
    for (const glm::dvec3& p : kCubeCorners) out += fmt::format("{} {} {} 255\n", p.x, p.y, p.z);
    for (const auto& f : kCubeFaces) out += fmt::format("4 {} {} {} {}\n", f[0], f[1], f[2], f[3]);
    return out;
  }
  const bool big = format == "binary_big_endian";
  for (const glm::dvec3& p : kCubeCorners) {
    for (int i = 0; i < 3; ++i) append_ordered(out, static_cast<float>(p[i]), big);
    out += '\xFF';
  }
  for (const auto& f : kCubeFaces) {
    out += '\4';
    for (const std::uint32_t index : f) append_ordered(out, index, big);
  }
  return out;
}

Mesh read_text(std::string_view name, std::string_view content) {
  const TempFolder folder;
  return read_mesh(folder.write(name, content));
}

Mesh read_json(const nlohmann::json& json) { return read_text("a.gltf", json.dump()); }

/// Triangles of the cube_gltf() buffer drawn by one primitive with these properties.
nlohmann::json with_primitive(const nlohmann::json& change) {
  nlohmann::json json = cube_gltf();
  json["meshes"][0]["primitives"][0].merge_patch(change);
  return json;
}

}  // namespace

TEST_CASE("OBJ, PLY, glTF and GLB of the same cube give the same triangles") {
  const nlohmann::json text = cube_gltf();
  nlohmann::json binary = text;
  binary["buffers"][0].erase("uri");
  CHECK(corners(read_text("a.obj", obj_cube())) == cube_corners());
  CHECK(corners(read_text("a.ply", ply_cube("ascii"))) == cube_corners());
  CHECK(corners(read_text("a.ply", ply_cube("binary_little_endian"))) == cube_corners());
  CHECK(corners(read_text("a.ply", ply_cube("binary_big_endian"))) == cube_corners());
  CHECK(corners(read_json(text)) == cube_corners());
  CHECK(corners(read_text("a.glb", glb(binary.dump(), cube_buffer()))) == cube_corners());
}

TEST_CASE("a packed mesh is read like a plain one") {
  const TempFolder folder;
  write_bytes(folder.path("a.obj"), compress_xz(as_bytes(obj_cube())));
  CHECK(corners(read_mesh(folder.path("a.obj"))) == cube_corners());
}

TEST_CASE("OBJ: a part for each run of a material, points and lines behind its faces") {
  const Mesh mesh =
      read_text("a.obj",
                "mtllib missing.mtl\r\no thing\r\nv 0 0 0\r\nv 1e0 0 0 1\r\nv +1 .1e1 0 1 0 0\r\n"
                "vt 0 0\r\nvn 0 0 1\r\n\tusemtl red\r\nf 1 2 3\r\nusemtl red\r\nf -1//1 -2/1 -3/1/1\r\n"
                "usemtl blue\r\nf 1 3 2\r\nusemtl red\r\nf 3 1 2\r\np 1\r\nl 1 2 3\r\n");
  CHECK(mesh.indices == std::vector<std::uint32_t>{0, 1, 2, 2, 1, 0, 0, 2, 1, 2, 0, 1, 0, 1, 1, 2, 0});
  REQUIRE(mesh.parts.size() == 5);
  CHECK(mesh.parts[0].name == "red");
  CHECK(mesh.parts[0].index_count == 6);
  CHECK(mesh.parts[1].name == "blue");
  CHECK(mesh.parts[1].first_index == 6);
  CHECK(mesh.parts[2].name == "red");
  CHECK(mesh.parts[2].first_index == 9);
  CHECK(mesh.parts[2].index_count == 3);
  CHECK(mesh.positions == std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}});
  CHECK(mesh.parts[3].name == "red");
  CHECK(mesh.parts[3].primitive == Primitive::kLineStrip);
  CHECK(mesh.parts[3].index_count == 4);
  CHECK(mesh.parts[4].primitive == Primitive::kPoints);
  CHECK(mesh.parts[4].first_index == 16);
  CHECK(mesh.left_out.empty());
}

TEST_CASE("PLY: faces before vertices, other elements and lists are passed over, edges are lines") {
  const Mesh mesh =
      read_text("a.ply",
                "ply\nformat ascii 1.0\nelement face 1\nproperty list uint8 int16 vertex_index\n"
                "property uchar flag\nelement edge 2\nproperty int vertex1\nproperty int vertex2\n"
                "element vertex 3\nproperty list uchar double w\nproperty double z\nproperty int x\n"
                "property float32 y\nend_header\n3 2 1 0 9\n0 1\n1 2\n2 7 7 0.5 1 2\n0 3 1 1\n"
                "1 3 1e99 -1 -1");
  CHECK(mesh.indices == std::vector<std::uint32_t>{2, 1, 0, 0, 1, 1, 2});
  REQUIRE(mesh.parts.size() == 2);
  CHECK(mesh.parts[1].primitive == Primitive::kLines);
  CHECK(mesh.parts[1].first_index == 3);
  CHECK(mesh.positions[0] == glm::dvec3(1, 2, 0.5f));
  CHECK(mesh.positions[2] == glm::dvec3(-1, -1, 1e99));
  CHECK(mesh.left_out.empty());
}

TEST_CASE("glTF: transforms go from the node to the root") {
  nlohmann::json json = cube_gltf();
  const double half = std::sqrt(0.5);
  json["scenes"][0]["nodes"] = {1};
  json["nodes"] = nlohmann::json::parse(R"([{"mesh": 0, "scale": [1, 2, 3], "translation": [10, 0, 0]},
    {"children": [0], "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,5,1]}])");
  json["nodes"][0]["rotation"] = {0, 0, half, half};  // a quarter turn about z: x to y, y to -x
  const Mesh mesh = read_json(json);
  // (1, 1, 1) -> scale (1, 2, 3) -> turn (-2, 1, 3) -> move (8, 1, 3) -> the parent (8, 1, 8)
  const glm::dvec3 p = mesh.positions.at(6);
  CHECK(p.x == Approx(8));
  CHECK(p.y == Approx(1));
  CHECK(p.z == Approx(8));
}

TEST_CASE("glTF: instances are written out, one part for each primitive of each node") {
  nlohmann::json json = cube_gltf();
  json["scenes"][0]["nodes"] = {0, 1};
  json["nodes"] = nlohmann::json::parse(R"([{"mesh": 0}, {"mesh": 0, "translation": [5, 0, 0]}])");
  json["meshes"][0]["name"] = "box";
  json["meshes"][0]["primitives"][0]["material"] = 0;
  json["materials"] = {{{"name", "wood"}}};
  const Mesh mesh = read_json(json);
  REQUIRE(mesh.parts.size() == 2);
  CHECK(mesh.parts[1].name == "box, wood");
  CHECK(mesh.parts[1].first_index == 36);
  std::vector<glm::dvec3> expected = cube_corners();
  for (const glm::dvec3 corner : cube_corners()) expected.push_back(corner + glm::dvec3(5, 0, 0));
  CHECK(corners(mesh) == expected);
}

TEST_CASE("glTF: the default scene, else the first, else the roots") {
  nlohmann::json json = cube_gltf();
  json["nodes"] =
      nlohmann::json::parse(R"([{"mesh": 0, "translation": [5, 0, 0]}, {"children": [2]}, {"mesh": 0}])");
  json["scenes"] = nlohmann::json::parse(R"([{"nodes": [0]}, {"nodes": [1]}])");
  json["scene"] = 1;
  CHECK(corners(read_json(json)) == cube_corners());
  json.erase("scene");
  CHECK(read_json(json).positions[0].x == 4);
  json.erase("scenes");
  CHECK(read_json(json).parts.size() == 2);
}

TEST_CASE("glTF: triangle lists, strips and fans, points, lines, loops and strips") {
  const auto order = [](int mode) {
    return read_json(with_primitive({{"indices", nullptr}, {"mode", mode}})).indices;
  };
  CHECK(order(5) == std::vector<std::uint32_t>{0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 5, 4, 5, 6, 6, 5, 7});
  CHECK(order(6) == std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5, 0, 5, 6, 0, 6, 7});
  CHECK(read_json(with_primitive({{"mode", 4}})).indices == cube_indices());
  CHECK(order(0) == std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 7});
  CHECK(order(1) == std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 7});
  CHECK(order(2) == std::vector<std::uint32_t>{0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7, 7, 0});
  CHECK(order(3) == std::vector<std::uint32_t>{0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7});
  nlohmann::json json = cube_gltf();
  for (int mode = 0; mode < 4; ++mode) {
    json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"mode", mode}});
  }
  const Mesh mesh = read_json(json);
  CHECK(mesh.left_out.empty());
  REQUIRE(mesh.parts.size() == 5);
  CHECK(mesh.parts[1].primitive == Primitive::kPoints);
  CHECK(mesh.parts[2].primitive == Primitive::kLines);
  CHECK(mesh.parts[3].primitive == Primitive::kLineStrip);
  CHECK(mesh.parts[4].primitive == Primitive::kLineStrip);
}

TEST_CASE("glTF: indices of 8, 16 and 32 bits, interleaved positions, shared and outside buffers") {
  const TempFolder folder;
  std::string buffer;
  for (const glm::dvec3& p : kCubeCorners) {
    append(buffer, glm::vec3(p));
    buffer += "12345678";
  }
  const int size = GENERATE(1, 2, 4);
  for (const std::uint32_t index : cube_indices()) {
    buffer.append(reinterpret_cast<const char*>(&index), static_cast<std::size_t>(size));
  }
  nlohmann::json json = cube_gltf();
  json["bufferViews"][0]["byteLength"] = 160;
  json["bufferViews"][0]["byteStride"] = 20;
  json["bufferViews"][1]["byteOffset"] = 160;
  json["bufferViews"][1]["byteLength"] = 36 * size;
  json["accessors"][1]["componentType"] = size == 1 ? 5121 : size == 2 ? 5123 : 5125;
  json["buffers"][0] = {{"byteLength", buffer.size()}, {"uri", "data/my%20cube.bin"}};
  folder.write("data/my cube.bin", buffer);
  CHECK(corners(read_mesh(folder.write("cube.gltf", json.dump()))) == cube_corners());
}

TEST_CASE(
    "glTF: an outside buffer is taken as it is, even if it looks packed, and beside a file without folder") {
  const TempFolder folder;
  std::string buffer = cube_buffer();
  buffer[0] = '\x1F';
  buffer[1] = '\x8B';
  nlohmann::json json = cube_gltf();
  json["buffers"][0]["uri"] = "cube.bin";
  folder.write("cube.bin", buffer);
  folder.write("cube.gltf", json.dump());
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path(""));
  CHECK(read_mesh("cube.gltf").positions[1] == kCubeCorners[1]);
  std::filesystem::current_path(before);
}

TEST_CASE("glTF: images are never opened") {
  nlohmann::json json = cube_gltf();
  json["images"] = nlohmann::json::parse(
      R"([{"uri": "missing.png"}, {"uri": "data:image/png;base64,AAAA"}, {"bufferView": 1, "mimeType": "image/png"}])");
  json["textures"] = {{{"source", 0}}};
  CHECK(corners(read_json(json)) == cube_corners());
}

TEST_CASE(
    "faces of fewer than three corners, and vertices that are not finite, are left out and counted alike") {
  // Faces 0 1 2, then one with the infinite vertex 3, one of two corners and one of none.
  const std::vector<std::string> expected{"faces with a vertex that is not finite (1)",
                                          "faces with fewer than three corners (2)",
                                          "vertices that are not finite (1)"};
  const Mesh ply = read_text("a.ply",
                             "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                             "property float z\nelement face 4\nproperty list uchar int vertex_indices\n"
                             "end_header\n0 0 0\n1 0 0\n1 1 0\n0 inf 0\n3 0 1 2\n4 0 1 2 3\n2 0 1\n0\n");
  CHECK(ply.indices == std::vector<std::uint32_t>{0, 1, 2});
  CHECK(ply.left_out == expected);
}

TEST_CASE("positions are as exact as the file's numbers") {
  const Mesh ply = read_text("a.ply",
                             "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\n"
                             "property double z\nelement face 1\nproperty list uchar int vertex_indices\n"
                             "end_header\n388096.1 3948996.3 0\n1 0 0\n1 1 0\n3 0 1 2\n");
  CHECK(ply.positions[0] == glm::dvec3(388096.1, 3948996.3, 0));
}
