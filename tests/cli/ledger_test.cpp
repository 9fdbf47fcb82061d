// halfspace ledger, as a user runs it.
#include "program.hpp"

using namespace halfspace::testing;

TEST_CASE("ledger: prints what became of everything, and the same in JSON and CSV") {
  const Place place;
  const std::string out = (place.path / "ledger").string();
  const std::string input = "ledger " + scene("vkcube.ptf.xz");
  const Outcome outcome = place.run(input + " --out " + out);
  CAPTURE(outcome.err);
  REQUIRE(outcome.status == 0);
  for (const char* part : {"vkcube: 1 draws; ", " numbers compared with fidelity functional, all equal\n",
                           "\n  triangles                 12 ", "\n  fragments              74783 ",
                           "\n    survive              74783  100.0%"}) {
    CAPTURE(part, outcome.out);
    CHECK(outcome.out.find(part) != std::string::npos);
  }
  CHECK(entries(out) == std::set<std::string>{"ledger.csv", "ledger.json", "ledger.svg"});
  const Json json = Json::parse(slurp(out + "/ledger.json"));
  CHECK(json["schema"] == "halfspace-ledger");
  CHECK(json["frame"]["fragments"]["survive"] == 74783);
  REQUIRE(json["draws"].size() == 1);
  CHECK(json["draws"][0]["fragments"] == json["frame"]["fragments"]);
  CHECK(json["files"] == Json::parse(R"(["ledger.csv", "ledger.svg", "ledger.json"])"));
  const std::string csv = slurp(out + "/ledger.csv");
  CHECK(std::count(csv.begin(), csv.end(), '\n') == 1 + 4);
  CHECK(csv.find("row,command,surface,triangles.all,") == 0);
  CHECK(slurp(out + "/ledger.svg").find("vkcube: what became of everything") != std::string::npos);
  CHECK(place.run(input + " --out " + out).status == 0);  // replaces its own result
  const Outcome printed = place.run(input + " --json");
  REQUIRE(printed.status == 0);
  Json without_files = json;
  without_files["files"] = Json::array();
  CHECK(Json::parse(printed.out) == without_files);
}

TEST_CASE("ledger: compares with the counters of the fidelity that is asked for") {
  const Place place;
  for (const char* fidelity : {"recurrence", "systemc"}) {
    const Outcome outcome = place.run(
        "ledger synthetic:tiny_grid --set hi_z.enabled=true --no-draws --fidelity " + std::string(fidelity));
    CAPTURE(outcome.out, outcome.err);
    CHECK(outcome.status == 0);
    CHECK(outcome.out.find("numbers compared with fidelity " + std::string(fidelity) + ", all equal") !=
          std::string::npos);
  }
}

TEST_CASE("ledger: what a switch saves is what two runs say") {
  const Place place;
  const Outcome outcome = place.run("ledger " + scene("vkcube.ptf.xz") + " --json --savings");
  CAPTURE(outcome.err);
  REQUIRE(outcome.status == 0);
  const Json savings = Json::parse(outcome.out)["savings"];
  std::set<std::string> keys;
  for (const auto& [key, cost] : savings["without"].items()) {
    keys.insert(key);
  }
  CHECK(keys == std::set<std::string>{"block_walker.trivial_reject", "block_walker.sample_reject",
                                      "hi_z.enabled", "hi_z.accept", "tile_walker.trivial_accept",
                                      "z_cache.fast_clear", "z_cache.compression"});
  const std::string out = (place.path / "run").string();
  const auto cost = [&](const std::string& options) {
    const std::string all_on =
        " --set hi_z.enabled=true --set z_cache.compression=true --set block_walker.sample_reject=true ";
    REQUIRE(place
                .run("run " + scene("vkcube.ptf.xz") + " --fidelity recurrence --no-pictures --out " + out +
                     all_on + options)
                .status == 0);
    const Json stats = read_stats(out);
    const Json& memory = stats["frame"]["time"]["memory"];
    return Json{{"cycles", stats["cycles"]},
                {"bytes_read", memory["bytes_read"]},
                {"bytes_written", memory["bytes_written"]}};
  };
  CHECK(savings["all_on"] == cost(""));
  for (const std::string& key : keys) {
    CAPTURE(key);
    CHECK(savings["without"][key] == cost("--set " + key + "=false"));
  }
}

TEST_CASE("ledger: bad input is one line") {
  const Place place;
  check_error(place.run("ledger /nowhere.ptf"), {"/nowhere.ptf"});
  check_error(place.run("ledger synthetic:tiny_grid --fidelity analytic"), {"--fidelity", "analytic"});
  check_error(
      place.run(
          "ledger synthetic:tiny_grid --savings --set z_cache.parts=4 --set block_walker.block_size=64"),
      {"hi_z"});
  check_error(place.run("ledger synthetic:tiny_grid --json --no-draws"), {"--no-draws"});
}
