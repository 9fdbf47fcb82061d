// Several samples a pixel on the command line: the same files from every engine that has them, and a line
// from all that has not.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cstring>
#include <string>

#include "halfspace/report/npy.hpp"
#include "program.hpp"

using namespace halfspace::testing;

namespace {

const std::string kFour = " --set raster.samples=4 ";

std::uint64_t sum_of(const halfspace::NpyArray& counts) {
  std::uint64_t sum = 0;
  for (std::size_t at = 0; at < counts.data.size(); at += 2) {
    std::uint16_t value = 0;
    std::memcpy(&value, counts.data.data() + at, 2);
    sum += value;
  }
  return sum;
}

}  // namespace

TEST_CASE("samples: every engine but the RTL writes the same files") {
  const Place place;
  const std::string frame = scene("vkcube.ptf.xz");
  const auto folder = [&](const char* name) { return (place.path / name).string(); };
  for (const char* fidelity : {"functional", "recurrence", "systemc"}) {
    REQUIRE(place
                .run("run " + frame + kFour + "--quads --tiles --fidelity " + fidelity + " --out " +
                     folder(fidelity))
                .status == 0);
  }
  CHECK(place.run("diff " + folder("functional") + " " + folder("recurrence")).status == 0);
  CHECK(place.run("diff " + folder("recurrence") + " " + folder("systemc")).status == 0);

  const fs::path out = place.path / "functional";
  const Json stats = read_stats(out);
  CHECK(stats["core"] == "readable");
  CHECK(stats["config"]["raster.samples"] == "4");
  CHECK(stats["config"]["raster.sample_positions"] == "standard");
  const halfspace::NpyArray depth = halfspace::read_npy(out / "depth0.npy");
  CHECK(depth.shape == std::vector<std::uint64_t>{4, 500, 500});
  CHECK(depth.data.size() == 4 * 500 * 500 * 4u);
  const halfspace::NpyArray fragments = halfspace::read_npy(out / "fragments0.npy");
  CHECK(fragments.shape == depth.shape);
  const Json& counters = stats["frame"]["counters"];
  CHECK(sum_of(fragments) == counters["quad_generator"]["fragments"]);
  CHECK(sum_of(halfspace::read_npy(out / "survivors0.npy")) == counters["early_z"]["survivors"]);
  const halfspace::NpyArray quads = halfspace::read_npy(out / "quads.npy");
  CHECK(quads.descr.ends_with("('cycle','<u8'),('sample','|u1')]"));
  CHECK(quads.shape[0] == counters["quad_generator"]["quads"]);
  std::array<std::uint64_t, 5> by_sample{};
  for (std::size_t at = 46; at < quads.data.size(); at += 47) {
    ++by_sample[std::min<std::size_t>(std::to_integer<std::size_t>(quads.data[at]), 4)];
  }
  CHECK(by_sample[4] == 0);
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(by_sample[i] > quads.shape[0] / 5);
  }
}

TEST_CASE("samples: a difference is named by its sample") {
  const Place place;
  const std::string frame = scene("vkcube.ptf.xz") + " ";
  const auto run = [&](const char* name, const char* positions) {
    const std::string out = (place.path / name).string();
    REQUIRE(place
                .run("run " + frame + "--set raster.samples=2 --set raster.sample_positions=" + positions +
                     " --no-pictures --out " + out)
                .status == 0);
    return out;
  };
  const std::string a = run("a", "'8,8;0,0'");
  const std::string b = run("b", "'8,8;15,15'");
  const Outcome outcome = place.run("diff " + a + " " + b);
  CHECK(outcome.status == 1);
  CHECK(outcome.out.find("sample 1 of pixel (") != std::string::npos);
  CHECK(outcome.out.find("sample 0 of pixel (") == std::string::npos);
}

TEST_CASE("samples: a record is re-timed to the cycles of a run") {
  const Place place;
  const std::string record = (place.path / "cube.rec").string();
  const std::string out = (place.path / "run").string();
  REQUIRE(place.run("record " + scene("vkcube.ptf.xz") + kFour + "--out " + record).status == 0);
  REQUIRE(
      place.run("run " + scene("vkcube.ptf.xz") + kFour + "--fidelity recurrence --no-pictures --out " + out)
          .status == 0);
  const std::string table = (place.path / "retimed.json").string();
  REQUIRE(place.run("retime " + record + " --sweep memory.latency=100 --json " + table).status == 0);
  CHECK(Json::parse(slurp(table))["machines"][0]["cycles"] == read_stats(out)["cycles"]);
}

