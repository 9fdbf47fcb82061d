// --camera: a picture from where the glTF file says.
#include <catch2/catch.hpp>

#include "../scene/gltf_sample.hpp"
#include "program.hpp"

using namespace halfspace::testing;

TEST_CASE("the program takes a camera of the file, and info lists them") {
  const Place place;
  halfspace::test::GltfSample sample = halfspace::test::quad_sample();
  sample.root["cameras"] = Json::parse(R"([{"type": "perspective", "perspective": {"yfov": 1.5707963267948966,
    "aspectRatio": 1, "znear": 1}}])");
  sample.root["nodes"].push_back(Json::parse(R"({"name": "front", "camera": 0, "translation": [0, 0, 4]})"));
  sample.root["nodes"].push_back(Json::parse(R"({"name": "left", "camera": 0, "translation": [-2, 0, 2]})"));
  sample.root["scenes"][0]["nodes"] = {0, 1, 2};
  const std::string file = (place.path / "square.gltf").string();
  std::ofstream(file) << sample.text();

  const Outcome info = place.run("info " + file);
  CHECK(info.status == 0);
  CHECK(info.out.find("camera 0: front\ncamera 1: left\n") != std::string::npos);
  CHECK(info.err.empty());

  const auto pixels = [&](const std::string& camera) {
    const std::string out = (place.path / "result").string();
    const Outcome run = place.run("run " + file + " --size 32x32 --no-pictures --out " + out + " " + camera);
    CHECK(run.status == 0);
    const std::string npy = slurp(fs::path(out) / "fragments0.npy");
    fs::remove_all(out);
    return npy;
  };
  const std::string front = pixels("--eye 0,0,4 --at 0,0,0 --fov 90");
  CHECK(pixels("--camera front") == front);
  CHECK(pixels("--camera 0") == front);
  CHECK(pixels("--camera left") == pixels("--eye -2,0,2 --at -2,0,0 --fov 90"));
  CHECK(pixels("--camera left") != front);

  const Outcome none = place.run("run " + file + " --camera back");
  CHECK(none.status == 2);
  check_error(none, {"square.gltf: camera is \"back\"; legal: 0 \"front\", 1 \"left\""});
  for (const std::string other : {"--eye 0,0,4", "--at 0,0,0", "--up 0,1,0", "--fov 60"}) {
    const Outcome both = place.run("run " + file + " --camera front " + other);
    CHECK(both.status == 2);
    check_error(both, {"--camera", other.substr(0, other.find(' ')).c_str()});
  }
}
