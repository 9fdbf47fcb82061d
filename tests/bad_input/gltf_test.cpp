// Are glTF files that contradict themselves refused with the object, the value and what is legal?
#include <catch2/catch.hpp>
#include <functional>

#include "../scene/fixture.hpp"
#include "halfspace/scene/mesh.hpp"
#include "halfspace/scene/mesh_formats.hpp"

using namespace halfspace;
using namespace halfspace::test;
using nlohmann::json;

namespace {

struct GltfRule {
  std::function<void(json&)> change;
  std::string error;
};

json& primitive(json& j) { return j["meshes"][0]["primitives"][0]; }

const GltfRule kGltfRules[] = {
    {[](json& j) { j.erase("asset"); }, "f: glTF has no asset; legal: an object with a version"},
    {[](json& j) { j["asset"] = json::object(); }, "f: asset.version is missing; legal: \"2.0\""},
    {[](json& j) { j["asset"]["version"] = "1.0"; }, "f: asset.version is \"1.0\"; legal: \"2.0\""},
    {[](json& j) { j["buffers"] = 3; }, "f: buffers is not a list; legal: a list of objects"},
    {[](json& j) { j["buffers"][0] = 3; }, "f: buffer 0 is not an object; legal: a list of objects"},
    {[](json& j) { j["buffers"][0].erase("uri"); },
     "f: buffer 0 has no uri; legal: only buffer 0 of a GLB file has none"},
    {[](json& j) { j["scene"] = 7; }, "f: scene is 7; legal: 0 or more and below 1"},
    {[](json& j) { j["scenes"][0]["nodes"] = {1}; }, "f: node is 1; legal: 0 or more and below 1"},
    {[](json& j) { j["nodes"][0]["children"] = {-3}; }, "f: node is -3; legal: 0 or more and below 1"},
    {[](json& j) { j["nodes"][0]["children"] = {0}; },
     "f: node 0 is reached twice; legal: each node has one parent and is in no cycle"},
    {[](json& j) {
       j["nodes"] =
           json::parse(R"([{"children": [1, 2]}, {"children": [3]}, {"children": [3]}, {"mesh": 0}])");
     },
     "f: node 3 is reached twice; legal: each node has one parent and is in no cycle"},
    {[](json& j) {
       j["nodes"][0]["matrix"] = {1, 2, 3};
     },
     "f: node 0: matrix has 3 numbers; legal: 16"},
    {[](json& j) {
       j["nodes"][0]["rotation"] = {1, 2, 3};
     },
     "f: node 0: rotation has 3 numbers; legal: 4"},
    {[](json& j) { j["nodes"][0]["translation"] = {1}; }, "f: node 0: translation has 1 numbers; legal: 3"},
    {[](json& j) {
       j["nodes"][0]["scale"] = {1, 2, 3, 4};
     },
     "f: node 0: scale has 4 numbers; legal: 3"},
    {[](json& j) { j["nodes"][0]["mesh"] = 1; }, "f: mesh is 1; legal: 0 or more and below 1"},
    {[](json& j) { j["nodes"][0].erase("mesh"); },
     "f: mesh has 0 vertices and 0 triangles; legal: 1 triangle or more"},
    {[](json& j) { primitive(j)["mode"] = 1; },
     "f: mesh has 0 vertices and 0 triangles, without 1 primitives of points or lines; legal: 1 triangle or "
     "more"},
    {[](json& j) { primitive(j)["mode"] = 7; }, "f: primitive mode is 7; legal: 0 to 6"},
    {[](json& j) { primitive(j)["material"] = 0; }, "f: material is 0; legal: 0 or more and below 0"},
    {[](json& j) {
       primitive(j)["attributes"] = {{"NORMAL", 0}};
     },
     "f: a primitive has no POSITION; legal: one in each"},
    {[](json& j) { primitive(j)["attributes"]["POSITION"] = 2; },
     "f: accessor is 2; legal: 0 or more and below 2"},
    {[](json& j) { primitive(j)["indices"] = 9; },
     "f: not read as glTF (\"primitive indices accessor out of bounds\"); legal: a sound glTF 2 file"},
    {[](json& j) { primitive(j)["attributes"]["POSITION"] = 1; },
     "f: accessor 1 of POSITION has type 65 of component 5123; legal: 3 (VEC3) of 5126 (float)"},
    {[](json& j) { primitive(j)["indices"] = 0; },
     "f: accessor 0 of indices has type 3 of component 5126; legal: 65 (SCALAR) of 5121, 5123 or 5125"},
    {[](json& j) { j["accessors"][1]["count"] = 35; },
     "f: a triangle list has 35 corners; legal: a multiple of 3"},
    {[](json& j) { j["accessors"][1]["count"] = 39; },
     "f: accessor 1 has 39 elements from byte 0; legal: at most 36 in bufferView 1"},
    {[](json& j) { j["accessors"][0]["count"] = 18446744073709551615u; },
     "f: accessor 0 has 18446744073709551615 elements from byte 0; legal: at most 8 in bufferView 0"},
    {[](json& j) { j["accessors"][0]["byteOffset"] = 12; },
     "f: accessor 0 has 8 elements from byte 12; legal: at most 7 in bufferView 0"},
    {[](json& j) { j["accessors"][0]["byteOffset"] = 18446744073709551615u; },
     "f: accessor 0 has 8 elements from byte 18446744073709551615; legal: at most 0 in bufferView 0"},
    {[](json& j) { j["accessors"][0]["count"] = 7; },
     "f: accessor 1: index 11 is 7; legal: below 7, the number of positions"},
    {[](json& j) { j["accessors"][0].erase("bufferView"); },
     "f: bufferView is -1; legal: 0 or more and below 2"},
    {[](json& j) { j["accessors"][0]["bufferView"] = 5; },
     "f: bufferView is 5; legal: 0 or more and below 2"},
    {[](json& j) {
       j["accessors"][0]["sparse"] =
           json::parse(R"({"count": 1, "indices": {"bufferView": 1, "componentType": 5123},
                                                     "values": {"bufferView": 0}})");
     },
     "f: accessor 0 is sparse; legal: accessors without sparse"},
    {[](json& j) { j["bufferViews"][0]["buffer"] = 1; }, "f: buffer is 1; legal: 0 or more and below 1"},
    {[](json& j) { j["bufferViews"][0]["byteLength"] = 169; },
     "f: bufferView 0 is 169 bytes from 0; legal: within the 168 bytes of buffer 0"},
    {[](json& j) { j["bufferViews"][0]["byteOffset"] = 18446744073709551615u; },
     "f: bufferView 0 is 96 bytes from 18446744073709551615; legal: within the 168 bytes of buffer 0"},
    {[](json& j) { j["bufferViews"][0]["byteStride"] = 8; },
     "f: bufferView 0 has byteStride 8; legal: 12 to 252"},
    {[](json& j) {
       j["extensionsRequired"] = {"KHR_materials_unlit", "KHR_draco_mesh_compression"};
     },
     "f: extension \"KHR_draco_mesh_compression\" is required; legal: only extensions of materials and "
     "textures"},
    {[](json& j) { j["images"] = json::parse(R"([{"bufferView": 2, "mimeType": "image/png"}])"); },
     "f: image 0 has bufferView \"2\"; legal: one that starts within its buffer"},
    {[](json& j) { j["images"] = json::parse(R"([{"bufferView": "x", "mimeType": "image/png"}])"); },
     "f: image 0 has bufferView \"\"x\"\"; legal: one that starts within its buffer"},
    {[](json& j) {
       j["images"] = json::parse(R"([{"bufferView": 2, "mimeType": "image/png"}])");
       j["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 168}, {"byteLength", 0}});
     },
     "f: image 0 has bufferView \"2\"; legal: one that starts within its buffer"},
    {[](json& j) { primitive(j)["extensions"]["KHR_draco_mesh_compression"] = json::object(); },
     "f: extension \"KHR_draco_mesh_compression\" is used; legal: uncompressed primitives"},
    {[](json& j) { j["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = json::object(); },
     "f: extension \"EXT_meshopt_compression\" is used; legal: uncompressed buffer views"},
};

std::string error_of_gltf(const std::string& text) {
  return error_of([&] { return parse_gltf(as_bytes(text), "f", "/nonexistent"); });
}

}  // namespace

TEST_CASE("glTF files that contradict themselves are refused") {
  CHECK(error_of_gltf(cube_gltf().dump()) == "no error");
  for (const GltfRule& rule : kGltfRules) {
    json j = cube_gltf();
    rule.change(j);
    INFO(rule.error);
    CHECK(error_of_gltf(j.dump()) == rule.error);
  }
}

TEST_CASE("what is not JSON, or deep or large beyond reason, is refused before it is built") {
  const std::string malformed = "f: JSON is malformed or not an object; legal: a glTF 2 file";
  CHECK(error_of_gltf("") == malformed);
  CHECK(error_of_gltf("[]") == malformed);
  CHECK(error_of_gltf("{\"asset\": ") == malformed);
  CHECK(error_of_gltf("{\"a\": 1e999}") == malformed);
  CHECK(error_of_gltf(std::string(1000000, '[')) ==
        "f: JSON is nested 65 deep at byte 64; legal: at most 64");
  CHECK(error_of_gltf("[" + std::string(5000000, ',')) ==
        "f: JSON has 4194305 values or more at byte 4194304; legal: at most 4194304");
  json deep = cube_gltf();
  json* at = &deep["nodes"][0]["extras"];
  for (int i = 0; i < 100; ++i) at = &(*at)["a"];
  CHECK(error_of_gltf(deep.dump()).find("JSON is nested 65 deep") != std::string::npos);
}

TEST_CASE("wrong types anywhere in glTF are refused or passed over, never more") {
  const json good = cube_gltf();
  const json flat = good.flatten();
  for (const auto& [pointer, value] : flat.items()) {
    for (const json& wrong :
         {json(), json(-1), json(1e300), json("x"), json::array(), json::object(), json(true)}) {
      json j = good;
      j[json::json_pointer(pointer)] = wrong;
      INFO(pointer << " = " << wrong);
      CHECK_NOTHROW(error_of_gltf(j.dump()));
    }
  }
}

TEST_CASE("damaged GLB containers are refused") {
  json j = cube_gltf();
  j["buffers"][0].erase("uri");
  const std::string good = glb(j.dump(), cube_buffer());
  const auto with_word = [&](std::size_t at, std::uint32_t value) {
    std::string bytes = good;
    std::memcpy(bytes.data() + at, &value, 4);
    return error_of_gltf(bytes);
  };
  const std::string size = std::to_string(good.size());
  CHECK(error_of_gltf(good) == "no error");
  CHECK(error_of_gltf("glTF") == "f: GLB has 4 bytes; legal: 20 or more");
  CHECK(with_word(4, 1) == "f: GLB version is 1; legal: 2");
  CHECK(with_word(8, 24) == "f: GLB length is 24; legal: " + size + ", the size of the file");
  CHECK(with_word(12, 0xFFFFFFFF) ==
        "f: GLB JSON chunk has 4294967295 bytes; legal: at most " + std::to_string(good.size() - 20));
  CHECK(with_word(16, 0) == "f: GLB's first chunk is of type 0x0; legal: 0x4e4f534a (JSON)");
  for (std::size_t cut = 0; cut < good.size(); ++cut) {
    INFO(cut);
    CHECK(error_of_gltf(good.substr(0, cut)) != "no error");
  }
  for (std::size_t at = 0; at < good.size(); ++at) {
    std::string damaged = good;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x15);
    INFO(at);
    CHECK_NOTHROW(error_of_gltf(damaged));
  }
}

TEST_CASE("buffers are only read from the folder of the file, and must have the size they are said to have") {
  const TempFolder folder;
  folder.write("secret.bin", cube_buffer());
  folder.write("in/short.bin", "1234");
  const auto error = [&](const std::string& uri) {
    json j = cube_gltf();
    j["buffers"][0]["uri"] = uri;
    const auto path = folder.write("in/a.gltf", j.dump());
    std::string message = error_of([&] { return read_mesh(path); });
    CHECK(message.starts_with(path.string() + ": not read as glTF ("));
    return message;
  };
  for (const std::string uri :
       {"../secret.bin", "x/../../secret.bin", "%2E%2E/secret.bin", "none.bin", "", "."}) {
    CHECK(error(uri).ends_with("; legal: a sound glTF 2 file"));
  }
  CHECK(error(folder.path("secret.bin").string()).find("not found") != std::string::npos);
  CHECK(error("short.bin").find("size mismatch") != std::string::npos);
  CHECK(error("data:application/octet-stream;base64,AAAA").find("decode") != std::string::npos);
}
