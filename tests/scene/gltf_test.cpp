// Does a glTF file draw its triangles where the specification puts them? What is expected is worked out by
// hand: rectangles, whose corners and pixels are known.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>

#include "gltf_sample.hpp"

using namespace halfspace;
using namespace halfspace::test;
using nlohmann::json;

namespace {

using Texts = std::vector<std::string>;

/// Exactly these triangles, and exactly these pixels.
void check_rects(const GltfSample& sample, const std::vector<Rect>& rects) {
  const Mesh mesh = sample.read();
  CHECK(drawn(mesh) == corners_of(rects));
  CHECK(picture(mesh) == picture_of(rects));
}

/// The same where rotations are rounded.
void check_nearly(const GltfSample& sample, const std::vector<glm::dvec3>& expected) {
  const std::vector<glm::dvec3> corners = drawn(sample.read());
  REQUIRE(corners.size() == expected.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    INFO(i);
    CHECK(glm::distance(corners[i], expected[i]) < 1e-12);
  }
}

constexpr double kHalfTurn = 0.70710678118654752;  // the sine of half a quarter turn

/// `width` numbers for each of four vertices.
template <typename Number>
std::vector<Number> four_times(std::vector<Number> numbers) {
  std::vector<Number> out;
  for (int i = 0; i < 4; ++i) out.insert(out.end(), numbers.begin(), numbers.end());
  return out;
}

std::vector<float> translation_matrix(float x, float y, float z) {
  return {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, z, 1};
}

}  // namespace

TEST_CASE("glTF sample: the square itself") { check_rects(quad_sample(), {{-1, -1, 1, 1}}); }

TEST_CASE("glTF: sparse accessors replace elements, with and without a view below") {
  const auto add_sparse = [](GltfSample& sample, int indices, int type) {
    const int values = sample.add_view(std::vector<float>{2, -2, 0, -2, 2, 0});
    return json{{"sparse",
                 {{"count", 2},
                  {"indices", {{"bufferView", indices}, {"componentType", type}}},
                  {"values", {{"bufferView", values}}}}}};
  };
  GltfSample sample = quad_sample();
  json sparse;
  SECTION("8 bits") { sparse = add_sparse(sample, sample.add_view(std::vector<std::uint8_t>{1, 3}), 5121); }
  SECTION("16 bits") { sparse = add_sparse(sample, sample.add_view(std::vector<std::uint16_t>{1, 3}), 5123); }
  SECTION("32 bits") { sparse = add_sparse(sample, sample.add_view(std::vector<std::uint32_t>{1, 3}), 5125); }
  sample.attributes()["POSITION"] =
      sample.add("VEC3", std::vector<float>{-2, -2, 0, 0, 0, 0, 2, 2, 0, 0, 0, 0}, sparse);
  check_rects(sample, {{-2, -2, 2, 2}});

  sample.attributes()["POSITION"] = sample.add_bare<float>("VEC3", 4, sparse);  // the others are zeros
  const std::vector<glm::dvec3> expected{{0, 0, 0}, {2, -2, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {-2, 2, 0}};
  CHECK(drawn(sample.read()) == expected);
}

TEST_CASE("glTF: indices may be sparse, of any size, or missing") {
  GltfSample sample = quad_sample();
  SECTION("8 bits") {
    sample.primitive()["indices"] = sample.add("SCALAR", std::vector<std::uint8_t>{0, 1, 2, 0, 2, 3});
  }
  SECTION("32 bits") {
    sample.primitive()["indices"] = sample.add("SCALAR", std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3});
  }
  SECTION("sparse, zeros below") {
    const int at = sample.add_view(std::vector<std::uint8_t>{1, 2, 4, 5});
    const int values = sample.add_view(std::vector<std::uint16_t>{1, 2, 2, 3});
    sample.primitive()["indices"] =
        sample.add_bare<std::uint16_t>("SCALAR", 6,
                                       {{"sparse",
                                         {{"count", 4},
                                          {"indices", {{"bufferView", at}, {"componentType", 5121}}},
                                          {"values", {{"bufferView", values}}}}}});
  }
  SECTION("none: a fan") {
    sample.primitive().erase("indices");
    sample.primitive()["mode"] = 6;
  }
  check_rects(sample, {{-1, -1, 1, 1}});
}

