// Are files that are not there, not readable or not of a known kind refused, by name?
#include <catch2/catch.hpp>

#include "../scene/fixture.hpp"
#include "halfspace/scene/byte_source.hpp"
#include "halfspace/scene/load.hpp"
#include "halfspace/scene/mesh.hpp"

using namespace halfspace;
using namespace halfspace::test;

TEST_CASE("a file that is missing, a folder or empty is refused") {
  const TempFolder folder;
  for (const std::string name : {"a.ptf", "a.ptf.xz", "a.obj", "a.ply", "a.gltf", "a.glb"}) {
    const std::string path = folder.path(name).string();
    CHECK(error_of([&] { return load(path); }) ==
          path + ": cannot be read (No such file or directory); legal: a readable file");
    std::filesystem::create_directory(path);
    CHECK(error_of([&] { return load(path); }) ==
          path + ": cannot be read (it is a directory); legal: a readable file");
    std::filesystem::remove(path);
    folder.write(name, "");
    CHECK(error_of([&] { return load(path); }).starts_with(path + ": "));
  }
}

TEST_CASE("an unknown extension is refused with the known ones") {
  const std::string legal =
      "legal: .ptf, .obj, .ply, .gltf, .glb, each also with .gz or .xz, or synthetic:NAME";
  CHECK(error_of([] { return load("a.stl"); }) == "a.stl: extension is \".stl\"; " + legal);
  CHECK(error_of([] { return load("a.v2.STL.xz"); }) == "a.v2.STL.xz: extension is \".STL.xz\"; " + legal);
  CHECK(error_of([] { return load("b/a.gz"); }) == "b/a.gz: extension is \".gz\"; " + legal);
  CHECK(error_of([] { return load("a.ptf/a"); }) == "a.ptf/a: extension is \"\"; " + legal);
  CHECK(error_of([] { return load("a.ptf.gz.xz"); }) == "a.ptf.gz.xz: extension is \".gz.xz\"; " + legal);
  CHECK(error_of([] { return load(""); }) == ": extension is \"\"; " + legal);
  CHECK(error_of([] { return read_mesh("a.ptf"); }) ==
        "a.ptf: extension is \".ptf\"; legal: .obj, .ply, .gltf, .glb, each also with .gz or .xz");
}

TEST_CASE("an error stays on one line whatever the file is called") {
  CHECK(error_of([] { return load("a\nb\x1B.ptf"); }) ==
        "a?b?.ptf: cannot be read (No such file or directory); legal: a readable file");
}

TEST_CASE("a file above the limit is refused") {
  const TempFolder folder;
  const auto path = folder.write("a", "12345");
  CHECK(read_bytes(path, 5).size() == 5);
  CHECK(error_of([&] { return read_bytes(path, 4); }) ==
        path.string() + ": has more than 4 bytes; legal: at most 4 bytes");
  CHECK(error_of([] { return read_bytes("/dev/zero", 1 << 20); }) ==
        "/dev/zero: has more than 1048576 bytes; legal: at most 1048576 bytes");
}

TEST_CASE("a file that cannot be read is refused") {
  // It opens, for root too, and its first byte is no mapped address.
  const std::string path = "/proc/self/mem";
  CHECK(error_of([&] { return read_bytes(path); }) ==
        path + ": cannot be read (Input/output error); legal: a readable file");
}
