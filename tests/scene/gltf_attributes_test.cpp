// Are attributes and materials of glTF files read as the specification says?
#include <png.h>

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "gltf_sample.hpp"
#include "halfspace/scene/image.hpp"
#include "halfspace/scene/mesh_attributes.hpp"

using namespace halfspace;
using namespace halfspace::test;

namespace {

using Texels = std::vector<std::array<std::uint8_t, 4>>;

/// A PNG file of two texels side by side: red, and half-transparent blue.
const Texels kTwoTexels{{255, 0, 0, 255}, {0, 0, 200, 128}};
std::string png_of(std::uint32_t width, std::uint32_t height, const Texels& texels) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = width;
  png.height = height;
  png.format = PNG_FORMAT_RGBA;
  png_alloc_size_t size = 0;
  REQUIRE(png_image_write_to_memory(&png, nullptr, &size, 0, texels.data(), 0, nullptr) != 0);
  std::string out(size, '\0');
  REQUIRE(png_image_write_to_memory(&png, out.data(), &size, 0, texels.data(), 0, nullptr) != 0);
  return out;
}

Mesh shaded_mesh(const GltfSample& sample, const std::filesystem::path& folder = "/nonexistent") {
  return parse_gltf(as_bytes(sample.text()), "f", folder, MeshContent::kAttributes);
}

/// The square with coordinates (0, 0), (1, 0), (1, 1), (0, 1) under this name, and a material.
GltfSample textured_sample(const std::string& set = "TEXCOORD_0") {
  GltfSample sample = quad_sample();
  sample.attributes()[set] = sample.add<float>("VEC2", {0, 0, 1, 0, 1, 1, 0, 1});
  sample.root["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  sample.root["textures"] = {{{"source", 0}}};
  sample.root["images"] = {{{"uri", "data:image/png;base64," + base64(png_of(2, 1, kTwoTexels))}}};
  sample.primitive()["material"] = 0;
  return sample;
}

nlohmann::json& texture_info(GltfSample& sample) {
  return sample.root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
}

void check_near(glm::vec3 found, glm::dvec3 wanted) {
  CAPTURE(found.x, found.y, found.z, wanted.x, wanted.y, wanted.z);
  for (int i = 0; i < 3; ++i) CHECK(found[i] == Approx(wanted[i]).margin(1e-6));
}

}  // namespace

TEST_CASE("glTF: colours of all types are light, with and without alpha") {
  GltfSample sample = quad_sample();
  sample.attributes()["COLOR_0"] = sample.add<float>("VEC3", {1, 0, 0, 0, 0.5, 0, 0, 0, 0.25, 1, 1, 1});
  Mesh mesh = shaded_mesh(sample);
  REQUIRE(mesh.attributes != nullptr);
  CHECK(mesh.attributes->colors[1] == glm::vec4(0, 0.5, 0, 1));
  CHECK(mesh.attributes->colors.size() == mesh.positions.size());
  sample.attributes()["COLOR_0"] = sample.add<std::uint8_t>(
      "VEC4", {255, 0, 0, 51, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 102, 255}, {{"normalized", true}});
  mesh = shaded_mesh(sample);
  CHECK(mesh.attributes->colors[0].a == Approx(0.2));
  CHECK(mesh.attributes->colors[3].b == Approx(0.4));
  sample.attributes()["COLOR_0"] =
      sample.add<std::uint16_t>("VEC3", {65535, 0, 0, 0, 13107, 0, 0, 0, 0, 0, 0, 0}, {{"normalized", true}});
  CHECK(shaded_mesh(sample).attributes->colors[1].g == Approx(0.2));
  CHECK(sample.read().attributes == nullptr);  // none are asked for
}

TEST_CASE("glTF: normals turn with their node, and stay upright where it is squeezed") {
  GltfSample sample = quad_sample();
  const float h = std::sqrt(0.5f);
  sample.attributes()["NORMAL"] = sample.add<float>("VEC3", {0, 0, 1, h, 0, h, 0, 1, 0, 1, 0, 0});
  // A quarter turn about x takes y to z and z to -y; before it x is doubled: normals are halved there.
  sample.node()["scale"] = {2, 1, 1};
  sample.node()["rotation"] = {h, 0, 0, h};
  const Mesh mesh = shaded_mesh(sample);
  const auto& normals = mesh.attributes->normals;
  check_near(normals[0], {0, -1, 0});
  check_near(normals[1], {0.5 / std::sqrt(1.25), -1 / std::sqrt(1.25), 0});
  check_near(normals[2], {0, 0, 1});
  check_near(normals[3], {1, 0, 0});
}