TEST_CASE("glTF: positions of any component type, as whole numbers or as fractions") {
  GltfSample sample = quad_sample();
  const json as_fraction = {{"normalized", true}};
  SECTION("doubles") {
    sample.attributes()["POSITION"] = sample.add("VEC3", quad_points<double>(-1, -1, 1, 1));
    check_rects(sample, {{-1, -1, 1, 1}});
  }
  SECTION("shorts, scaled down by the node") {
    sample.attributes()["POSITION"] = sample.add("VEC3", quad_points<std::int16_t>(-8192, -8192, 8192, 8192));
    sample.node()["scale"] = {1.0 / 4096, 1.0 / 4096, 1.0 / 4096};
    check_rects(sample, {{-2, -2, 2, 2}});
  }
  SECTION("signed fractions of 16 bits: the least number is -1 too") {
    sample.attributes()["POSITION"] =
        sample.add("VEC3", quad_points<std::int16_t>(-32768, -32767, 32767, 32767), as_fraction);
    check_rects(sample, {{-1, -1, 1, 1}});
  }
  SECTION("unsigned fractions of 16 bits") {
    sample.attributes()["POSITION"] =
        sample.add("VEC3", quad_points<std::uint16_t>(0, 0, 65535, 65535), as_fraction);
    check_rects(sample, {{0, 0, 1, 1}});
  }
  SECTION("bytes, four bytes apart") {
    const std::vector<std::int8_t> padded{-2, -1, 0, 9, 2, -1, 0, 9, 2, 1, 0, 9, -2, 1, 0, 9};
    sample.attributes()["POSITION"] = sample.add("VEC3", padded, {{"count", 4}});
    sample.root["bufferViews"].back()["byteStride"] = 4;
    check_rects(sample, {{-2, -1, 2, 1}});
  }
  SECTION("signed fractions of 8 bits: the least number is -1 too") {
    sample.attributes()["POSITION"] =
        sample.add("VEC3", quad_points<std::int8_t>(-128, -127, 127, 127), as_fraction);
    check_rects(sample, {{-1, -1, 1, 1}});
  }
  SECTION("unsigned fractions of 8 bits") {
    sample.attributes()["POSITION"] =
        sample.add("VEC3", quad_points<std::uint8_t>(0, 0, 255, 255), as_fraction);
    check_rects(sample, {{0, 0, 1, 1}});
  }
}

TEST_CASE("glTF: morph targets move positions by their weights") {
  GltfSample sample = quad_sample();
  const auto all = [](float x, float y) { return four_times<float>({x, y, 0}); };
  sample.primitive()["targets"] = {{{"POSITION", sample.add("VEC3", all(1, 1))}},
                                   {{"POSITION", sample.add("VEC3", all(0, -2))}}};
  SECTION("no weights: none") { check_rects(sample, {{-1, -1, 1, 1}}); }
  SECTION("the mesh's weights") {
    sample.root["meshes"][0]["weights"] = {1, 0};
    check_rects(sample, {{0, 0, 2, 2}});
    sample.root["meshes"][0]["weights"] = {-0.5, 0.25};
    check_rects(sample, {{-1.5, -2, 0.5, 0}});
  }
  SECTION("the node's weights instead of the mesh's") {
    sample.root["meshes"][0]["weights"] = {1, 0};
    sample.node()["weights"] = {0, 1};
    check_rects(sample, {{-1, -3, 1, -1}});
  }
  SECTION("a target without positions, and one of fractions that is sparse") {
    sample.node()["weights"] = {1, 2};
    sample.primitive()["targets"][0] = json::object();
    const int at = sample.add_view(std::vector<std::uint8_t>{2, 3});
    const int values = sample.add_view(std::vector<std::int8_t>{0, 127, 0, 0, 127, 0});
    sample.primitive()["targets"][1]["POSITION"] =
        sample.add_bare<std::int8_t>("VEC3", 4,
                                     {{"normalized", true},
                                      {"sparse",
                                       {{"count", 2},
                                        {"indices", {{"bufferView", at}, {"componentType", 5121}}},
                                        {"values", {{"bufferView", values}}}}}});
    check_rects(sample, {{-1, -1, 1, 3}});
  }
}

