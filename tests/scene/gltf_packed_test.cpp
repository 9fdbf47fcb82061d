// Is compressed data of glTF files unpacked to what was packed? The libraries' own encoders pack it here.
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <fmt/format.h>
#include <meshoptimizer.h>

#include <array>
#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include "gltf_sample.hpp"

using namespace halfspace;
using namespace halfspace::test;
using nlohmann::json;

namespace {

std::string as_string(const std::vector<unsigned char>& bytes) { return {bytes.begin(), bytes.end()}; }

std::string pack_vertices(const void* data, std::size_t count, std::size_t stride) {
  std::vector<unsigned char> out(meshopt_encodeVertexBufferBound(count, stride));
  out.resize(meshopt_encodeVertexBuffer(out.data(), out.size(), data, count, stride));
  return as_string(out);
}

std::string pack_triangles(const std::vector<std::uint32_t>& indices) {
  std::vector<unsigned char> out(meshopt_encodeIndexBufferBound(indices.size(), 8));
  out.resize(meshopt_encodeIndexBuffer(out.data(), out.size(), indices.data(), indices.size()));
  return as_string(out);
}

std::string pack_sequence(const std::vector<std::uint32_t>& indices) {
  std::vector<unsigned char> out(meshopt_encodeIndexSequenceBound(indices.size(), 8));
  out.resize(meshopt_encodeIndexSequence(out.data(), out.size(), indices.data(), indices.size()));
  return as_string(out);
}

/// A view that only its packed bytes stand for: its plain buffer is a placeholder.
int add_packed_view(GltfSample& sample, const std::string& packed, json extension) {
  const int view = sample.add_bytes(packed);
  json& object = sample.root["bufferViews"][view];
  extension.update({{"buffer", 0}, {"byteOffset", object["byteOffset"]}, {"byteLength", packed.size()}});
  const auto size = extension["count"].get<std::size_t>() * extension["byteStride"].get<std::size_t>();
  object = {{"buffer", 1}, {"byteLength", size}, {"extensions", {{"EXT_meshopt_compression", extension}}}};
  sample.root["buffers"][1] = {{"byteLength", 1 << 20},
                               {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}};
  return view;
}

/// The square of quad_sample(), its positions and indices packed.
GltfSample packed_square(const std::string& index_mode, std::size_t index_size) {
  GltfSample sample;
  const std::vector<float> points = quad_points(-1.0f, -1.0f, 1.0f, 1.0f);
  const int positions = add_packed_view(sample, pack_vertices(points.data(), 4, 12),
                                        {{"mode", "ATTRIBUTES"}, {"count", 4}, {"byteStride", 12}});
  const std::vector<std::uint32_t> order(kQuadIndices.begin(), kQuadIndices.end());
  const std::string packed = index_mode == "TRIANGLES" ? pack_triangles(order) : pack_sequence(order);
  const int indices =
      add_packed_view(sample, packed, {{"mode", index_mode}, {"count", 6}, {"byteStride", index_size}});
  sample.attributes()["POSITION"] = sample.add_bare<float>("VEC3", 4, {{"bufferView", positions}});
  sample.primitive()["indices"] =
      index_size == 2 ? sample.add_bare<std::uint16_t>("SCALAR", 6, {{"bufferView", indices}})
                      : sample.add_bare<std::uint32_t>("SCALAR", 6, {{"bufferView", indices}});
  sample.root["extensionsRequired"] = {"EXT_meshopt_compression"};
  return sample;
}

/// Each triangle with its least corner first, and the triangles in order: coders may turn and shuffle them.
std::vector<std::array<glm::dvec3, 3>> sorted_triangles(const std::vector<glm::dvec3>& corners) {
  const auto less = [](glm::dvec3 a, glm::dvec3 b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  };
  std::vector<std::array<glm::dvec3, 3>> out;
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    std::array<glm::dvec3, 3> t{corners[i], corners[i + 1], corners[i + 2]};
    std::rotate(t.begin(), std::min_element(t.begin(), t.end(), less), t.end());
    out.push_back(t);
  }
  std::sort(out.begin(), out.end(), [&](const auto& a, const auto& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), less);
  });
  return out;
}