TEST_CASE("samples: the RTL is given their number and their places") {
  const Place place;
  const auto arguments = [&](const std::string& options) { return place.run("config --rtl " + options).out; };
  CHECK_THAT(arguments(""), Catch::Contains("-DHALFSPACE_SAMPLES=1\n-DHALFSPACE_SAMPLE_POSITIONS=128'h88\n"));
  CHECK_THAT(arguments("--set raster.samples=4"),
             Catch::Contains("-DHALFSPACE_SAMPLES=4\n-DHALFSPACE_SAMPLE_POSITIONS=128'hae2ae662\n") &&
                 Catch::Contains("-GMemoryTiles=262144\n"));
  CHECK_THAT(arguments("--set raster.samples=2 --set \"raster.sample_positions=0,15;11,3\""),
             Catch::Contains("-DHALFSPACE_SAMPLES=2\n-DHALFSPACE_SAMPLE_POSITIONS=128'hb30f\n"));
  // Positions that are those of the standard are the same machine.
  CHECK(arguments("--set raster.samples=2 --set \"raster.sample_positions=12,12;4,4\"") ==
        arguments("--set raster.samples=2"));
}

TEST_CASE("samples: what has one sample a pixel refuses more by name") {
  const Place place;
  const std::string run = "run " + scene("vkcube.ptf.xz") + kFour;
  check_error(place.run(run + "--quad-merging 16"), {"'raster.samples' is 4", "quad merging: 1"});
  check_error(place.run(run + "--tile-jobs " + (place.path / "jobs").string()),
              {"'raster.samples' is 4", "legal with --tile-jobs: 1"});
  check_error(place.run(run + "--reference exact"), {"'raster.samples' is 4", "legal with --reference: 1"});
  check_error(place.run(run + "--core fast"), {"core is 'fast'", "raster.samples"});
  check_error(place.run("ledger " + scene("vkcube.ptf.xz") + kFour), {"'raster.samples' is 4", "legal with"});
  check_error(place.run("bench stages " + scene("vkcube.ptf.xz") + kFour),
              {"'raster.samples' is 4", "legal with"});
  for (const char* option :
       {"--reports", "--sharpness", "--exhaustive", "--exhaustive-units", "--engine reference:exact"}) {
    const std::string name = std::string(option).substr(0, std::string(option).find(' '));
    check_error(place.run(std::string("stress ") + option + kFour),
                {"'raster.samples' is 4", ("legal with " + name + ": 1").c_str()});
  }
}

TEST_CASE("supersampling: results are of the larger frame, pictures of the frame's size") {
  const Place place;
  const fs::path out = place.path / "out";
  for (const std::string& more : {std::string(" --filter tent"), std::string(" --reference barycentric"),
                                  std::string(" --fidelity recurrence")}) {
    REQUIRE(place.run("run " + kCube + " --supersample 2 --out " + out.string() + more).status == 0);
    CHECK(halfspace::read_npy(out / "fragments0.npy").shape == std::vector<std::uint64_t>{1000, 1000});
    CHECK(read_stats(out)["frame"]["magnified"] == 2);
    for (const char* picture : {"shaded0.png", "depth0.png", "overdraw0.png", "quads0.png"}) {
      // Width and height stand behind the signature and the head of the first chunk, big-endian.
      const std::string png = slurp(out / picture);
      CHECK(png.substr(16, 8) == std::string("\0\0\x01\xF4\0\0\x01\xF4", 8));
    }
  }
}

TEST_CASE("supersampling: what has no meaning is refused") {
  const Place place;
  const std::string run = "run " + kCube;
  check_error(place.run(run + " --supersample 17"), {"17", "1 to 16"});
  check_error(place.run(run + " --filter box"), {"--filter", "--supersample"});
  check_error(place.run(run + " --supersample 2 --filter box"), {"--filter is 'box'", "legal: with --out"});
  check_error(place.run("run " + scene("cc0_truck.ptf.xz") + " --supersample 16"),
              {"a side of target 0 is 30720", "legal: at most 16384"});
}
