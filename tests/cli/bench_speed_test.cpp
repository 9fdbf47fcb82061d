// `bench speed` and `bench stages`, as a user runs them.
#include <algorithm>

#include "program.hpp"

using namespace halfspace::testing;

TEST_CASE("bench speed: the model beside the scalar loop, as a table, CSV and JSON") {
  const Place place;
  const std::string json = (place.path / "speed.json").string();
  const std::string csv = (place.path / "speed.csv").string();
  const Outcome outcome = place.run("bench speed --without llvmpipe --repeat 2 --json " + json + " --csv " +
                                    csv + " " + scene("vkcube.ptf.xz") + " " + scene("cc0_truck.ptf.xz"));
  REQUIRE(outcome.status == 0);
  CHECK(outcome.err.empty());
  CHECK(outcome.out.find("llvmpipe is left out: by --without") != std::string::npos);
  CHECK(outcome.out.find(
            "| scalar loop / functional | scalar loop / functional pixels | Mquads/s | ns a triangle |") !=
        std::string::npos);
  CHECK(outcome.out.find("| vkcube | unorm16 | 12 | 74783 | 74783 |") != std::string::npos);
  const std::string table = slurp(csv);
  CHECK(std::count(table.begin(), table.end(), '\n') == 3);
  const Json data = Json::parse(slurp(json));
  CHECK(data["workloads"].size() == 2);
  CHECK(data["workloads"][0]["runs"]["scalar_loop"]["milliseconds"].size() == 2);
  CHECK(data["workloads"][0]["runs"]["scalar_loop"]["survivors"] == 74783);
}

TEST_CASE("bench speed: synthetic frames have the depth format that is asked for") {
  const Place place;
  const std::string command = "bench speed --without llvmpipe --repeat 1 ";
  CHECK(place.run(command + "synthetic:fill_ftb").out.find("| fill_ftb | unorm24 | 8 |") !=
        std::string::npos);
  CHECK(place.run(command + "--depth float32 synthetic:large_ftb:full")
            .out.find("| large_ftb:full | float32 | 2000 |") != std::string::npos);
  check_error(place.run(command + "--depth float32 " + scene("vkcube.ptf.xz")),
              {"vkcube.ptf.xz", "--depth is 'float32'", "legal", "synthetic"});
  check_error(place.run(command + "--depth unorm16 synthetic:fill_ftb"),
              {"--depth", "unorm16", "unorm24,float32"});
}

TEST_CASE("bench speed: contenders are left out, and a wrong one is refused") {
  const Place place;
  const Outcome alone = place.run("bench speed --repeat 1 --without functional_pixels,scalar_loop,llvmpipe " +
                                  scene("vkcube.ptf.xz"));
  CHECK(alone.status == 0);
  CHECK(alone.out.find("scalar loop is left out: by --without") != std::string::npos);
  CHECK(alone.out.find("| vkcube | unorm16 | 12 | 74783 | 74783 |") != std::string::npos);
  CHECK(alone.out.find("scalar loop / functional") == std::string::npos);
  check_error(place.run("bench speed --without functional"), {"--without", "functional", "scalar_loop"});
}

TEST_CASE("bench roof: a row for each place of the depth codes") {
  const Place place;
  const Outcome outcome = place.run("bench roof --repeat 1");
  CHECK(outcome.status == 0);
  CHECK(outcome.out.find("| a surface of 1920x1080 | 7.91 | ") != std::string::npos);
  check_error(place.run("bench roof --repeat 0"), {"--repeat", "1 to 1000"});
}

TEST_CASE("bench speed: a bad name, or a file that cannot be written, is known before anything is measured") {
  const Place place;
  check_error(place.run("bench speed synthetic:sliver:full synthetic:mid"),
              {"synthetic:mid: no such frame", "medium"});
  check_error(place.run("bench speed synthetic:medium:half"),
              {"synthetic:medium:half", "\"half\"", "synthetic:medium:full"});
  check_error(place.run("bench speed --csv /proc/nowhere/speed.csv"),
              {"/proc/nowhere/speed.csv: cannot be written"});
  check_error(place.run("bench speed --repeat 0"), {"--repeat", "1 to 1000"});
}

#ifndef __SANITIZE_ADDRESS__  // Mesa leaks
TEST_CASE("bench speed: llvmpipe draws the same samples, or it is said why it does not") {
  const Place place;
  const Outcome outcome = place.run("bench speed --repeat 1 " + scene("vkcube.ptf.xz"));
  REQUIRE(outcome.status == 0);
  const bool absent = outcome.out.find("llvmpipe is left out: ") != std::string::npos;
  const bool alike = outcome.out.find("| llvmpipe / functional |") != std::string::npos &&
                     outcome.out.find("| 0 | 0 |\n") != std::string::npos;
  CHECK(absent != alike);
}
#endif

TEST_CASE("bench stages: a line for each stage") {
  const Place place;
  const Outcome outcome = place.run("bench stages --repeat 1 " + scene("vkcube.ptf.xz"));
  REQUIRE(outcome.status == 0);
  for (const char* stage : {"surfaces", "front_end", "setup", "block_walker", "tile_walker", "edge_evaluator",
                            "quad_generator", "z_test", "pixel_counts", "z_cache", "all"}) {
    CHECK(outcome.out.find("| vkcube | " + std::string(stage) + " | ") != std::string::npos);
  }
  CHECK(outcome.out.find(" 74783 fragments |") != std::string::npos);
  check_error(place.run("bench stages"), {"INPUT is required"});
}