/// The square as Draco data: positions are attribute 0, joints 1, weights 2.
std::string draco_square(int method, int position_bits) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(2);
  const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const int joints = builder.AddAttribute(draco::GeometryAttribute::GENERIC, 4, draco::DT_UINT8);
  const int weights = builder.AddAttribute(draco::GeometryAttribute::GENERIC, 4, draco::DT_FLOAT32);
  const std::vector<float> points = quad_points(-1.0f, -1.0f, 1.0f, 1.0f);
  const std::array<std::uint8_t, 4> joint{1, 0, 0, 0};
  const std::array<float, 4> weight{1, 0, 0, 0};
  for (std::uint32_t face = 0; face < 2; ++face) {
    const auto at = [&](std::size_t corner) { return &points[3 * kQuadIndices[3 * face + corner]]; };
    builder.SetAttributeValuesForFace(position, draco::FaceIndex(face), at(0), at(1), at(2));
    builder.SetAttributeValuesForFace(joints, draco::FaceIndex(face), joint.data(), joint.data(),
                                      joint.data());
    builder.SetAttributeValuesForFace(weights, draco::FaceIndex(face), weight.data(), weight.data(),
                                      weight.data());
  }
  const auto mesh = builder.Finalize();
  draco::Encoder encoder;
  encoder.SetEncodingMethod(method);
  if (position_bits > 0) encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, position_bits);
  draco::EncoderBuffer buffer;
  REQUIRE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
  return {buffer.data(), buffer.size()};
}

GltfSample draco_sample(const std::string& packed, const json& attributes = {{"POSITION", 0}}) {
  GltfSample sample;
  sample.attributes()["POSITION"] = sample.add_bare<float>("VEC3", 4);
  sample.primitive()["indices"] = sample.add_bare<std::uint16_t>("SCALAR", 6);
  sample.primitive()["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", sample.add_bytes(packed)},
                                                                    {"attributes", attributes}};
  sample.root["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  return sample;
}

const std::vector<Rect> kSquare{{-1, -1, 1, 1}};

}  // namespace

TEST_CASE("glTF meshopt: attributes, triangles and indices of 16 and 32 bits") {
  const std::string mode = GENERATE("TRIANGLES", "INDICES");
  const std::size_t size = GENERATE(2, 4);
  const Mesh mesh = packed_square(mode, size).read();
  CHECK(sorted_triangles(drawn(mesh)) == sorted_triangles(corners_of(kSquare)));
  CHECK(picture(mesh) == picture_of(kSquare));
  CHECK(mesh.left_out.empty());
}

