// halfspace run --reference: the files of a run, which `diff` compares with the machine's.
#include "program.hpp"

#include <catch2/catch.hpp>

namespace halfspace::testing {
namespace {

std::string run_cube(const Place& place, const char* folder, const std::string& options) {
  const std::string out = (place.path / folder).string();
  const Outcome outcome = place.run("run " + scene("vkcube.ptf.xz") + " --out " + out + " " + options);
  CHECK(outcome.status == 0);
  CHECK(outcome.err.empty());
  return out;
}

}  // namespace

TEST_CASE("run --reference: writes the files of a run but those of tiles, and stats.json lists them") {
  const Place place;
  const fs::path out =
      run_cube(place, "result", "--reference barycentric --set setup.fill_rule=top_right --quads");
  const std::set<std::string> expected{"stats.json",  "depth0.npy",  "fragments0.npy", "survivors0.npy",
                                       "quads.npy",   "shaded0.png", "depth0.png",     "overdraw0.png",
                                       "colors0.png", "quads0.png"};
  CHECK(entries(out) == expected);
  const Json stats = read_stats(out);
  CHECK(stats["files"].get<std::set<std::string>>() == expected);
  CHECK(stats["fidelity"].is_null());
  CHECK(stats["core"].is_null());
  CHECK(stats["reference"]["name"] == "barycentric");
  CHECK(stats["reference"]["culled"] == 6);
  CHECK(stats["reference"]["drawn"] == 6);
  CHECK(stats["frame"]["counters"]["front_end"]["triangles"] == 12);
  CHECK(!stats["frame"]["counters"].contains("tile_walker"));
  CHECK(!stats["frame"]["counters"]["early_z"].contains("z_hits"));
}

TEST_CASE("run --reference: diff compares with the machine what both count") {
  const Place place;
  const std::string machine = run_cube(place, "machine", "--no-pictures --quads --tiles");
  for (const char* name : {"exact", "barycentric", "scanline", "incremental"}) {
    CAPTURE(name);
    const std::string out =
        run_cube(place, "reference", "--no-pictures --quads --reference " + std::string(name));
    const Outcome outcome = place.run("diff " + machine + " " + out);
    // Coverage and what passes are the same, some depths a code of 16 bits apart.
    CHECK(outcome.out.find("fragments0.npy") == std::string::npos);
    CHECK(outcome.out.find("survivors0.npy") == std::string::npos);
    CHECK(outcome.out.find("stats.json") == std::string::npos);
    CHECK(outcome.out.find("tiles.npy: only in one of the two") != std::string::npos);
  }
}

TEST_CASE("the machine and the exact references cover the same under every fill rule") {
  const Place place;
  for (const char* rule : {"top_left", "bottom_left", "top_right", "bottom_right", "normal_sign"}) {
    const std::string options = "--no-pictures --quads --set setup.fill_rule=" + std::string(rule);
    const std::string machine = run_cube(place, "machine", options);
    const std::string exact = run_cube(place, "exact", options + " --reference exact");
    const std::string difference = place.run("diff " + machine + " " + exact).out;
    CHECK(difference.find("fragments0.npy") == std::string::npos);
    CHECK(difference.find("stats.json") == std::string::npos);
    for (const char* name : {"scanline", "incremental"}) {
      CAPTURE(rule, name);
      const std::string out = run_cube(place, "other", options + " --reference " + name);
      CHECK(place.run("diff " + exact + " " + out).status == 0);
    }
  }
}

TEST_CASE("run --reference: refuses names that do not exist and options without a meaning") {
  const Place place;
  const std::string command = "run " + scene("vkcube.ptf.xz") + " --reference exact ";
  check_error(place.run("run " + scene("vkcube.ptf.xz") + " --reference nothing"),
              {"--reference", "nothing", "homogeneous"});
  check_error(place.run(command + "--set setup.fill_rule=left"), {"setup.fill_rule", "left", "bottom_right"});
  check_error(place.run(command + "--fidelity recurrence"),
              {"--reference is 'exact'", "--fidelity", "--quads"});
  check_error(place.run(command + "--prepass"), {"--reference is 'exact'", "a what-if"});
  check_error(place.run(command + "--tile-jobs x"), {"--reference is 'exact'", "--tile-jobs"});
  check_error(place.run(command + "--set late_z=late"), {"late_z.mode is 'late'", "no_write"});
}

}  // namespace halfspace::testing
