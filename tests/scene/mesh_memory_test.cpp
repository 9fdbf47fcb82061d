// Is the memory that a reader takes within the multiple of the file's size that docs/guides/meshes.md states?
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cstdint>
#include <string>

#include "fixture.hpp"
#include "halfspace/scene/mesh_formats.hpp"
#include "halfspace/speed/surface_cost.hpp"

using namespace halfspace;
using namespace halfspace::test;

#ifndef __SANITIZE_ADDRESS__  // whose own memory would be measured
namespace {

constexpr std::size_t kFileBytes = 8'000'000;
constexpr double kMostMemory = 64;  // bytes a byte of the file

/// `text` again and again behind `head`.
std::string repeated(std::string head, const std::string& text) {
  while (head.size() < kFileBytes) head += text;
  return head;
}

std::string ply_head(const std::string& format, const std::string& elements) {
  return "ply\nformat " + format + " 1.0\n" + elements + "end_header\n";
}

const std::string kByteVertices = "element vertex 3\nproperty uchar x\nproperty uchar y\nproperty uchar z\n";
const std::string kThreeVertices = {"\0\0\0\1\0\0\0\1\0", 9};

/// One list of kFileBytes corners of one byte each.
std::string byte_list(const std::string& element, int period) {
  std::string out = ply_head("binary_little_endian", kByteVertices + element) + kThreeVertices;
  append(out, static_cast<std::uint32_t>(kFileBytes));
  for (std::size_t i = 0; i < kFileBytes; ++i) out += static_cast<char>(static_cast<int>(i) % period);
  return out;
}

double memory(const std::string& file, Mesh (*parse)(std::span<const std::byte>, std::string_view)) {
  const RunCost cost = cost_of_fresh_run([&] { (void)parse(as_bytes(file), "f"); });
  return cost.megabytes * 1e6 / static_cast<double>(file.size());
}

}  // namespace

TEST_CASE("OBJ: memory is within its multiple of the file's size", "[exhaustive]") {
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  CHECK(memory(repeated(points + "f 1 2 3\n", "v 1 1 1\n"), parse_obj) < kMostMemory);
  CHECK(memory(repeated(points, "f 1 2 3\n"), parse_obj) < kMostMemory);
  CHECK(memory(repeated(points, "f 1 2 3 1\n"), parse_obj) < kMostMemory);
  CHECK(memory(repeated(points, "f 1 2 3\nusemtl\nf 1 2 3\nusemtl a\n"), parse_obj) < kMostMemory);
  CHECK(memory(repeated(points + "f 1 2 3\nf", " 1"), parse_obj) < kMostMemory);
  // Points of a parabola: a polygon that is convex, with its vertices.
  std::string parabola;
  constexpr std::int64_t kCorners = 100000;
  for (std::int64_t x = 0; x < kCorners; ++x) parabola += fmt::format("v {} {} 0\n", x, x * x);
  for (int i = 0; i < 20; ++i) {
    parabola += "f";
    for (std::int64_t corner = 1; corner <= kCorners; ++corner) parabola += fmt::format(" {}", corner);
    parabola += '\n';
  }
  CHECK(memory(parabola, parse_obj) < kMostMemory);
}

TEST_CASE("PLY: memory is within its multiple of the file's size", "[exhaustive]") {
  const std::string faces = "property list uint uchar vertex_indices\n";
  CHECK(memory(byte_list("element tristrips 1\n" + faces, 3), parse_ply) < kMostMemory);
  CHECK(memory(byte_list("element face 1\n" + faces, 1), parse_ply) < kMostMemory);
  const std::string count = std::to_string(kFileBytes / 4 - 100);
  CHECK(memory(repeated(ply_head("binary_big_endian", kByteVertices + "element face " + count +
                                                          "\nproperty list uchar uchar vertex_index\n") +
                            kThreeVertices,
                        {"\3\0\1\2", 4}),
               parse_ply) < kMostMemory);
  CHECK(memory(repeated(ply_head("binary_big_endian", kByteVertices + "element tristrips " + count +
                                                          "\nproperty list uchar uchar vertex_index\n") +
                            kThreeVertices,
                        {"\3\0\1\2", 4}),
               parse_ply) < kMostMemory);
  const std::string many = std::to_string(kFileBytes / 3 - 100);
  CHECK(memory(repeated(ply_head("binary_little_endian",
                                 "element vertex " + many +
                                     "\nproperty char x\nproperty char y\nproperty char z\n"
                                     "element face 1\nproperty list uchar uchar vertex_index\n"),
                        {"\3\1\2", 3}),
               parse_ply) < kMostMemory);
}

TEST_CASE("PLY: memory with attributes is within the same multiple", "[exhaustive]") {
  const auto parse_all = [](std::span<const std::byte> bytes, std::string_view name) {
    return parse_ply(bytes, name, MeshContent::kAttributes);
  };
  std::string properties;
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "red", "green", "blue", "u", "v"}) {
    properties += std::string("property uchar ") + name + "\n";
  }
  const std::string many = std::to_string(kFileBytes / 11 - 100);
  CHECK(memory(repeated(ply_head("binary_little_endian",
                                 "element vertex " + many + "\n" + properties +
                                     "element face 1\nproperty list uchar uchar vertex_index\n"),
                        {"\3\1\2\3\1\2\3\1\2\3\1", 11}),
               parse_all) < kMostMemory);
  // One vertex has a colour, and a strip of bytes many triangles.
  std::string file =
      ply_head("binary_little_endian", "element vertex 3\n" + properties +
                                           "element tristrips 1\nproperty list uint uchar vertex_indices\n");
  file += std::string(33, '\1');
  append(file, static_cast<std::uint32_t>(kFileBytes));
  for (std::size_t i = 0; i < kFileBytes; ++i) file += static_cast<char>(i % 3);
  CHECK(memory(file, parse_all) < kMostMemory);
}