TEST_CASE("glTF: a node that is flat still turns its normals") {
  GltfSample sample = quad_sample();
  sample.attributes()["NORMAL"] = sample.add<float>("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
  sample.node()["scale"] = {1, 1, 0};
  check_near(shaded_mesh(sample).attributes->normals[0], {0, 0, 1});
}

TEST_CASE("glTF: morph targets, skins and instances act on normals") {
  GltfSample morphed = quad_sample();
  morphed.attributes()["NORMAL"] = morphed.add<float>("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
  morphed.primitive()["targets"] = {
      {{"NORMAL", morphed.add<float>("VEC3", {2, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0, -4})}}};
  morphed.node()["weights"] = {0.5};
  const Mesh mesh = shaded_mesh(morphed);
  check_near(mesh.attributes->normals[0], glm::dvec3(1, 0, 1) / std::sqrt(2.0));
  check_near(mesh.attributes->normals[2], glm::dvec3(0, 1, 1) / std::sqrt(2.0));
  check_near(mesh.attributes->normals[3], {0, 0, -1});

  GltfSample skinned = quad_sample();
  skinned.attributes()["NORMAL"] = skinned.add<float>("VEC3", {0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0});
  skinned.attributes()["JOINTS_0"] =
      skinned.add<std::uint8_t>("VEC4", {0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0});
  skinned.attributes()["WEIGHTS_0"] =
      skinned.add<float>("VEC4", {1, 0, 0, 0, 1, 0, 0, 0, 0.5, 0.5, 0, 0, 0, 1, 0, 0});
  skinned.root["nodes"] = nlohmann::json::parse(R"([{"mesh": 0, "skin": 0, "children": [1, 2]}, {},
      {"rotation": [0.7071067811865476, 0, 0, 0.7071067811865476]}])");
  skinned.root["skins"] = {{{"joints", {1, 2}}}};
  const Mesh of_skin = shaded_mesh(skinned);
  check_near(of_skin.attributes->normals[0], {0, 1, 0});
  check_near(of_skin.attributes->normals[1], {0, 0, 1});
  check_near(of_skin.attributes->normals[3], {0, 0, 1});
  check_near(of_skin.attributes->normals[2], glm::dvec3(0, 1, 1) / std::sqrt(2.0));

  GltfSample instanced = quad_sample();
  instanced.attributes()["NORMAL"] = instanced.add<float>("VEC3", {0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0});
  const int turns = instanced.add<float>("VEC4", {0, 0, 0, 1, std::sqrt(0.5f), 0, 0, std::sqrt(0.5f)});
  instanced.node()["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["ROTATION"] = turns;
  const Mesh of_instances = shaded_mesh(instanced);
  REQUIRE(of_instances.attributes->normals.size() == 8);
  check_near(of_instances.attributes->normals[0], {0, 1, 0});
  check_near(of_instances.attributes->normals[4], {0, 0, 1});
}

TEST_CASE("glTF: a textured material, its factor, and its sampler") {
  GltfSample sample = textured_sample();
  sample.root["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 0.25, 1, 0.75};
  sample.root["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}}};
  sample.root["textures"][0]["sampler"] = 0;
  const Mesh mesh = shaded_mesh(sample);
  REQUIRE(mesh.attributes != nullptr);
  const MeshAttributes& all = *mesh.attributes;
  REQUIRE(all.material_of == std::vector<std::uint32_t>{0});
  CHECK(all.materials[0].base_color == glm::vec4(0.5, 0.25, 1, 0.75));
  REQUIRE(all.materials[0].texture);
  CHECK(all.materials[0].texture->wrap_u == Wrap::kClamp);
  CHECK(all.materials[0].texture->wrap_v == Wrap::kMirror);
  REQUIRE(all.images.size() == 1);
  CHECK(all.images[0].width == 2);
  CHECK(all.images[0].texels == kTwoTexels);
  CHECK(all.uvs[2] == glm::vec2(1, 1));
  CHECK(mesh.left_out.empty());
}

TEST_CASE("glTF: texture coordinates of the texture's set, and of whole numbers") {
  GltfSample sample = textured_sample("TEXCOORD_1");
  texture_info(sample)["texCoord"] = 1;
  CHECK(shaded_mesh(sample).attributes->uvs[1] == glm::vec2(1, 0));
  sample.attributes()["TEXCOORD_1"] =
      sample.add<std::uint8_t>("VEC2", {0, 0, 255, 0, 255, 51, 0, 255}, {{"normalized", true}});
  CHECK(shaded_mesh(sample).attributes->uvs[2].y == Approx(0.2));
  texture_info(sample)["texCoord"] = 0;
  CHECK(shaded_mesh(sample).attributes->uvs.empty());
}

TEST_CASE("glTF: KHR_texture_transform scales, then turns counter-clockwise with v down, then moves") {
  GltfSample sample = textured_sample("TEXCOORD_3");
  texture_info(sample)["extensions"]["KHR_texture_transform"] = nlohmann::json::parse(
      R"({"offset": [10, 20], "rotation": 1.5707963267948966, "scale": [2, 3], "texCoord": 3})");
  const auto mesh = shaded_mesh(sample);
  // (1, 0) -> (2, 0) -> up, which is (0, -2); (0, 1) -> (0, 3) -> to the right, (3, 0).
  CHECK(mesh.attributes->uvs[1].x == Approx(10));
  CHECK(mesh.attributes->uvs[1].y == Approx(18));
  CHECK(mesh.attributes->uvs[3].x == Approx(13));
  CHECK(mesh.attributes->uvs[3].y == Approx(20));
}

TEST_CASE("glTF: images from a buffer view and from files in the folder, no others") {
  GltfSample sample = textured_sample();
  const int view = sample.add_bytes(png_of(2, 1, kTwoTexels));
  sample.root["images"][0] = {{"bufferView", view}, {"mimeType", "image/png"}};
  CHECK(shaded_mesh(sample).attributes->images.at(0).texels == kTwoTexels);

  const TempFolder folder;
  folder.write("textures/a b.png", png_of(2, 1, kTwoTexels));
  folder.write("model/x", "");
  sample.root["images"][0] = {{"uri", "textures/a%20b.png"}};
  CHECK(shaded_mesh(sample, folder.path("")).attributes->images.at(0).texels == kTwoTexels);
  sample.root["images"][0] = {{"uri", "../textures/a%20b.png"}};
  const Mesh outside = shaded_mesh(sample, folder.path("model"));
  CHECK(outside.attributes->images.empty());
  REQUIRE(outside.left_out.size() == 1);
  CHECK(outside.left_out[0].starts_with("images that cannot be read: "));
}

TEST_CASE("glTF: what is damaged of a material is left out and said, the mesh stays") {
  const auto left_out = [](const GltfSample& sample) {
    const Mesh mesh = shaded_mesh(sample);
    CHECK(mesh.indices.size() == 6);
    CHECK(sample.read().left_out.empty());  // nobody looks at materials
    return mesh.left_out.empty() ? std::string() : mesh.left_out[0];
  };
  GltfSample sample = textured_sample();
  sample.root["images"][0]["uri"] = "data:image/png;base64," + base64("\x89PNG\r\n\x1A\n and no more");
  CHECK(left_out(sample).starts_with("images that cannot be read: PNG is damaged: "));
  sample.root["images"][0]["uri"] = "data:image/png;base64," + base64("GIF89a");
  CHECK(left_out(sample) ==
        "images that cannot be read: image is neither PNG nor JPEG; legal: one of them (1)");
  sample.root["images"][0]["uri"] = 7;
  CHECK(left_out(sample).starts_with("images that cannot be read: "));
  sample.root["textures"][0] = {{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}};
  CHECK(left_out(sample) == "textures without a PNG or JPEG image (1)");
  for (const char* bad : {R"({"index": 9})", R"({"index": "0"})", R"({"index": 0, "texCoord": -1})",
                          R"({"index": 0, "extensions": {"KHR_texture_transform": {"scale": [1]}}})"}) {
    texture_info(sample) = nlohmann::json::parse(bad);
    CHECK(left_out(sample) == "materials that cannot be read (1)");
  }
  GltfSample colors = quad_sample();
  colors.attributes()["COLOR_0"] = 99;
  CHECK(left_out(colors) == "attributes COLOR_0 that cannot be read (1)");
  colors.attributes()["COLOR_0"] = colors.add<float>("VEC4", {1, 1, 1, 1});
  CHECK(left_out(colors) == "attributes COLOR_0 that cannot be read (1)");  // one for four vertices
}
