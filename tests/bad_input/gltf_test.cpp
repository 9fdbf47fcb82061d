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

json sparse(int count, int index_view, int index_type, int value_view) {
  return {{"count", count},
          {"indices", {{"bufferView", index_view}, {"componentType", index_type}}},
          {"values", {{"bufferView", value_view}}}};
}

void add_accessor(json& j, const json& accessor) { j["accessors"].push_back(accessor); }

/// Adds a view of these bytes, in a buffer of their own.
void add_bytes(json& j, const std::string& bytes) {
  j["bufferViews"].push_back({{"buffer", j["buffers"].size()}, {"byteLength", bytes.size()}});
  j["buffers"].push_back({{"byteLength", bytes.size()}, {"uri", "data:;base64," + base64(bytes)}});
}

/// A skin of one joint; each vertex follows this one with this weight of 255.
void skin(json& j, char joint, char weight) {
  std::string joints;
  std::string weights;
  for (int i = 0; i < 8; ++i) {
    joints += std::string{joint, 0, 0, 0};
    weights += std::string{weight, 0, 0, 0};
  }
  add_bytes(j, joints);
  add_bytes(j, weights);
  add_accessor(j, {{"bufferView", 2}, {"componentType", 5121}, {"count", 8}, {"type", "VEC4"}});
  add_accessor(
      j, {{"bufferView", 3}, {"componentType", 5121}, {"count", 8}, {"type", "VEC4"}, {"normalized", true}});
  primitive(j)["attributes"].update({{"JOINTS_0", 2}, {"WEIGHTS_0", 3}});
  j["nodes"][0]["skin"] = 0;
  j["skins"] = json::array({{{"joints", json::array({0})}}});
}

void instances(json& j, const json& attributes) {
  j["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"] = {{"attributes", attributes}};
}

