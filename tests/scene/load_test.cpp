// Does load() take every kind of input, and are the shipped frames what they are said to be?
#include "halfspace/scene/load.hpp"

#include <catch2/catch.hpp>

#include "fixture.hpp"
#include "halfspace/scene/byte_source.hpp"
#include "halfspace/scene/compression.hpp"
#include "halfspace/scene/ptf.hpp"
#include "halfspace/scene/validate.hpp"

using namespace halfspace;
using namespace halfspace::test;

TEST_CASE("load takes frames and meshes by extension") {
  const TempFolder folder;
  for (const std::string name : {"small.ptf", "small.ptf.gz", "small.ptf.xz"}) {
    write_ptf(small_frame(), folder.path(name));
    const Frame frame = load(folder.path(name));
    CHECK(frame.name == "small");
    CHECK(frame.commands.size() == 2);
  }
  folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  folder.write("a.gltf", cube_gltf().dump());
  folder.write(
      "a.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  Camera camera;
  camera.width = 64;
  camera.height = 32;
  for (const std::string name : {"a.obj", "a.ply", "a.gltf"}) {
    const Frame frame = load(folder.path(name), camera);
    CHECK(frame.name == "a");
    CHECK(frame.targets.at(0).width == 64);
    CHECK(frame.commands.size() == 2);
    CHECK_NOTHROW(validate(frame));
  }
}

TEST_CASE("load takes any format packed, and extensions in capitals") {
  const TempFolder folder;
  Camera camera;
  camera.width = 64;
  camera.height = 32;
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  nlohmann::json cube = cube_gltf();
  cube["buffers"] = {{{"byteLength", cube_buffer().size()}}};
  const std::string binary = glb(cube.dump(), cube_buffer());
  const std::string ptf = as_text(format_ptf(small_frame()));
  struct Format {
    std::string_view plain;
    std::string_view capitals;
    const std::string& content;
  };
  for (const Format& format : {Format{".obj", ".OBJ", obj}, Format{".ply", ".PLY", ply},
                               Format{".gltf", ".glTF", cube_gltf().dump()}, Format{".glb", ".Glb", binary},
                               Format{".ptf", ".PTF", ptf}}) {
    const Frame plain = load(folder.write("m" + std::string(format.plain), format.content), camera);
    REQUIRE(!plain.indices.empty());
    const auto check = [&](const std::string& name, std::string_view bytes) {
      CAPTURE(name);
      const Frame frame = load(folder.write(name, bytes), camera);
      CHECK(frame.name == "Model.v2");
      CHECK(frame.vertices == plain.vertices);
      CHECK(frame.indices == plain.indices);
      CHECK(frame.commands.size() == plain.commands.size());
    };
    const std::string gzip = as_text(compress_gzip(as_bytes(format.content)));
    const std::string xz = as_text(compress_xz(as_bytes(format.content)));
    for (const std::string_view extension : {format.plain, format.capitals}) {
      const std::string name = "Model.v2" + std::string(extension);
      check(name, format.content);
      check(name + ".gz", gzip);
      check(name + ".GZ", gzip);
      check(name + ".xz", xz);
      check(name + ".Xz", xz);
    }
  }
}

TEST_CASE("write_ptf packs by the extension, in capitals too") {
  const TempFolder folder;
  const auto magic = [&](const char* name) {
    write_ptf(small_frame(), folder.path(name));
    return as_text(read_raw_bytes(folder.path(name))).substr(0, 4);
  };
  CHECK(magic("f.PTF") == "PTF1");
  CHECK(magic("f.ptf.GZ").substr(0, 2) == "\x1F\x8B");  // RFC 1952, 2.3.1
  CHECK(magic("f.ptf.Xz") ==
        "\xFD"
        "7zX");  // The .xz file format, 2.1.1.1
}

TEST_CASE("the shipped frame of vkcube") {
  const Frame frame = load(std::filesystem::path(HALFSPACE_SCENES) / "vkcube.ptf.xz");
  CHECK(frame.name == "vkcube");
  REQUIRE(frame.targets.size() == 1);
  CHECK(frame.targets[0].width == 500);
  CHECK(frame.targets[0].height == 500);
  CHECK(frame.targets[0].depth_format == DepthFormat::kUnorm16);
  REQUIRE(frame.commands.size() == 2);
  CHECK(frame.commands[0].kind == CommandKind::kClear);
  CHECK(frame.commands[1].depth_func == DepthFunc::kLequal);
  CHECK(frame.commands[1].index_count == 36);
  CHECK(frame.vertices.size() == 36);
  CHECK(frame.meta.find("Apache-2.0") != std::string::npos);
}

TEST_CASE("the shipped frame of the truck") {
  const Frame frame = load(std::filesystem::path(HALFSPACE_SCENES) / "cc0_truck.ptf.xz");
  REQUIRE(frame.targets.size() == 1);
  CHECK(frame.targets[0].width == 1920);
  CHECK(frame.targets[0].height == 1080);
  CHECK(frame.targets[0].depth_format == DepthFormat::kFloat32);
  CHECK(frame.commands.size() == 53);
  CHECK(frame.vertices.size() == 60254);
  CHECK(frame.indices.size() == 3 * 117013);
  CHECK(frame.meta.find("CC0-1.0") != std::string::npos);
}