TEST_CASE("glTF meshopt: the filters") {
  GltfSample sample = quad_sample();
  SECTION("exponential: floats") {
    const std::vector<float> points = quad_points(-2.0f, -0.5f, 1.5f, 1.0f);
    std::vector<std::uint32_t> filtered(points.size());
    meshopt_encodeFilterExp(filtered.data(), 4, 12, 23, points.data());
    const int view = add_packed_view(
        sample, pack_vertices(filtered.data(), 4, 12),
        {{"mode", "ATTRIBUTES"}, {"count", 4}, {"byteStride", 12}, {"filter", "EXPONENTIAL"}});
    sample.attributes()["POSITION"] = sample.add_bare<float>("VEC3", 4, {{"bufferView", view}});
    CHECK(drawn(sample.read()) == corners_of({{-2, -0.5, 1.5, 1}}));
  }
  SECTION("octahedral: directions, here as positions") {
    const std::vector<float> directions{1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0};
    std::vector<std::int8_t> filtered(16);
    meshopt_encodeFilterOct(filtered.data(), 4, 4, 8, directions.data());
    const int view =
        add_packed_view(sample, pack_vertices(filtered.data(), 4, 4),
                        {{"mode", "ATTRIBUTES"}, {"count", 4}, {"byteStride", 4}, {"filter", "OCTAHEDRAL"}});
    sample.root["bufferViews"][view]["byteStride"] = 4;
    sample.attributes()["POSITION"] =
        sample.add_bare<std::int8_t>("VEC3", 4, {{"bufferView", view}, {"normalized", true}});
    const std::vector<glm::dvec3> expected{{1, 0, 0}, {0, 1, 0},  {-1, 0, 0},
                                           {1, 0, 0}, {-1, 0, 0}, {0, -1, 0}};
    CHECK(drawn(sample.read()) == expected);
  }
  SECTION("quaternion: instances' rotations") {
    const std::vector<float> rotation{0, 0, 0.70710678f, 0.70710678f};
    std::vector<std::int16_t> filtered(4);
    meshopt_encodeFilterQuat(filtered.data(), 1, 8, 16, rotation.data());
    const int view =
        add_packed_view(sample, pack_vertices(filtered.data(), 1, 8),
                        {{"mode", "ATTRIBUTES"}, {"count", 1}, {"byteStride", 8}, {"filter", "QUATERNION"}});
    sample.node()["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["ROTATION"] =
        sample.add_bare<std::int16_t>("VEC4", 1, {{"bufferView", view}, {"normalized", true}});
    const std::vector<glm::dvec3> corners = drawn(sample.read());
    const std::vector<glm::dvec3> square = corners_of(kSquare);
    for (std::size_t i = 0; i < square.size(); ++i) {
      CHECK(glm::distance(corners.at(i), glm::dvec3(-square[i].y, square[i].x, 0)) < 1e-3);  // 16 bits
    }
  }
}

TEST_CASE("glTF meshopt: plain data is taken where it is, whatever the packed bytes are") {
  GltfSample sample = packed_square("TRIANGLES", 4);
  for (std::size_t i = 0; i < sample.buffer.size(); ++i) sample.buffer[i] = '\x55';
  std::string plain;
  for (const float f : quad_points(-1.0f, -1.0f, 1.0f, 1.0f)) append(plain, f);
  for (const std::uint16_t index : kQuadIndices) append(plain, std::uint32_t{index});
  sample.root["bufferViews"][1]["byteOffset"] = 48;
  sample.root["buffers"][1] = {{"byteLength", 72}, {"uri", "data:;base64," + base64(plain)}};
  CHECK(drawn(sample.read()) == corners_of(kSquare));
}

TEST_CASE("glTF meshopt: where the plain data's file is missing, the packed bytes are taken") {
  GltfSample sample = packed_square("TRIANGLES", 4);
  sample.root["buffers"][1]["uri"] = "fallback.bin";
  CHECK(picture(sample.read()) == picture_of(kSquare));
}

TEST_CASE("glTF meshopt: what contradicts the extension is refused") {
  const std::tuple<int, std::string, json, std::string> rules[] = {
      {0, "mode", "POINTS", R"(mode is "POINTS"; legal: "ATTRIBUTES", "TRIANGLES", "INDICES")"},
      {0, "byteStride", 10, "byteStride is 10; legal: 4 to 256, a multiple of 4"},
      {0, "byteStride", 0, "byteStride is 0; legal: 4 to 256, a multiple of 4"},
      {0, "byteStride", 260, "byteStride is 260; legal: 4 to 256, a multiple of 4"},
      {1, "byteStride", 3, "byteStride is 3; legal: 2 or 4"},
      {1, "count", 7, "count is 7; legal: a multiple of 3"},
      {0, "filter", "WAVES",
       R"(filter is "WAVES"; legal: "NONE", and with "ATTRIBUTES" "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL")"},
      {1, "filter", "EXPONENTIAL",
       R"(filter is "EXPONENTIAL"; legal: "NONE", and with "ATTRIBUTES" "OCTAHEDRAL", "QUATERNION", )"
       R"("EXPONENTIAL")"},
      {0, "filter", "OCTAHEDRAL", R"(byteStride is 12; legal with "OCTAHEDRAL": 4 or 8)"},
      {0, "filter", "QUATERNION", R"(byteStride is 12; legal with "QUATERNION": 8)"}};
  for (const auto& [view, key, value, error] : rules) {
    GltfSample sample = packed_square("TRIANGLES", 4);
    sample.root["bufferViews"][view]["extensions"]["EXT_meshopt_compression"][key] = value;
    CHECK(sample.error() == fmt::format("f: bufferView {} EXT_meshopt_compression: {}", view, error));
  }
  GltfSample sample = packed_square("TRIANGLES", 4);
  json& positions = sample.root["bufferViews"][0]["extensions"]["EXT_meshopt_compression"];
  const auto size = positions["byteLength"].get<std::size_t>();
  positions["count"] = 1 << 30;
  CHECK(sample.error() ==
        fmt::format(
            "f: bufferView 0 EXT_meshopt_compression: count is 1073741824; legal: at most {} in {} bytes",
            size * 64 / 12, size));
  positions["count"] = 290;
  CHECK(sample.error() ==
        fmt::format(
            "f: bufferView 0 EXT_meshopt_compression: its {} bytes are damaged or too few for 290 elements "
            "of 12 bytes; legal: meshopt data",
            size));
}

TEST_CASE("glTF Draco: both methods, exact and quantised, positions, joints and weights") {
  const int method = GENERATE(draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING);
  const auto expected = sorted_triangles(corners_of(kSquare));
  SECTION("exact") {
    const Mesh mesh = draco_sample(draco_square(method, 0)).read();
    CHECK(sorted_triangles(drawn(mesh)) == expected);
    CHECK(picture(mesh) == picture_of(kSquare));
  }
  SECTION("14 bits") {
    const Mesh mesh = draco_sample(draco_square(method, 14)).read();
    const auto triangles = sorted_triangles(drawn(mesh));
    REQUIRE(triangles.size() == 2);
    for (std::size_t i = 0; i < 6; ++i) {
      CHECK(glm::distance(triangles[i / 3][i % 3], expected[i / 3][i % 3]) < 1.0 / (1 << 14));
    }
  }
  SECTION("joints and weights, drawn by two nodes") {
    GltfSample sample =
        draco_sample(draco_square(method, 0), {{"POSITION", 0}, {"JOINTS_0", 1}, {"WEIGHTS_0", 2}});
    sample.attributes()["JOINTS_0"] = sample.add_bare<std::uint8_t>("VEC4", 4);
    sample.attributes()["WEIGHTS_0"] = sample.add_bare<float>("VEC4", 4);
    sample.root["nodes"].push_back({{"translation", {2, 0, 0}}, {"mesh", 0}});
    sample.node()["skin"] = 0;
    sample.root["skins"] = json::array({{{"joints", {0, 1}}}});
    sample.root["scenes"][0]["nodes"] = {0, 1};
    CHECK(picture(sample.read()) == picture_of({{1, -1, 3, 1}, {1, -1, 3, 1}}));
  }
  SECTION("plain data is taken where it is") {
    GltfSample sample = draco_sample("no Draco data at all");
    sample.attributes()["POSITION"] = sample.add("VEC3", quad_points(-1.0f, -1.0f, 1.0f, 1.0f));
    sample.primitive()["indices"] = sample.add("SCALAR", kQuadIndices);
    CHECK(drawn(sample.read()) == corners_of(kSquare));
  }
}

TEST_CASE("glTF Draco: what is not as the file says is refused") {
  const std::string good = draco_square(draco::MESH_EDGEBREAKER_ENCODING, 14);
  const std::string start = "f: mesh 0 KHR_draco_mesh_compression: ";
  CHECK(draco_sample(good).error() == "no error");
  CHECK(draco_sample("DRACO").error() == start + "its Draco data has 5 bytes; legal: 7 or more");
  CHECK(draco_sample("DRAGO\2\2").error() ==
        start + "its Draco data begins with \"DRAGO\" of version 2.2; legal: \"DRACO\" of version 2.2");
  CHECK(draco_sample("DRACO\1\3").error() ==
        start + "its Draco data begins with \"DRACO\" of version 1.3; legal: \"DRACO\" of version 2.2");
  CHECK(draco_sample(good, {{"POSITION", 7}}).error() ==
        start + "attribute 7 is not in its Draco data; legal: one that is");
  CHECK(draco_sample(good, {{"POSITION", 1}}).error() ==
        start + "attribute 1 of its Draco data has 4 components; legal: 3");
  GltfSample sample = draco_sample(good);
  sample.root["accessors"][0]["count"] = 5;
  CHECK(sample.error() == "f: accessor 0: count is 5; legal: 4, as in the compressed data");

  // Faces and vertices as varints behind 11 bytes of header and one of the traversal: vertices, then faces.
  for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
    std::string huge = draco_square(method, 14);
    const std::size_t at = method == draco::MESH_SEQUENTIAL_ENCODING ? 11 : 12;
    huge.replace(at, 2, "\xFF\xFF\xFF\x7F\xFF\xFF\xFF\x7F");
    CHECK(draco_sample(huge).error() ==
          start + fmt::format("its Draco data of {} bytes announces 268435455 faces and 268435455 vertices; "
                              "legal: at most {} together, 33554432 faces and 33554432 vertices",
                              huge.size(), 262144 + 64 * huge.size()));
  }
}

TEST_CASE("damaged Draco and meshopt data is refused or unpacked, never more") {
  std::vector<std::string> files;
  for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
    files.push_back(draco_sample(draco_square(method, 14)).binary());
  }
  files.push_back(packed_square("TRIANGLES", 4).binary());
  files.push_back(packed_square("INDICES", 2).binary());
  for (const std::string& good : files) {
    const std::size_t data = good.rfind(std::string_view("BIN\0", 4)) + 4;
    for (std::size_t at = data; at < good.size(); ++at) {
      for (const int change : {1, 0x15, 0x80, 0xFF}) {
        std::string damaged = good;
        damaged[at] = static_cast<char>(damaged[at] ^ change);
        INFO(at << " " << change);
        CHECK_NOTHROW(error_of([&] { return parse_gltf(as_bytes(damaged), "f", "/nonexistent"); }));
      }
    }
  }
}
