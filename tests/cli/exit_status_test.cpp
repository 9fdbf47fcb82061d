// The exit status: 0 done, 1 a difference, 2 usage, 3 trouble; and that --help says so.
#include <catch2/catch.hpp>
#include <fstream>

#include "program.hpp"

using namespace halfspace::testing;

namespace {

/// One line of error, and this status.
void check_status(const Place& place, int status, const std::string& arguments) {
  CAPTURE(arguments);
  const Outcome outcome = place.run(arguments);
  check_error(outcome, {"halfspace: "});
  CHECK(outcome.status == status);
  CHECK(outcome.out.empty());
}

}  // namespace

TEST_CASE("exit status: what --help says") {
  const Place place;
  const Outcome help = place.run("--help");
  CHECK(help.status == 0);
  for (const char* line :
       {"Exit status:", "\n  0  done", "\n  1  a difference", "\n  2  usage", "\n  3  trouble"}) {
    CAPTURE(line, help.out);
    CHECK(help.out.find(line) != std::string::npos);
  }
  CHECK(place.run("--version").status == 0);
}

TEST_CASE("exit status 1: results differ, or a law is broken") {
  const Place place;
  const std::string out = place.path.string();
  REQUIRE(place.run("run " + kCube + " --no-pictures --out " + out + "/a").status == 0);
  REQUIRE(
      place.run("run " + kCube + " --no-pictures --out " + out + "/b --set raster.sub_pixel_bits=4").status ==
      0);
  CHECK(place.run("diff " + out + "/a " + out + "/a").status == 0);
  CHECK(place.run("diff " + out + "/a " + out + "/b").status == 1);
  CHECK(place.run("stress --engine wrong:short_box --family mesh --cases 2").status == 1);
  CHECK(place.run("stress --exhaustive --every 256 --engine wrong:no_top").status == 1);
}

TEST_CASE("exit status 2: the command line") {
  const Place place;
  std::ofstream(place.path / "small.toml") << "[block_walker]\nblock_size = 16\n";
  std::ofstream(place.path / "cube.obj") << "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n";
  for (const std::string& arguments : std::initializer_list<std::string>{
           "",
           "nonsense",
           "run",
           "run " + kCube + " --frobnicate",
           "run " + kCube + " --threads 0",
           "run " + kCube + " --threads many",
           "run " + kCube + " --fidelity guess",
           "run " + kCube + " --core quick",
           "run " + kCube + " --quads",
           "run " + kCube + " --size 64x64",
           "run " + kCube + " --vcd w.vcd",
           "run " + kCube + " --core fast --set tile_walker.tile_size=16",
           "run " + kCube + " --order alternate",
           "run " + kCube + " --lod -1",
           "run " + kCube + " --set nonsense=1",
           "run " + kCube + " --set late_z",
           "run " + kCube + " --set tile_walker.tile_size=5",
           "run " + kCube + " --set block_walker.block_size=8",
           "run " + kCube + " --config " + (place.path / "small.toml").string() +
               " --set tile_walker.tile_size=16",
           "run " + kCube + " --reference exact --threads 2",
           "run " + kCube + " --fidelity recurrence --stall drain:1:1",
           "run " + kCube + " --fidelity recurrence --timeline --timeline-draws 5:6 --out " +
               (place.path / "result").string(),
           "run " + (place.path / "cube.obj").string() + " --eye 1,2",
           "run " + (place.path / "cube.obj").string() + " --fov 180",
           "run " + (place.path / "cube.obj").string() + " --size 0x64",
           "run " + (place.path / "cube.obj").string() + " --eye 1,2,3 --at 1,2,3",
           "run " + (place.path / "cube.obj").string() + " --eye 0,0,9 --at 0,0,10",
           "stress --engine mine",
           "stress --engine wrong:nobody --cases 1",
           "stress --engine reference:nobody --cases 1",
           "bench",
           "bench error",
           "bench speed " + kCube + " --depth float32",
           "retime x --sweep a",
           "config --toml --rtl",
       }) {
    check_status(place, 2, arguments);
  }
}

TEST_CASE("exit status 3: inputs and outputs") {
  const Place place;
  std::ofstream(place.path / "small.toml")
      << "[tile_walker]\ntile_size = 16\n[block_walker]\nblock_size = 16\n";
  std::ofstream(place.path / "key.toml") << "[tile_walker]\ntile_sise = 16\n";
  std::ofstream(place.path / "value.toml") << "[tile_walker]\ntile_size = 5\n";
  std::ofstream(place.path / "broken.toml") << "[tile_walker\n";
  std::ofstream(place.path / "broken.obj") << "f 1 2 3\n";
  std::ofstream(place.path / "broken.ptf") << "PTF1";
  std::ofstream(place.path / "record") << "no record";
  const std::string in = place.path.string();
  for (const std::string& arguments : std::initializer_list<std::string>{
           "run nothing.ptf",
           "run " + scene("README.md"),
           "run synthetic:nothing",
           "run " + in + "/broken.obj",
           "run " + in + "/broken.ptf",
           "info " + in + "/broken.ptf",
           "ledger " + in + "/broken.ptf",
           "record " + in + "/broken.ptf --out " + in + "/r",
           "retime " + in + "/record",
           "diff " + in + " " + in,
           "run " + kCube + " --config nothing.toml",
           "config --config " + in + "/small.toml",
           "config --config " + in + "/key.toml",
           "config --config " + in + "/value.toml",
           "config --config " + in + "/broken.toml",
           "run " + kCube + " --out /proc/nowhere/out",
           "run " + kCube + " --out " + in,
           "run " + kCube + " --fidelity systemc --vcd /proc/nowhere/w",
           "run " + kCube + " --fidelity rtl --rtl-folder " + in,
           "record " + kCube + " --out /proc/nowhere",
       }) {
    check_status(place, 3, arguments);
  }
  const Outcome sizes = place.run("config --config " + in + "/small.toml");
  check_error(sizes, {"small.toml: ", "block_walker.block_size"});
}
