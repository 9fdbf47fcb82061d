// Does load() take every kind of input, and are the shipped frames what they are said to be?
#include "halfspace/scene/load.hpp"

#include <catch2/catch.hpp>

#include "fixture.hpp"
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