TEST_CASE("glTF: skins follow their joints and not the node that has the mesh") {
  GltfSample sample = quad_sample();
  sample.attributes()["JOINTS_0"] = sample.add("VEC4", four_times<std::uint8_t>({1, 0, 0, 0}));
  sample.attributes()["WEIGHTS_0"] = sample.add("VEC4", four_times<float>({1, 0, 0, 0}));
  sample.node()["skin"] = 0;
  sample.node()["translation"] = {2, 2, 0};  // not to be applied
  sample.root["nodes"].push_back({{"translation", {1, 0, 0}}, {"children", {2}}});
  sample.root["nodes"].push_back({{"translation", {-2, -2, 0}}});
  sample.root["scenes"][0]["nodes"] = {0, 1};
  sample.root["skins"] = {{{"joints", {1, 2}}}};
  SECTION("without inverse bind matrices: as if they were identities") {
    check_rects(sample, {{-2, -3, 0, -1}});
  }
  SECTION("inverse bind matrices come first") {
    std::vector<float> matrices = translation_matrix(9, 9, 9);
    for (const float f : translation_matrix(0, 1, 0)) matrices.push_back(f);
    sample.root["skins"][0]["inverseBindMatrices"] = sample.add("MAT4", matrices);
    check_rects(sample, {{-2, -2, 0, 0}});
  }
  SECTION("two joints by halves: joint 0 is at (1, 0), joint 1 at (-1, -2)") {
    sample.attributes()["JOINTS_0"] = sample.add("VEC4", four_times<std::uint16_t>({1, 0, 0, 0}));
    sample.attributes()["WEIGHTS_0"] = sample.add("VEC4", four_times<float>({0.5f, 0.5f, 0, 0}));
    check_rects(sample, {{-1, -2, 1, 0}});
  }
  SECTION("weights as fractions, of which unused ones name joints that are not there") {
    sample.attributes()["JOINTS_0"] = sample.add("VEC4", four_times<std::uint8_t>({7, 1, 9, 200}));
    sample.attributes()["WEIGHTS_0"] =
        sample.add("VEC4", four_times<std::uint8_t>({0, 255, 0, 0}), {{"normalized", true}});
    check_rects(sample, {{-2, -3, 0, -1}});
    sample.attributes()["WEIGHTS_0"] =
        sample.add("VEC4", four_times<std::uint16_t>({0, 65535, 0, 0}), {{"normalized", true}});
    check_rects(sample, {{-2, -3, 0, -1}});
  }
  SECTION("a second set of joints") {
    sample.attributes()["WEIGHTS_0"] = sample.add("VEC4", four_times<float>({0.25f, 0, 0, 0}));
    sample.attributes()["JOINTS_1"] = sample.add("VEC4", four_times<std::uint8_t>({0, 1, 0, 0}));
    sample.attributes()["WEIGHTS_1"] = sample.add("VEC4", four_times<float>({0.5f, 0.25f, 0, 0}));
    check_rects(sample, {{-1, -2, 1, 0}});
  }
  SECTION("weights that sum up to two count by halves") {
    sample.attributes()["WEIGHTS_0"] = sample.add("VEC4", four_times<float>({1, 1, 0, 0}));
    check_rects(sample, {{-1, -2, 1, 0}});
  }
  SECTION("morph targets come before joints") {
    sample.root["skins"][0]["joints"] = {1, 2};
    sample.root["nodes"][2]["scale"] = {2, 2, 1};
    sample.primitive()["targets"] = {{{"POSITION", sample.add("VEC3", four_times<float>({0.5f, 0, 0}))}}};
    sample.root["meshes"][0]["weights"] = {1};
    check_rects(sample, {{-2, -4, 2, 0}});
  }
  SECTION("a vertex of no weight is nowhere") {
    sample.attributes()["WEIGHTS_0"] =
        sample.add("VEC4", std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0});
    const Mesh mesh = sample.read();
    CHECK(mesh.indices.size() == 3);
    CHECK(mesh.left_out ==
          Texts{"faces with a vertex that is not finite (1)", "vertices that are not finite (1)"});
  }
  SECTION("instances of a skinned mesh are all where its joints are: one is drawn") {
    sample.node()["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
        sample.add("VEC3", std::vector<float>{5, 0, 0, 6, 0, 0, 7, 0, 0});
    check_rects(sample, {{-2, -3, 0, -1}});
    CHECK(sample.read().left_out == Texts{"instances of skinned meshes (2)"});
  }
  SECTION("a primitive without joints is where its node is") {
    sample.attributes().erase("JOINTS_0");
    sample.attributes().erase("WEIGHTS_0");
    check_rects(sample, {{1, 1, 3, 3}});
    CHECK(sample.read().left_out == Texts{"skins of primitives without joints (1)"});
  }
}

