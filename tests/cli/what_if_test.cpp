// What-ifs, as a user runs them.
#include "program.hpp"

using namespace halfspace::testing;

namespace {

/// The stats of a run of the truck in the cheapest engine with cycles.
Json truck_stats(const Place& place, const std::string& options) {
  const std::string out = (place.path / "result").string();
  const Outcome outcome = place.run("run " + scene("cc0_truck.ptf.xz") +
                                    " --fidelity recurrence --no-pictures --out " + out + " " + options);
  CAPTURE(outcome.err);
  REQUIRE(outcome.status == 0);
  return read_stats(out);
}

}  // namespace

TEST_CASE("run: a what-if stands beside the frame as it is, which is what a plain run says") {
  const Place place;
  const Json plain = truck_stats(place, "");
  CHECK(!plain.contains("what_if"));
  const Json stats = truck_stats(place, "--prepass --sort front-to-back");
  const Json& what_if = stats["what_if"];
  CHECK(what_if["applied"] == Json::parse(R"([{"name": "sort", "draws": 52, "ranges": 1},
                                              {"name": "prepass", "draws": 52, "ranges": 1}])"));
  CHECK(what_if["cycles"]["without"] == plain["cycles"]);
  CHECK(what_if["cycles"]["with"] == stats["cycles"]);
  CHECK(what_if["triangles"]["without"] == 117013);
  CHECK(what_if["triangles"]["with"] == 2 * 117013);
  CHECK(what_if["triangles"]["ratio"] == 2.0);
  CHECK(what_if["shaded"]["without"] == plain["frame"]["counters"]["early_z"]["survivors"]);
  const Json& memory = plain["frame"]["time"]["memory"];
  CHECK(what_if["depth_read"]["without"] == memory["bytes_read"]);
  CHECK(what_if["depth_written"]["without"] == memory["bytes_written"]);
  const Json& with = stats["frame"]["time"]["memory"];
  CHECK(what_if["depth_read"]["with"] == with["bytes_read"]);
  CHECK(what_if["depth_written"]["with"] == with["bytes_written"]);
  CHECK(what_if["shaded"]["with"] < what_if["shaded"]["without"]);
}

TEST_CASE("run: a what-if prints what it acts on, and the work without and with it") {
  const Place place;
  const Outcome outcome = place.run("run " + scene("vkcube.ptf.xz") + " --prepass");
  REQUIRE(outcome.status == 0);
  CHECK(outcome.out.find("what if prepass: acts on 1 draws in 1 ranges\n") != std::string::npos);
  CHECK(outcome.out.find("  fragments              74783       149566  2.000\n") != std::string::npos);
  CHECK(outcome.out.find("  shaded                 74783        74783  1.000\n") != std::string::npos);
  CHECK(outcome.out.find("  cycles ") == std::string::npos);
}

TEST_CASE("run: several INPUTs follow each other, and every second may be walked backwards") {
  const Place place;
  const std::string cube = scene("vkcube.ptf.xz");
  const std::string out = (place.path / "result").string();
  REQUIRE(place.run("run " + cube + " " + cube + " --out " + out).status == 0);
  const Json stats = read_stats(out);
  CHECK(stats["frame"]["name"] == "vkcube, vkcube");
  CHECK(stats["frame"]["counters"]["quad_generator"]["fragments"] == 2 * 74783);
  REQUIRE(place.run("run " + cube + " " + cube + " --order alternate --out " + out).status == 0);
  CHECK(read_stats(out)["what_if"]["applied"] ==
        Json::parse(R"([{"name": "order", "draws": 1, "ranges": 1}])"));
}

TEST_CASE("record: takes what-ifs, and the machine takes the same cycles as in a run") {
  const Place place;
  const std::string truck = scene("cc0_truck.ptf.xz");
  const std::string file = (place.path / "truck.rec").string();
  const Json stats = truck_stats(place, "--lod 2 --delay 5000");
  CHECK(stats["what_if"]["triangles"]["with"] < 2 * 117013);
  REQUIRE(place.run("record " + truck + " --lod 2 --delay 5000 --out " + file).status == 0);
  const Outcome outcome = place.run("retime " + file);
  REQUIRE(outcome.status == 0);
  CHECK(outcome.out.find(" " + std::to_string(stats["cycles"].get<std::uint64_t>()) + " ") !=
        std::string::npos);
}

TEST_CASE("what-ifs that cannot be are refused in one line") {
  const Place place;
  const std::string run = "run " + scene("vkcube.ptf.xz") + " ";
  check_error(place.run(run + "--prepass --delay 7"), {"prepass", "delay 7", "legal: one of them"});
  check_error(place.run(run + "--delay 0"), {"--delay", "0", "1", "268435456"});
  check_error(place.run(run + "--delay=-1"), {"--delay", "-1", "268435456"});
  check_error(place.run(run + "--lod 0"), {"lod is 0", "above 0"});
  check_error(place.run(run + "--lod nan"), {"lod is nan", "above 0"});
  check_error(place.run(run + "--sort nearest"), {"--sort", "nearest", "front-to-back", "back-to-front"});
  check_error(place.run(run + "--order backwards"), {"--order", "backwards", "alternate"});
  check_error(place.run(run + "--order alternate"), {"'alternate' with 1 frame", "two or more"});
  check_error(place.run(run + scene("vkcube.ptf.xz") + " --order alternate --sort back-to-front"),
              {"sort is 'back-to-front'", "'alternate'", "one of them"});
  check_error(place.run(run + scene("cc0_truck.ptf.xz")),
              {"cc0_truck: targets are 1920x1080", "legal in a sequence", "500x500"});
  check_error(place.run("info " + scene("vkcube.ptf.xz") + " " + scene("vkcube.ptf.xz")),
              {"INPUT", "At Most 1"});
}
