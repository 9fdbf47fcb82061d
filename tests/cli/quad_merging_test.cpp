// halfspace run --quad-merging: what it prints and writes, in every fidelity the same, and nothing else
// moves.
#include <catch2/catch.hpp>

#include "program.hpp"

namespace halfspace::testing {

TEST_CASE("run: --quad-merging leaves the run as it is and counts the same in every fidelity") {
  const Place place;
  const auto out = [&](const char* name) { return (place.path / name).string(); };
  const std::string run = "run synthetic:tiny_grid --no-pictures --quads --quad-merging 32 --out ";
  REQUIRE(
      place.run("run synthetic:tiny_grid --no-pictures --quads --fidelity recurrence --out " + out("plain"))
          .status == 0);
  REQUIRE(place.run(run + out("functional")).status == 0);
  const Json counts = read_stats(out("functional"))["frame"]["quad_merging"];
  CHECK(counts["buffer"] == 32);
  CHECK(counts["joined"] > 1000);
  CHECK(counts["fragments_unmerged"] == 4 * counts["quads"].get<int>());
  CHECK(counts["fragments_shaded"] == 4 * (counts["quads"].get<int>() - counts["joined"].get<int>()));
  CHECK(counts["saved"].get<double>() ==
        Approx(counts["joined"].get<double>() / counts["quads"].get<double>()));
  for (const char* fidelity : {"recurrence", "systemc"}) {
    CAPTURE(fidelity);
    REQUIRE(place.run(run + out(fidelity) + " --fidelity " + fidelity).status == 0);
    const Json stats = read_stats(out(fidelity));
    CHECK(stats["frame"]["quad_merging"] == counts);
    CHECK(stats["cycles"] == read_stats(out("plain"))["cycles"]);
    // The merging is compared where both have it.
    const Outcome outcome = place.run("diff " + out("plain") + " " + out(fidelity));
    CAPTURE(outcome.out);
    CHECK(outcome.status == 0);
  }
  REQUIRE(
      place.run("run synthetic:tiny_grid --no-pictures --quads --quad-merging 1 --out " + out("functional"))
          .status == 0);
  const Outcome outcome = place.run("diff " + out("functional") + " " + out("systemc"));
  CHECK(outcome.status == 1);
  CHECK(outcome.out.find("quad_merging") != std::string::npos);
}

TEST_CASE("run: --quad-merging shows in the table, by draw in stats.json, and is a number that is legal") {
  const Place place;
  const std::string run =
      "run " + scene("vkcube.ptf.xz") + " --no-pictures --out " + place.path.string() + "/r";
  const Outcome outcome = place.run(run + " --quad-merging 1024");
  REQUIRE(outcome.status == 0);
  for (const char* part : {"\n  quad_merging ", "quads shaded with 1024 held, not 19263", "\n    merged ",
                           "\n    not merged "}) {
    CAPTURE(part, outcome.out);
    CHECK(outcome.out.find(part) != std::string::npos);
  }
  const Json stats = read_stats(place.path / "r");
  REQUIRE(stats["draws"].size() == 1);
  Json draw = stats["draws"][0]["quad_merging"];
  draw["buffer"] = 1024;
  CHECK(draw == stats["frame"]["quad_merging"]);
  REQUIRE(place.run(run).status == 0);
  CHECK(!read_stats(place.path / "r")["frame"].contains("quad_merging"));

  for (const char* number : {"-1", "1048577", "many", "1.5"}) {
    CAPTURE(number);
    check_error(place.run(run + " --quad-merging=" + number), {"--quad-merging", number});
  }
  check_error(place.run(run + " --quad-merging 32 --core fast"), {"core is 'fast'", "quads are merged"});
}

}  // namespace halfspace::testing