TEST_CASE("OBJ: memory with attributes is within the same multiple", "[exhaustive]") {
  const auto parse_all = [](std::span<const std::byte> bytes, std::string_view name) {
    return parse_obj(bytes, name, "/nonexistent", MeshContent::kAttributes);
  };
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt\n";
  CHECK(memory(repeated(points, "f 1/1 2 3\n"), parse_all) < kMostMemory);
  CHECK(memory(repeated(points, "f 1 2 3 1\n"), parse_all) < kMostMemory);
  CHECK(memory(repeated(points + "f 1 2 3\nf", " 1"), parse_all) < kMostMemory);
  CHECK(memory(repeated(points + "f 1 2 3\n", "vn\n"), parse_all) < kMostMemory);
  CHECK(memory(repeated(points, "f 1 2 3\nusemtl\nf 1 2 3\nusemtl a\n"), parse_all) < kMostMemory);
}

TEST_CASE("glTF: memory is within its multiple of the file's size", "[exhaustive]") {
  const auto of_text = [](const std::string& file) {
    return memory(file, [](std::span<const std::byte> bytes, std::string_view name) {
      return parse_gltf(bytes, name, "/nonexistent");
    });
  };
  /// So many bytes, of the item again and again.
  const auto items = [](const std::string& item, std::size_t size = kFileBytes) {
    std::string out = item;
    while (out.size() < size) out += ',' + item;
    return out;
  };
  constexpr std::size_t kMostObjects = 6'000'000;  // bytes, within the limit of values
  const std::string cube = cube_gltf().dump();
  const auto with = [&](const std::string& key, const std::string& value) {
    return cube.substr(0, cube.size() - 1) + ",\"" + key + "\":[" + value + "]}";
  };
  CHECK(of_text(with("extras", items("{}", kMostObjects))) < kMostMemory);
  CHECK(of_text(with("extras", items("\"\""))) < kMostMemory);
  CHECK(of_text(with("extras", items("{\"\":0}"))) < kMostMemory);
  CHECK(of_text(with("extras", items("0"))) < kMostMemory);
  std::string nodes = cube;
  nodes.insert(nodes.find("{\"mesh\":0}") + 10, "," + items("{}", kMostObjects));
  CHECK(of_text(nodes) < kMostMemory);
  CHECK(of_text(with("skins", "{\"joints\":[" + items("0") + "]}")) < kMostMemory);
  std::string morphed = cube;
  morphed.insert(morphed.find("\"indices\":1"), "\"targets\":[" + items("{}", kMostObjects) + "],");
  CHECK(of_text(morphed) < kMostMemory);

  nlohmann::json json = cube_gltf();
  // Three bytes a position, one an index: a strip through all of them.
  std::string data;
  while (data.size() < kFileBytes / 2) data += std::string("\0\0\0\1\0\0\0\1\0", 9);
  const std::size_t positions = data.size();
  while (data.size() < kFileBytes) data += static_cast<char>(data.size() % 200);
  json["buffers"][0] = {{"byteLength", data.size()}};
  json["bufferViews"] = {{{"buffer", 0}, {"byteLength", positions}},
                         {{"buffer", 0}, {"byteOffset", positions}, {"byteLength", data.size() - positions}}};
  json["accessors"] = {
      {{"bufferView", 0}, {"componentType", 5121}, {"count", positions / 3}, {"type", "VEC3"}},
      {{"bufferView", 1}, {"componentType", 5121}, {"count", data.size() - positions}, {"type", "SCALAR"}}};
  json["meshes"][0]["primitives"][0]["mode"] = 5;
  CHECK(of_text(glb(json.dump(), data)) < kMostMemory);
  json["meshes"][0]["primitives"][0].erase("indices");
  json["accessors"][0]["count"] = data.size() / 3;
  json["bufferViews"][0]["byteLength"] = data.size();
  CHECK(of_text(glb(json.dump(), data)) < kMostMemory);

  // The same three bytes of a vertex are its position, normal, colour and texture coordinates.
  json["accessors"].push_back({{"bufferView", 0},
                               {"componentType", 5121},
                               {"count", data.size() / 3},
                               {"type", "VEC3"},
                               {"normalized", true}});
  json["accessors"].push_back(
      {{"bufferView", 0}, {"componentType", 5121}, {"count", data.size() / 3}, {"type", "VEC2"}});
  json["meshes"][0]["primitives"][0]["attributes"] = {
      {"POSITION", 0}, {"NORMAL", 0}, {"COLOR_0", 2}, {"TEXCOORD_0", 3}};
  CHECK(memory(glb(json.dump(), data), [](std::span<const std::byte> bytes, std::string_view name) {
          const Mesh mesh = parse_gltf(bytes, name, "/nonexistent", MeshContent::kAttributes);
          REQUIRE(mesh.attributes->colors.size() == mesh.positions.size());
          return mesh;
        }) < kMostMemory);
}

#endif
