// Are attributes and materials of OBJ files read as their manual says, and images of every kind?
#include <cstdio>  // jpeglib.h needs it before

#include <jpeglib.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>
#include <vector>

#include "fixture.hpp"
#include "halfspace/scene/image.hpp"
#include "halfspace/scene/mesh_attributes.hpp"
#include "halfspace/scene/mesh_formats.hpp"

using namespace halfspace;
using namespace halfspace::test;

namespace {

Mesh shaded_obj(const std::string& text, const std::filesystem::path& folder = "/nonexistent") {
  return parse_obj(as_bytes(text), "f", folder, MeshContent::kAttributes);
}

const std::string kFourPoints = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

std::string jpeg_of(unsigned width, unsigned height, std::array<std::uint8_t, 3> color) {
  jpeg_compress_struct jpeg{};
  jpeg_error_mgr error{};
  jpeg.err = jpeg_std_error(&error);
  jpeg_create_compress(&jpeg);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&jpeg, &bytes, &size);
  jpeg.image_width = width;
  jpeg.image_height = height;
  jpeg.input_components = 3;
  jpeg.in_color_space = JCS_RGB;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, 95, TRUE);
  jpeg_start_compress(&jpeg, TRUE);
  std::vector<std::uint8_t> row;
  for (unsigned x = 0; x < width; ++x) row.insert(row.end(), color.begin(), color.end());
  std::uint8_t* data = row.data();
  for (unsigned y = 0; y < height; ++y) jpeg_write_scanlines(&jpeg, &data, 1);
  jpeg_finish_compress(&jpeg);
  jpeg_destroy_compress(&jpeg);
  std::string out(reinterpret_cast<const char*>(bytes), size);
  std::free(bytes);
  return out;
}

}  // namespace

TEST_CASE("OBJ: texture coordinates and normals of corners, which share positions") {
  const Mesh mesh = shaded_obj(kFourPoints +
                               "vt 0 0\nvt 1 0 0\nvt 0.5\nvn 0 0 1\nvn 0 2 0\n"
                               "f 1/1/1 2/2/2 3/3/1\nf 1/-1 3/-3 4\nf 1//2 2//-2 4//1\n");
  CHECK(mesh.positions.size() == 4);
  REQUIRE(mesh.attributes != nullptr);
  const MeshAttributes& all = *mesh.attributes;
  CHECK(all.uvs == std::vector<glm::vec2>{{0, 1}, {1, 1}, {0.5, 1}});  // v up there, down here
  CHECK(all.uv_of ==
        std::vector<std::uint32_t>{0, 1, 2, 2, 0, kNoAttribute, kNoAttribute, kNoAttribute, kNoAttribute});
  CHECK(all.normal_of ==
        std::vector<std::uint32_t>{0, 1, 0, kNoAttribute, kNoAttribute, kNoAttribute, 1, 0, 0});
  CHECK(all.normals[1] == glm::vec3(0, 2, 0));
  CHECK(all.vertex_of == mesh.indices);
}

TEST_CASE("OBJ: a comment behind a number ends with its line, with attributes and without") {
  // A statement whose comment ends in a backslash: were it continued, the next vertex would be part of it.
  for (const std::string statement : {"v 1 1 0 1 1 5# \\\n", "vt 0 1# \\\n", "vn 0 0 1# \\\n"}) {
    const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + statement + "v 2 2 2\nf 1 2 3\n";
    const std::size_t vertices = statement.starts_with("v ") ? 5 : 4;
    CAPTURE(statement);
    CHECK(shaded_obj(text).positions.size() == vertices);
    CHECK(parse_obj(std::as_bytes(std::span(text)), "obj").positions.size() == vertices);
  }
}

TEST_CASE("OBJ: corners of polygons keep their attributes, also of those that repeat a vertex") {
  // A square with a slit: vertices 5 and 1 occur twice, with other coordinates each time.
  const std::string text =
      kFourPoints + "v 0.5 0.5 0\nvt 0 0\nvt 1 0\nvt 2 0\nvt 3 0\nvt 4 0\nvt 5 0\nvt 6 0\n";
  for (const std::string face :
       {"f 1/1 2/2 3/3 4/4\n", "f 1/1 2/2 5/3 4/4\n", "f 1/1 2/2 3/3 4/4 1/5 5/6\n"}) {
    const Mesh plain = parse_obj(as_bytes(text + face), "f");
    const Mesh full = shaded_obj(text + face);
    CHECK(full.indices == plain.indices);
    REQUIRE(full.attributes->uv_of.size() == full.indices.size());
    // Of each corner of the face: its vertex, by its coordinate.
    std::vector<std::uint32_t> vertex_of_uv;
    for (const char c : face) {
      if (c == '/') vertex_of_uv.push_back(0);
    }
    std::size_t at = 0;
    for (std::size_t i = 0; i + 1 < face.size(); ++i) {
      if (face[i + 1] == '/') vertex_of_uv[at++] = static_cast<std::uint32_t>(face[i] - '1');
    }
    std::vector<bool> used(at);
    for (std::size_t i = 0; i < full.indices.size(); ++i) {
      const std::uint32_t uv = full.attributes->uv_of[i];
      CHECK(vertex_of_uv.at(uv) == full.indices[i]);
      used[uv] = true;
    }
    CHECK(std::count(used.begin(), used.end(), true) >= 3);
    CHECK(used[0]);
  }
}

