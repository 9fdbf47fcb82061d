// The program on synthetic frames, and `bench error` where it has nothing to measure.
#include "program.hpp"

using namespace halfspace::testing;

TEST_CASE("synthetic frames are an INPUT like others, and listed") {
  const Place place;
  const Outcome help = place.run("info --help");
  CHECK(help.out.find("synthetic:one_triangle") != std::string::npos);
  CHECK(help.out.find("20,000 (1 M / 50)") != std::string::npos);
  const Outcome info = place.run("info synthetic:random_122");
  CHECK(info.status == 0);
  CHECK(info.out.find("random_122: 1 targets, 1 draws, 1 clears, 1000 triangles") == 0);
  const std::string out = place.path.string() + "/result";
  REQUIRE(place.run("run synthetic:one_triangle --fidelity recurrence --no-pictures --out " + out).status ==
          0);
  CHECK(read_stats(out)["frame"]["name"] == "one_triangle");
  CHECK(read_stats(out)["frame"]["counters"]["quad_generator"]["fragments"] == 512 * 511 / 2);
  const Outcome record = place.run("record synthetic:one_triangle --out " + place.path.string() + "/one.rec");
  CHECK(record.status == 0);
  check_error(place.run("run synthetic:nothing"), {"synthetic:nothing", "one_triangle", "fill_btf"});
}

TEST_CASE("bench error: without frames or without a verilated pipeline it says so, and leaves nothing") {
  const Place place;
  const std::string out = (place.path / "out_folder").string();
  const std::string folder = " --rtl-folder " + place.path.string();
  check_error(place.run("bench error" + folder), {"no INPUT", "--synthetic", "synthetic:NAME"});
  check_error(place.run("bench error synthetic:one_triangle --out " + out + folder),
              {"no verilated pipeline of this configuration", place.path.c_str()});
  CHECK_FALSE(fs::exists(out));
}
