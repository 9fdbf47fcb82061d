// halfspace stress, as a user runs it.
#include <catch2/catch.hpp>

#include "program.hpp"

using namespace halfspace::testing;

namespace {

constexpr const char* kInside =
    "sliver,sub_pixel,on_samples,collinear,near_miss,guard_band,fan,mesh,grid_depth";

}  // namespace

TEST_CASE("stress: a campaign in sittings, and its files") {
  const Place place;
  const std::string out = (place.path / "campaign").string();
  const Outcome first = place.run("stress --cases 2 --out " + out);
  CAPTURE(first.out, first.err);
  REQUIRE(first.status == 0);
  CHECK(first.out.find("**0 errors**") != std::string::npos);
  CHECK(entries(out) == std::set<std::string>{"cases", "report.md", "state.json"});
  REQUIRE(place.run("stress --cases 3 --out " + out).status == 0);
  const Json state = Json::parse(slurp(place.path / "campaign" / "state.json"));
  CHECK(state.at("sittings") == 2);
  for (const Json& family : state.at("families")) {
    CHECK(family.at("next") == 3);
  }
  const Outcome other = place.run("stress --seed 2 --cases 3 --out " + out);
  CHECK(other.status == 2);
  CHECK(other.err.find("the campaign's seed is '2'; it must be '1'") != std::string::npos);
}

TEST_CASE("stress: the units, other machines and SystemC break no law") {
  const Place place;
  for (const char* options :
       {"--core readable --cases 3",
        "--core readable --cases 3 --set tile_walker.tile_size=16 --set hi_z.enabled=true",
        "--core readable --cases 3 --set block_walker.levels=1 --set block_walker.order=backtracking",
        "--core readable --cases 3 --set block_walker.order=zigzag --set tile_walker.order=morton",
        "--core readable --cases 3 --set block_walker.levels=3 --set block_walker.order=hilbert",
        "--fidelity recurrence --cases 3 --depth float32 --set depth.interpolator=barycentric",
        "--fidelity systemc --cases 1 --set raster.sub_pixel_bits=4 --depth unorm16"}) {
    const Outcome outcome = place.run(std::string("stress ") + options);
    CAPTURE(options, outcome.out, outcome.err);
    CHECK(outcome.status == 0);
  }
}

TEST_CASE("stress: scenes of public reports break no law on any engine, and are sharp") {
  const Place place;
  for (const char* options :
       {"--cases 16", "--cases 16 --core readable",
        "--cases 8 --core readable --set raster.sub_pixel_bits=4 --depth unorm16",
        "--cases 8 --depth float32 --set depth.interpolator=barycentric",
        "--cases 4 --fidelity recurrence --set hi_z.enabled=true", "--cases 2 --fidelity systemc"}) {
    const Outcome outcome = place.run(std::string("stress --reports ") + options);
    CAPTURE(options, outcome.out, outcome.err);
    CHECK(outcome.status == 0);
    CHECK(outcome.out.find("**0 errors**") != std::string::npos);
    CHECK(outcome.out.find("| floor_decal |") != std::string::npos);
    CHECK(outcome.out.find("| sliver |") == std::string::npos);
  }
  const Outcome sharp = place.run("stress --reports --sharpness --cases 8 --depth-bound 1");
  CAPTURE(sharp.out);
  CHECK(sharp.status == 0);
  CHECK(sharp.out.find("[DRTK #9](https://github.com/facebookresearch/DRTK/issues/9)") != std::string::npos);
  const std::string out = (place.path / "scenes").string();
  REQUIRE(place.run("stress --reports --cases 1 --write " + out).status == 0);
  CHECK(place.run("run " + out + "/odd_scissor-1-0.ptf").status == 0);
}

TEST_CASE("stress: a wrong rasterizer leaves frames and pictures to look at") {
  const Place place;
  const std::string out = (place.path / "campaign").string();
  const Outcome wrong = place.run("stress --engine wrong:short_box --family mesh --cases 2 --out " + out);
  CHECK(wrong.status == 1);
  REQUIRE(entries(place.path / "campaign" / "cases") ==
          std::set<std::string>{"mesh-1-0.png", "mesh-1-0.ptf.xz", "mesh-1-1.png", "mesh-1-1.ptf.xz"});
  CHECK(place.run("run " + out + "/cases/mesh-1-0.ptf.xz").status == 0);
}

TEST_CASE("stress: somebody else's rasterizer, through a library and through files") {
  const Place place;
  const std::string library = std::string("library:") + HALFSPACE_STRESS_EXAMPLE;
  const Outcome right =
      place.run("stress --depth-bound 1 --cases 5 --family " + std::string(kInside) + " --engine " + library);
  CAPTURE(right.out, right.err);
  CHECK(right.status == 0);
  const Outcome refused = place.run("stress --depth float32 --cases 1 --family mesh --engine " + library);
  CHECK(refused.status == 1);
  CHECK(refused.out.find("only unorm24") != std::string::npos);

  const std::string cases = (place.path / "written").string();
  REQUIRE(place.run("stress --cases 1 --family mesh,permuted --write " + cases).status == 0);
  CHECK(entries(cases) == std::set<std::string>{"mesh-1-0.ptf", "permuted-1-0.ptf", "permuted-1-0-twin.ptf"});
  for (const char* name : {"mesh-1-0", "permuted-1-0", "permuted-1-0-twin"}) {
    REQUIRE(place
                .run("run " + cases + "/" + name + ".ptf --no-pictures --out " +
                     (place.path / "mine" / name).string())
                .status == 0);
  }
  const std::string files = " --engine files:" + (place.path / "mine").string();
  CHECK(place.run("stress --cases 1 --family mesh,permuted" + files).status == 0);
  const Outcome missing = place.run("stress --cases 2 --family mesh" + files);
  CHECK(missing.status == 1);
  CHECK(missing.out.find("mesh-1-1") != std::string::npos);
}

TEST_CASE("stress: the triangles of the grid find a rasterizer that is wrong") {
  const Place place;
  CHECK(place.run("stress --exhaustive --every 256").status == 0);
  CHECK(place.run("stress --exhaustive --every 256 --engine wrong:no_top").status == 1);
  const Outcome units = place.run("stress --exhaustive-units --every 512 --threads 2");
  CHECK(units.status == 0);
  CHECK(units.out.find(" 0 unsound; ") != std::string::npos);
}

TEST_CASE("stress: bad options") {
  const Place place;
  for (const char* options :
       {"--samples 0", "--cases 0", "--exhaustive --out x", "--sharpness --engine reference:exact",
        "--exhaustive-units --fidelity rtl", "--engine reference:exact --fidelity systemc",
        "--write x --sharpness", "--depth-bound 0", "--reports --family mesh", "--reports --exhaustive"}) {
    CAPTURE(options);
    const Outcome outcome = place.run(std::string("stress ") + options);
    CHECK(outcome.status != 0);
    CHECK(outcome.out.empty());
  }
  const Outcome engine = place.run("stress --engine mine");
  CHECK(engine.status == 2);
  CHECK(engine.err.find(
            "--engine is 'mine'; it must be library:FILE, files:DIR, reference:NAME or wrong:NAME") !=
        std::string::npos);
  CHECK(place.run("stress --family slivers").status != 0);
  CHECK(place.run("stress --engine library:/nowhere.so --cases 1").err.find("/nowhere.so cannot be loaded") !=
        std::string::npos);
}