TEST_CASE("OBJ: colours behind v, with a weight before them or not; weights alone are none") {
  const Mesh mesh = shaded_obj("v 0 0 0 1 0.5 0\nv 1 0 0 1.0 0 0 1\nv 0 1 0 2\nf 1 2 3\n");
  const auto& colors = mesh.attributes->colors;
  CHECK(colors[0].r == 1);
  CHECK(colors[0].g == Approx(0.21404114));  // 0.5 of sRGB
  CHECK(colors[1] == glm::vec4(0, 0, 1, 1));
  CHECK(std::isnan(colors[2].r));
  CHECK(shaded_obj("v 0 0 0 1\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").attributes == nullptr);
}

TEST_CASE("OBJ: corners that name what is not there go without, and are counted") {
  const Mesh mesh = shaded_obj(kFourPoints + "vt 0 0\nf 1/2 2/1 3/-2\nf 1/x 2/1/1 3/1\n");
  CHECK(mesh.attributes->uv_of ==
        std::vector<std::uint32_t>{kNoAttribute, 0, kNoAttribute, kNoAttribute, 0, 0});
  CHECK(mesh.left_out ==
        std::vector<std::string>{"corners whose texture coordinates or normal are not there (4)"});
}

TEST_CASE("OBJ: materials, their colours, images and parts") {
  const TempFolder folder;
  folder.write("a b.mtl",
               "# a library\nnewmtl red paint\n Kd 1 0 0 # not green\nnewmtl grey\r\nKd 0.5\n"
               "newmtl spectral\nKd spectral file.rfl 1\nnewmtl wood\nmap_Kd -clamp on maps\\my wood.jpg\n");
  folder.write("maps/my wood.jpg", jpeg_of(5, 3, {200, 100, 50}));
  const Mesh mesh =
      shaded_obj(kFourPoints +
                     "mtllib a b.mtl\nf 1 2 3\nusemtl red paint\nf 1 2 3\nusemtl grey\nf 1 2 3\n"
                     "usemtl wood\nf 1 2 3\nusemtl none\nf 1 2 3\nusemtl red paint\nf 1 3 4\n"
                     "usemtl spectral\nf 1 2 3\n",
                 folder.path(""));
  REQUIRE(mesh.attributes != nullptr);
  const MeshAttributes& all = *mesh.attributes;
  REQUIRE(all.material_of.size() == 7);
  CHECK(all.material_of[0] == kNoAttribute);
  CHECK(all.materials[all.material_of[1]].base_color == glm::vec4(1, 0, 0, 1));
  CHECK(all.materials[all.material_of[2]].base_color.g == Approx(0.21404114));
  const auto& texture = all.materials[all.material_of[3]].texture;
  REQUIRE(texture);
  CHECK(texture->wrap_u == Wrap::kClamp);
  const Image& image = all.images.at(texture->image);
  CHECK(image.width == 5);
  CHECK(image.height == 3);
  for (const auto& texel : image.texels) {  // JPEG loses a little
    CHECK(std::abs(texel[0] - 200) + std::abs(texel[1] - 100) + std::abs(texel[2] - 50) <= 8);
    CHECK(texel[3] == 255);
  }
  CHECK(all.material_of[4] == kNoAttribute);
  CHECK(all.material_of[5] == all.material_of[1]);
  CHECK(all.materials[all.material_of[6]].base_color == glm::vec4(1));
  CHECK(mesh.left_out == std::vector<std::string>{"materials that no library has (1)"});
}

TEST_CASE("OBJ: libraries and images outside of the folder, missing or damaged are left out") {
  const TempFolder folder;
  folder.write("out.mtl", "newmtl m\nKd 1 0 0\n");
  folder.write("in/a.mtl", "newmtl m\nmap_Kd -s 2 2 ../x.png\nnewmtl n\nmap_Kd bad.jpg\n");
  folder.write("in/b.mtl", "newmtl o\nKd 0 1 0\n");
  folder.write("x.png", "");
  folder.write("in/bad.jpg", jpeg_of(64, 64, {1, 2, 3}).substr(0, 300));
  const Mesh mesh =
      shaded_obj(kFourPoints +
                     "mtllib ../out.mtl\nmtllib a.mtl b.mtl\nusemtl m\nf 1 2 3\nusemtl n\nf 1 2 3\n"
                     "usemtl o\nf 1 2 3\n",
                 folder.path("in"));
  CHECK(mesh.attributes->images.empty());
  CHECK(mesh.attributes->materials[2].base_color == glm::vec4(0, 1, 0, 1));
  REQUIRE(mesh.left_out.size() == 4);
  CHECK(mesh.left_out[0].starts_with("images that cannot be read: JPEG is damaged: "));
  CHECK(mesh.left_out[1] ==
        "images that cannot be read: file is missing; legal: in the mesh's folder or below (1)");
  CHECK(mesh.left_out[2] == "material libraries that are missing (1)");
  CHECK(mesh.left_out[3] == "options of images of materials (1)");
}

TEST_CASE("images: sizes are checked before memory is taken") {
  const std::string jpeg = jpeg_of(100, 20, {9, 9, 9});
  CHECK(decode_image(as_bytes(jpeg), 2000).texels.size() == 2000);
  CHECK(error_of([&] { return decode_image(as_bytes(jpeg), 1999); }) ==
        "image has 100 x 20 texels; legal: 1 to 16384 on a side, 1999 in all");
  // A PNG header of 2^31 - 1 texels a side; its CRC is right.
  const std::string png("\x89PNG\r\n\x1A\n\0\0\0\rIHDR\x7F\xFF\xFF\xFF\x7F\xFF\xFF\xFF\x08\x02\0\0\0\0\0\0\0",
                        33);
  CHECK(error_of([&] { return decode_image(as_bytes(png)); }) != "no error");
  CHECK(error_of([&] { return decode_image({}); }) == "image is neither PNG nor JPEG; legal: one of them");
}