TEST_CASE("glTF: instances of one node") {
  GltfSample sample = quad_sample();
  sample.attributes()["POSITION"] = sample.add("VEC3", quad_points(-0.5f, -0.5f, 0.5f, 0.5f));
  json& instancing = sample.node()["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
  SECTION("moved and scaled, in the node's space, as one draw") {
    instancing["TRANSLATION"] = sample.add("VEC3", std::vector<float>{-2, 0, 0, 0, 0, 0, 2, 0, 0});
    check_rects(sample, {{-2.5, -0.5, -1.5, 0.5}, {-0.5, -0.5, 0.5, 0.5}, {1.5, -0.5, 2.5, 0.5}});
    CHECK(sample.read().parts.size() == 1);
    sample.node()["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["SCALE"] =
        sample.add("VEC3", std::vector<float>{1, 1, 1, 2, 1, 1, 1, 2, 1});
    sample.node()["translation"] = {0, 1, 0};
    check_rects(sample, {{-2.5, 0.5, -1.5, 1.5}, {-1, 0.5, 1, 1.5}, {1.5, 0, 2.5, 2}});
  }
  SECTION("turned by a quarter, as floats and as fractions") {
    std::vector<glm::dvec3> turned;
    for (const glm::dvec3& p : corners_of({{-0.5, -0.5, 0.5, 0.5}})) turned.emplace_back(-p.y, p.x, 0);
    instancing["ROTATION"] = sample.add("VEC4", std::vector<double>{0, 0, kHalfTurn, kHalfTurn});
    check_nearly(sample, turned);
    json& attributes = sample.node()["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
    attributes["ROTATION"] =
        sample.add("VEC4", std::vector<std::int8_t>{0, 0, 90, 90}, {{"normalized", true}});
    check_nearly(sample, turned);
    attributes["ROTATION"] =
        sample.add("VEC4", std::vector<std::int16_t>{0, 0, 23170, 23170}, {{"normalized", true}});
    check_nearly(sample, turned);
  }
  SECTION("as many as an attribute of the application has") {
    instancing["_ID"] = sample.add("SCALAR", std::vector<float>{7, 8});
    check_rects(sample, {{-0.5, -0.5, 0.5, 0.5}, {-0.5, -0.5, 0.5, 0.5}});
  }
  SECTION("none") {
    instancing["TRANSLATION"] = sample.add("VEC3", std::vector<float>{});
    CHECK(sample.error() ==
          "f: mesh has 0 vertices and 0 triangles; legal: 1 triangle, line or point or more");
  }
}

TEST_CASE("glTF: transforms from the node to the root, mirrored ones too, stay double") {
  GltfSample sample = quad_sample();
  sample.root["scenes"][0]["nodes"] = {1};
  sample.root["nodes"].push_back(
      {{"children", {0}}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.5, 0, 0, 1}}});
  sample.node()["scale"] = {-2, 1, 1};
  check_rects(sample, {{2.5, -1, -1.5, 1}});
  sample.node()["translation"] = {1234567.0625, 0, 0};  // in float the square would be half a unit wrong
  CHECK(sample.read().positions[0] == glm::dvec3(1234567.0625 + 2 + 0.5, -1, 0));
}

TEST_CASE("glTF: what is not drawn is said") {
  GltfSample sample = quad_sample();
  json& primitives = sample.root["meshes"][0]["primitives"];
  primitives.push_back({{"attributes", {{"_WEIGHT", 0}}}});
  primitives.push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 0}});
  primitives.push_back({{"attributes", {{"POSITION", 0}}}});  // four vertices: a triangle and one more
  sample.root["nodes"].push_back(
      {{"mesh", 0}, {"extensions", {{"KHR_node_visibility", {{"visible", false}}}}}, {"children", {2}}});
  sample.root["nodes"].push_back({{"mesh", 0}});
  sample.root["scenes"][0]["nodes"] = {0, 1};
  sample.root["extensionsUsed"] = {"KHR_materials_unlit", "KHR_node_visibility", "VENDOR_waves"};
  const Mesh mesh = sample.read();
  CHECK(mesh.left_out == Texts{"corners that make no triangle (1)",
                               "extensions \"VENDOR_waves\" that may touch geometry (1)", "hidden nodes (1)",
                               "primitives without positions (1)"});
  CHECK(mesh.indices.size() == 9 + 4);
  REQUIRE(mesh.parts.size() == 3);
  CHECK(mesh.parts[1].primitive == Primitive::kPoints);
}

