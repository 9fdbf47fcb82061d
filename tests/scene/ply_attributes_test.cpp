// Are colours, normals and texture coordinates of PLY files read, with their types' ranges?
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "fixture.hpp"
#include "halfspace/scene/mesh_attributes.hpp"
#include "halfspace/scene/mesh_formats.hpp"

using namespace halfspace;
using namespace halfspace::test;

namespace {

/// An ascii PLY file of one triangle, whose vertices have these properties and values beside x, y and z.
Mesh ply_with(const std::string& properties, const std::array<std::string, 3>& values) {
  std::string text = "ply\nformat ascii 1.0\nelement vertex 3\n" + properties +
                     "property float x\nproperty float y\nproperty float z\n"
                     "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  text += values[0] + " 0 0 0\n" + values[1] + " 1 0 0\n" + values[2] + " 0 1 0\n3 0 1 2\n";
  return parse_ply(as_bytes(text), "f", MeshContent::kAttributes);
}

}  // namespace

TEST_CASE("PLY: bytes of colour are what sRGB stores, and become light") {
  const Mesh mesh = ply_with("property uchar red\nproperty uchar green\nproperty uchar blue\n",
                             {"0 255 10", "128 0 0", "188 64 255"});
  REQUIRE(mesh.attributes != nullptr);
  const auto& colors = mesh.attributes->colors;
  REQUIRE(colors.size() == 3);
  // IEC 61966-2-1: c / 12.92 up to 0.04045, ((c + 0.055) / 1.055)^2.4 above
  CHECK(colors[0].g == Approx(1));
  CHECK(colors[0].b == Approx(10 / 255.0 / 12.92));
  CHECK(colors[1].r == Approx(std::pow((128 / 255.0 + 0.055) / 1.055, 2.4)));
  CHECK(colors[2].r == Approx(std::pow((188 / 255.0 + 0.055) / 1.055, 2.4)));
  CHECK(colors[0].a == 1);
  CHECK(mesh.attributes->uvs.empty());
  CHECK(mesh.attributes->normals.empty());
  CHECK(mesh.attributes->vertex_of == mesh.indices);
}

TEST_CASE("PLY: colours of other types, alpha, and values out of range") {
  const Mesh shorts =
      ply_with("property ushort red\nproperty ushort green\nproperty ushort blue\nproperty ushort alpha\n",
               {"65535 0 0 65535", "0 65535 0 0", "0 0 65535 13107"});
  CHECK(shorts.attributes->colors[0] == glm::vec4(1, 0, 0, 1));
  CHECK(shorts.attributes->colors[1] == glm::vec4(0, 1, 0, 0));
  CHECK(shorts.attributes->colors[2].a == Approx(0.2));
  const Mesh floats = ply_with("property float red\nproperty float green\nproperty float blue\n",
                               {"1 0 0.5", "2 -1 0", "nan 0 0"});
  CHECK(floats.attributes->colors[0].b == Approx(0.21404114));  // 0.5 of sRGB
  CHECK(floats.attributes->colors[1] == glm::vec4(1, 0, 0, 1));
  CHECK(std::isnan(floats.attributes->colors[2].r));  // none
}

TEST_CASE("PLY: normals and texture coordinates under all their names") {
  for (const char* names : {"property float u\nproperty float v\n", "property float s\nproperty float t\n",
                            "property double texture_u\nproperty double texture_v\n"}) {
    const Mesh mesh =
        ply_with(std::string("property float nx\nproperty float ny\nproperty float nz\n") + names,
                 {"0 0 1 0 0", "0 1 0 0.25 0.75", "-1 0 0 1.5 -1"});
    CHECK(mesh.attributes->normals[1] == glm::vec3(0, 1, 0));
    CHECK(mesh.attributes->normals[2] == glm::vec3(-1, 0, 0));
    CHECK(mesh.attributes->uvs[0] == glm::vec2(0, 1));  // v goes up in the file, down in an image
    CHECK(mesh.attributes->uvs[1] == glm::vec2(0.25, 0.25));
    CHECK(mesh.attributes->uvs[2] == glm::vec2(1.5, 2));
  }
}

TEST_CASE("PLY: half a colour, normal or coordinate is none; so is a list of that name") {
  CHECK(ply_with("property uchar red\nproperty float nx\nproperty float u\n", {"1 2 3", "1 2 3", "1 2 3"})
            .attributes == nullptr);
  CHECK(ply_with("property list uchar uchar red\nproperty uchar green\nproperty uchar blue\n",
                 {"1 7 1 2", "1 7 1 2", "0 1 2"})
            .attributes == nullptr);
}

TEST_CASE("PLY: geometry is the same, and attributes are absent, where none are asked for") {
  std::string text =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty uchar red\n"
      "property uchar green\nproperty uchar blue\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const auto vertex = [&](float x, float y, float z) {
    append(text, x);
    text += "\x01\xFF\x80";
    append(text, y);
    append(text, z);
  };
  vertex(0, 0, 0);
  vertex(2, 0, 0);
  vertex(0, 3, 4);
  text += '\x03';
  for (const std::int32_t corner : {0, 1, 2}) append(text, corner);
  const Mesh plain = parse_ply(as_bytes(text), "f");
  const Mesh full = parse_ply(as_bytes(text), "f", MeshContent::kAttributes);
  CHECK(plain.attributes == nullptr);
  REQUIRE(full.attributes != nullptr);
  CHECK(full.positions == plain.positions);
  CHECK(full.indices == plain.indices);
  CHECK(full.attributes->colors[2].g == 1);
  CHECK(full.attributes->colors[2].r == Approx(1 / 255.0 / 12.92));
}