/// An animation of one channel, whose times are zeros and whose values are the positions.
void animate(json& j, const json& target) {
  add_accessor(j, {{"componentType", 5126}, {"count", 8}, {"type", "SCALAR"}});
  j["animations"] = json::array({{{"channels", json::array({{{"sampler", 0}, {"target", target}}})},
                                  {"samplers", json::array({{{"input", 2}, {"output", 0}}})}}});
}

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
     "f: mesh has 0 vertices and 0 triangles; legal: 1 triangle, line or point or more"},
    {[](json& j) { primitive(j)["mode"] = 7; }, "f: primitive mode is 7; legal: 0 to 6"},
    {[](json& j) { primitive(j)["material"] = 0; }, "f: material is 0; legal: 0 or more and below 0"},
    {[](json& j) {
       primitive(j)["attributes"] = {{"NORMAL", 0}};
     },
     "f: mesh has 0 vertices and 0 triangles, without primitives without positions (1); legal: 1 triangle, "
     "line or point or more"},
    {[](json& j) { primitive(j).erase("attributes"); },
     "f: mesh 0 primitives: attributes is missing; legal: an object"},
    {[](json& j) { primitive(j)["attributes"]["POSITION"] = 2; },
     "f: accessor is 2; legal: 0 or more and below 2"},
    {[](json& j) { primitive(j)["indices"] = 9; }, "f: accessor is 9; legal: 0 or more and below 2"},
    {[](json& j) { primitive(j)["attributes"]["POSITION"] = 1; },
     "f: accessor 1: as POSITION it is \"SCALAR\" of component type 5123; legal: VEC3 of 5120, 5121, 5122, "
     "5123, 5126, 5130"},
    {[](json& j) { primitive(j)["indices"] = 0; },
     "f: accessor 0: as indices it is \"VEC3\" of component type 5126; legal: SCALAR of 5121, 5123, 5125"},
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
    {[](json& j) {
       j["accessors"][0].erase("bufferView");
       primitive(j).erase("indices");
       j["accessors"][0]["count"] = 1048577;
     },
     "f: accessors without data are used for 1048577 elements, 1 times; legal: at most 1048576 in all"},
    {[](json& j) {
       j["accessors"][0].erase("bufferView");
       primitive(j).erase("indices");
       j["accessors"][0]["count"] = 18446744073709551615u;
     },
     "f: mesh has 18446744073709551615 vertices or more; legal: at most 33554432"},
    {[](json& j) {
       j["accessors"][1].erase("bufferView");
       j["accessors"][1]["count"] = 900000;
       j["nodes"].push_back({{"mesh", 0}});
       j["scenes"][0]["nodes"] = {0, 1};
     },
     "f: accessors without data are used for 900000 elements, 1 times; legal: at most 1048576 in all"},
    {[](json& j) { j["accessors"][0]["bufferView"] = 5; },
     "f: bufferView is 5; legal: 0 or more and below 2"},
    {[](json& j) { j["accessors"][0]["sparse"] = sparse(9, 1, 5123, 0); },
     "f: accessor 0 sparse: count is 9; legal: at most 8, as the accessor"},
    {[](json& j) { j["accessors"][0]["sparse"] = sparse(1, 1, 5126, 0); },
     "f: accessor 0 sparse: its indices are of component type 5126; legal: 5121, 5123, 5125"},
    {[](json& j) { j["accessors"][0]["sparse"] = sparse(4, 1, 5123, 0); },  // indices 0, 3, 2, 0
     "f: accessor 0 sparse: its index 2 is 2; legal: above the one before, below 8"},
    {[](json& j) { j["accessors"][0]["sparse"] = sparse(1, 0, 5125, 0); },  // a float as an index
     "f: accessor 0 sparse: its index 0 is 3212836864; legal: above the one before, below 8"},
    {[](json& j) { j["accessors"][0]["sparse"] = sparse(8, 1, 5123, 1); },
     "f: accessor 0 values has 8 elements from byte 0; legal: at most 6 in bufferView 1"},
    {[](json& j) {
       j["accessors"][0]["sparse"] = sparse(2, 1, 5123, 0);
       j["bufferViews"][1]["byteStride"] = 4;
     },
     "f: bufferView 1 has byteStride 4; legal: 2, without gaps"},
    {[](json& j) {
       j["accessors"][0]["sparse"] = {{"count", 1}};
     },
     "f: accessor 0 sparse: indices is missing; legal: an object"},
    {[](json& j) { j["bufferViews"][0]["buffer"] = 1; }, "f: buffer is 1; legal: 0 or more and below 1"},
    {[](json& j) { j["bufferViews"][0]["byteLength"] = 169; },
     "f: bufferView 0 is 169 bytes from 0; legal: within the 168 bytes of buffer 0"},
    {[](json& j) { j["bufferViews"][0]["byteOffset"] = 18446744073709551615u; },
     "f: bufferView 0 is 96 bytes from 18446744073709551615; legal: within the 168 bytes of buffer 0"},
    {[](json& j) { j["bufferViews"][0]["byteStride"] = 8; },
     "f: bufferView 0 has byteStride 8; legal: 12 to 252"},
    {[](json& j) {
       j["extensionsRequired"] = {"KHR_materials_unlit", "KHR_techniques_webgl"};
     },
     "f: extension \"KHR_techniques_webgl\" is required; legal: EXT_mesh_gpu_instancing, "
     "EXT_meshopt_compression, "
     "KHR_accessor_float64, KHR_draco_mesh_compression, KHR_mesh_quantization, KHR_node_visibility, and "
     "those "
     "that cannot touch geometry"},
    {[](json& j) {
       j["nodes"][0]["weights"] = {1, 2};
     },
     "f: node 0: weights has 2 numbers; legal: 0"},
    {[](json& j) {
       primitive(j)["targets"] = {{{"POSITION", 1}}, {{"NORMAL", 0}}};
       j["meshes"][0]["weights"] = {1, 1};
     },
     "f: accessor 1: as POSITION it is \"SCALAR\" of component type 5123; legal: VEC3 of 5120, 5121, 5122, "
     "5123, 5126, 5130"},
    {[](json& j) {
       add_accessor(j, {{"bufferView", 0}, {"componentType", 5126}, {"count", 7}, {"type", "VEC3"}});
       primitive(j)["targets"] = json::array({{{"POSITION", 2}}});
       j["meshes"][0]["weights"] = json::array({1});
     },
     "f: mesh 0 targets: POSITION has 7 elements; legal: 8, as the primitive's"},
    {[](json& j) {
       primitive(j)["targets"] = json::array({json::object()});
       j["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 6}});
     },
     "f: mesh 0 primitives: targets has 0 objects; legal: 1, as the mesh's first primitive"},
    {[](json& j) { skin(j, 0, 1), j["nodes"][0]["skin"] = 3; }, "f: skin is 3; legal: 0 or more and below 1"},
    {[](json& j) {
       skin(j, 0, 1), j["skins"][0]["joints"] = {0, 5};
     },
     "f: node is 5; legal: 0 or more and below 1"},
    {[](json& j) { skin(j, 1, 1); },
     "f: accessor 2: joint 0 of vertex 0 is 1; legal: below 1, the joints of the skin"},
    {[](json& j) { skin(j, 0, 1), primitive(j)["attributes"].erase("WEIGHTS_0"); },
     "f: mesh 0 primitives: one of JOINTS_0 and WEIGHTS_0 is missing; legal: both or none"},
    {[](json& j) { skin(j, 0, 1), j["accessors"][2]["count"] = 7; },
     "f: accessor 2 has 7 elements; legal: 8, as the primitive's POSITION"},
    {[](json& j) { skin(j, 0, 1), j["accessors"][3]["normalized"] = false; },
     "f: accessor 3: as WEIGHTS it is of component type 5121 and not normalized; legal: normalized, or "
     "floats"},
    {[](json& j) {
       skin(j, 0, 1);
       add_accessor(j, {{"componentType", 5126}, {"count", 0}, {"type", "MAT4"}});
       j["skins"][0]["inverseBindMatrices"] = 4;
     },
     "f: skin 0: inverseBindMatrices has 0 elements; legal: 1 or more, one for each joint"},
    {[](json& j) {
       instances(j, {{"TRANSLATION", 0}, {"SCALE", 1}});
     },
     "f: accessor 1: as SCALE it is \"SCALAR\" of component type 5123; legal: VEC3 of 5120, 5121, 5122, "
     "5123, "
     "5126, 5130"},
    {[](json& j) {
       instances(j, {{"_ID", 1}, {"TRANSLATION", 0}});
     },
     "f: node 0 EXT_mesh_gpu_instancing: \"_ID\" has 36 elements; legal: 8, as the other attributes"},
    {[](json& j) {
       j["accessors"][1]["count"] = 2000000;
       instances(j, {{"_ID", 1}});
     },
     "f: accessors without data are used for 2000000 elements, 1 times; legal: at most 1048576 in all"},
    {[](json& j) {
       animate(j, {{"node", 4}, {"path", "scale"}});
     },
     "f: node is 4; legal: 0 or more and below 1"},
    {[](json& j) {
       animate(j, {{"node", 0}, {"path", "size"}});
     },
     "f: animation 0 target: path is \"size\"; legal: \"translation\", \"rotation\", \"scale\", \"weights\""},
    {[](json& j) {
       animate(j, {{"node", 0}, {"path", "scale"}});
       j["animations"][0]["channels"][0]["sampler"] = 1;
     },
     "f: animation 0 channels: sampler is 1; legal: 0 or more and below 1"},
    {[](json& j) {
       animate(j, {{"node", 0}, {"path", "scale"}}), j["accessors"][2]["count"] = 0;
     },
     "f: animation 0 samplers: input has 0 elements; legal: 1 or more"},
    {[](json& j) {
       animate(j, {{"node", 0}, {"path", "scale"}});
       j["accessors"][2]["bufferView"] = 0;  // it begins with -1
     },
     "f: animation 0 samplers: input begins with -1; legal: 0 or more"},
    {[](json& j) {
       animate(j, {{"node", 0}, {"path", "scale"}});
       j["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
     },
     "f: node 0: it has a matrix and is animated; legal: translation, rotation and scale where it is "
     "animated"},
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
  CHECK(error_of_gltf(std::string("\0\0", 2)) == malformed);
  CHECK(error_of_gltf(cube_gltf().dump().insert(1, 1, '\0')) == "f: JSON byte 1 is zero; legal: text");
  CHECK(error_of_gltf(cube_gltf().dump() + std::string("\0{}", 3)).find("is zero; legal: text") !=
        std::string::npos);
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
  CHECK(with_word(8, 19) == "f: GLB length is 19; legal: 20 to " + size + ", the size of the file");
  CHECK(with_word(8, static_cast<std::uint32_t>(good.size()) + 1) ==
        "f: GLB length is " + std::to_string(good.size() + 1) + "; legal: 20 to " + size +
            ", the size of the file");
  const std::size_t chunk = good.size() - cube_buffer().size() - 8;  // the binary one
  CHECK(with_word(8, 24) ==
        "f: GLB JSON chunk has " + std::to_string(chunk - 20) + " bytes; legal: at most 4");
  CHECK(with_word(chunk, 169) == "f: GLB binary chunk has 169 bytes; legal: at most 168");
  CHECK(with_word(chunk, 167) ==
        "f: buffer 0: byteLength is 168; legal: at most 167, the bytes that there are");
  CHECK(with_word(chunk + 4, 7) == "f: buffer 0 has no uri; legal: only buffer 0 of a GLB file has none");
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
    const std::string message = error_of([&] { return read_mesh(path); });
    const std::string start = path.string() + ": buffer 0: ";
    CHECK(message.starts_with(start));
    return message.substr(start.size());
  };
  const std::string missing = " is missing; legal: a file in the glTF file's folder or below";
  for (const std::string uri : {"../secret.bin", "x/../../secret.bin", "none.bin", "", "."}) {
    CHECK(error(uri) == "its file \"" + uri + "\"" + missing);
  }
  CHECK(error("%2E%2E/secret.bin") == "its file \"../secret.bin\"" + missing);
  CHECK(error("no%20such.bin") == "its file \"no such.bin\"" + missing);
  CHECK(error(folder.path("secret.bin").string()).ends_with(missing));
  CHECK(error("short.bin%00x").ends_with(missing));
  for (const std::string uri : {"https://example.org/a.bin", "file:///etc/passwd"}) {
    CHECK(error(uri) == "uri is \"" + uri + "\"; legal: data, or a file in the glTF file's folder or below");
  }
  CHECK(error("short.bin") == "byteLength is 168; legal: at most 4, the bytes that there are");
  CHECK(error("data:application/octet-stream;base64,AAAA") ==
        "byteLength is 168; legal: at most 3, the bytes that there are");
  for (const std::string uri : {"data:base64", "data:;base64,AAA!", "data:;base64,A"}) {
    CHECK(error(uri) == "its data URI is damaged; legal: a comma, and base64 behind it where it says so");
  }
}

TEST_CASE("images that are not there, or are nonsense, touch no triangle") {
  for (const char* const image : {R"({"bufferView": 2, "mimeType": "image/png"})", R"({"bufferView": "x"})",
                                  R"({"uri": "none.png"})"}) {
    json j = cube_gltf();
    j["images"] = json::array({json::parse(image)});
    CHECK(error_of_gltf(j.dump()) == "no error");
  }
}