TEST_CASE("glTF: required extensions that cannot touch geometry are no obstacle") {
  for (const std::string name :
       {"KHR_materials_pbrSpecularGlossiness", "KHR_texture_basisu", "EXT_texture_webp", "EXT_lights_ies",
        "MSFT_packing_occlusionRoughnessMetallic", "NV_materials_mdl", "KHR_xmp_json_ld",
        "FB_geometry_metadata", "CESIUM_primitive_outline", "MSFT_lod", "KHR_mesh_quantization",
        "KHR_animation_pointer"}) {
    GltfSample sample = quad_sample();
    sample.root["extensionsRequired"] = {name};
    sample.root["extensionsUsed"] = {name};
    INFO(name);
    CHECK(sample.error() == "no error");
    CHECK(sample.read().left_out.empty());
  }
  for (const std::string name :
       {"KHR_techniques_webgl", "AGI_articulations", "MPEG_mesh_linking", "materials"}) {
    GltfSample sample = quad_sample();
    sample.root["extensionsRequired"] = {name};
    INFO(name);
    CHECK(sample.error() == "f: extension \"" + name +
                                "\" is required; legal: EXT_mesh_gpu_instancing, EXT_meshopt_compression, "
                                "KHR_accessor_float64, KHR_draco_mesh_compression, KHR_mesh_quantization, "
                                "KHR_node_visibility, and those that cannot touch geometry");
  }
}

TEST_CASE("glTF: containers, byte order marks, and what follows the end of a GLB") {
  const GltfSample sample = quad_sample();
  const auto read = [](const std::string& bytes) { return parse_gltf(as_bytes(bytes), "f", "/nonexistent"); };
  const std::vector<glm::dvec3> expected = corners_of({{-1, -1, 1, 1}});
  CHECK(drawn(read("\xEF\xBB\xBF" + sample.text())) == expected);
  CHECK(drawn(read(sample.binary())) == expected);
  CHECK(drawn(read(sample.binary(std::string(4, '\0')))) == expected);
  const Mesh longer = read(sample.binary() + "more");
  CHECK(drawn(longer) == expected);
  CHECK(longer.left_out == Texts{"bytes behind the GLB's length (4)"});
}

TEST_CASE("glTF: data of any media type, and files by percent-encoded names") {
  const TempFolder folder;
  GltfSample sample = quad_sample();
  const auto read = [&](const std::string& uri) {
    json root = sample.root;
    root["buffers"][0] = {{"byteLength", sample.buffer.size()}, {"uri", uri}};
    return drawn(read_mesh(folder.write("a.gltf", root.dump())));
  };
  const std::vector<glm::dvec3> expected = corners_of({{-1, -1, 1, 1}});
  for (const std::string type : {"", "application/gltf-buffer", "model/x;charset=utf-8", "text/plain"}) {
    CHECK(read("data:" + type + ";base64," + base64(sample.buffer)) == expected);
    CHECK(read("DATA:" + type + ";BASE64," + base64(sample.buffer)) == expected);
  }
  std::string percent;
  for (const char c : sample.buffer) percent += fmt::format("%{:02X}", static_cast<unsigned char>(c));
  CHECK(read("data:," + percent) == expected);

  folder.write("in/my data.bin", sample.buffer + "more than is needed");
  folder.write("100%.bin", sample.buffer);
  folder.write("a%20b.bin", sample.buffer);
  folder.write("gr\xC3\xBC\xC3\x9F.bin", sample.buffer);
  for (const std::string uri :
       {"in/my data.bin", "in/my%20data.bin", "./in/../in/my%20data.bin", "100%.bin", "100%25.bin",
        "a%20b.bin", "a%2520b.bin", "gr\xC3\xBC\xC3\x9F.bin", "gr%C3%BC%c3%9f.bin"}) {
    INFO(uri);
    CHECK(read(uri) == expected);
  }
}
