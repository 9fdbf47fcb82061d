// Options that mean nothing to the input, the fidelity or the job are refused, not passed over.
#include <catch2/catch.hpp>
#include <fstream>

#include "halfspace/scene/load.hpp"
#include "halfspace/scene/ptf.hpp"
#include "program.hpp"

using namespace halfspace::testing;

namespace {

const std::string kCube = scene("vkcube.ptf.xz");

void check_refused(const Place& place, const std::string& arguments,
                   std::initializer_list<const char*> parts) {
  CAPTURE(arguments);
  const Outcome outcome = place.run(arguments);
  check_error(outcome, parts);
  CHECK(outcome.status == 2);
  CHECK(outcome.out.empty());
}

}  // namespace

TEST_CASE("the camera of a frame or of a synthetic frame is refused") {
  const Place place;
  std::ofstream(place.path / "a.obj") << "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n";
  const std::string mesh = (place.path / "a.obj").string();
  const std::string record = " --out " + (place.path / "r").string();
  for (const std::string& input : {kCube, std::string("synthetic:one_triangle")}) {
    for (const std::string camera :
         {"--size 64x64", "--eye 1,2,3", "--at 1,2,3", "--up 0,1,0", "--fov 60", "--camera 0"}) {
      const std::string option = camera.substr(0, camera.find(' '));
      for (const std::string& command :
           {"run " + input, "info " + input, "ledger " + input, "record " + input + record,
            "run " + input + " " + kCube, "run " + input + " --reference exact"}) {
        check_refused(place, command + " " + camera,
                      {input.c_str(), "no mesh", option.c_str(), "legal", ".obj, .ply, .gltf, .glb"});
      }
    }
  }
  for (const std::string& command :
       {"run " + mesh, "info " + mesh, "ledger " + mesh, "record " + mesh + record}) {
    CAPTURE(command);
    CHECK(place.run(command + " --eye 0,0,3 --at 0,0,0 --up 0,1,0 --fov 60 --size 64x64").status == 0);
  }
}

TEST_CASE("the camera counts where one of several inputs is a mesh") {
  const Place place;
  std::ofstream(place.path / "a.obj") << "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n";
  const std::string mesh = (place.path / "a.obj").string();
  const std::string frame = (place.path / "a.ptf").string();
  halfspace::Camera camera;
  camera.width = 64;
  camera.height = 48;
  halfspace::write_ptf(halfspace::load(mesh, camera), frame);
  for (const std::string& inputs : {frame + " " + mesh, mesh + " " + frame}) {
    CAPTURE(inputs);
    CHECK(place.run("run " + inputs + " --size 64x48").status == 0);
    CHECK(place.run("record " + inputs + " --size 64x48 --out " + (place.path / "r").string()).status == 0);
  }
  check_refused(place, "run " + frame + " " + frame + " --size 64x48", {"a.ptf", "no mesh", "--size"});
}

TEST_CASE("options of a job that is not asked for are refused") {
  const Place place;
  const std::string timed = "run " + kCube + " --fidelity recurrence";
  check_refused(place, timed + " --seed 3", {"--seed", "'3'", "--stall"});
  CHECK(place.run(timed + " --seed 3 --stall sink:1:2").status == 0);
  check_refused(place, "ledger " + kCube + " --threads 2", {"--threads", "--savings"});
  CHECK(place.run("ledger synthetic:one_triangle --threads 2 --savings").status == 0);
  check_refused(place, "bench read " + kCube + " --side 9", {"--side", "MESH"});
  check_refused(place, "bench read " + kCube + " --keep " + place.path.string(), {"--keep", "MESH"});
  check_refused(place, "ledger " + kCube + " --rtl-folder x", {"--rtl-folder", "functional", "legal", "rtl"});
  for (const char* option : {"--rtl-folder x", "--rtl-seed 1", "--wave x", "--rtl-every-cycle"}) {
    const std::string name = std::string(option).substr(0, std::string(option).find(' '));
    check_refused(place, "stress --cases 1 " + std::string(option), {name.c_str(), "functional", "rtl"});
    check_refused(place, timed + " " + option, {name.c_str(), "recurrence", "rtl"});
  }
}

TEST_CASE("stress: options that a job does not look at are refused") {
  const Place place;
  const std::string write = "--write " + (place.path / "w").string() + " ";
  for (const std::string& options : std::initializer_list<std::string>{
           "--every 2", "--threads 2", "--exhaustive --threads 2", write + "--samples 5",
           write + "--seconds 5", write + "--depth-bound 1", write + "--core fast", "--sharpness --core fast",
           "--exhaustive-units --core readable", "--engine reference:exact --core fast",
           "--engine reference:exact --rtl-seed 1", "--exhaustive --family mesh",
           "--exhaustive --depth unorm16", "--exhaustive --depth-bound 1", "--exhaustive --seed 2",
           "--exhaustive --samples 2", "--exhaustive --cases 2", "--exhaustive --seconds 2",
           "--exhaustive-units --seed 2"}) {
    check_refused(place, "stress " + options, {"--"});
  }
}
