// Targets without depth: what covered their pixels, in every fidelity and by the references.
#include <catch2/catch.hpp>
#include <cstring>

#include "../frames.hpp"
#include "halfspace/report/npy.hpp"
#include "halfspace/scene/ptf.hpp"
#include "program.hpp"

using namespace halfspace::testing;
using halfspace::Flag;

namespace {

constexpr int kTargetSide = 16;

/// A rectangle with corners on the grid of pixels, as two triangles.
std::vector<glm::dvec3> rectangle(double left, double top, double right, double bottom) {
  return {{left, top, 0.5},  {right, top, 0.5},    {left, bottom, 0.5},
          {right, top, 0.5}, {right, bottom, 0.5}, {left, bottom, 0.5}};
}

/// Target 0 has depth. Of targets 1 to 3, which have none, 1 is only cleared; 2 takes a rectangle, a triangle
/// below x + y = 10.5 and, behind them, another rectangle; 3 takes a rectangle.
halfspace::Frame frame_of_bare_targets() {
  FrameBuilder builder(kTargetSide);
  halfspace::Target bare = builder.frame.targets[0];
  bare.depth_format = halfspace::DepthFormat::kNone;
  bare.depth_surface = halfspace::kNoSurface;
  builder.frame.targets.insert(builder.frame.targets.end(), 3, bare);
  builder.clear(0).target = 1;
  builder.draw(rectangle(0, 0, 4, 4));
  builder.draw(rectangle(2, 3, 9, 12)).target = 2;
  builder.draw({{0, 0, 0.1}, {10.5, 0, 0.1}, {0, 10.5, 0.1}}).target = 2;
  halfspace::Command& behind = builder.draw(rectangle(5, 5, 16, 7));
  behind.target = 2;
  behind.depth_func = halfspace::DepthFunc::kNever;  // no depth: nothing is tested
  builder.draw(rectangle(1, 1, 3, 15)).target = 3;
  return builder.frame;
}

int in_rectangle(int x, int y, int left, int top, int right, int bottom) {
  return x >= left && x < right && y >= top && y < bottom ? 1 : 0;
}

/// The centre (x + 0.5, y + 0.5) of a pixel is below x + y = 10.5 where the sum of its numbers is below 9.5.
int on_target_2(int x, int y) {
  return in_rectangle(x, y, 2, 3, 9, 12) + (x + y < 10 ? 1 : 0) + in_rectangle(x, y, 5, 5, 16, 7);
}
int on_target_3(int x, int y) { return in_rectangle(x, y, 1, 1, 3, 15); }

template <class Count>
bool counts_are(const fs::path& file, const Count& count) {
  const halfspace::NpyArray array = halfspace::read_npy(file);
  bool same = array.descr == "'<u2'" && array.shape == std::vector<std::uint64_t>{kTargetSide, kTargetSide};
  for (int y = 0; same && y < kTargetSide; ++y) {
    for (int x = 0; x < kTargetSide; ++x) {
      std::uint16_t value = 0;
      std::memcpy(&value, array.data.data() + 2 * (y * kTargetSide + x), 2);
      same = same && value == count(x, y);
    }
  }
  return same;
}

const std::set<std::string> kArrays{"stats.json",
                                    "depth0.npy",
                                    "fragments0.npy",
                                    "survivors0.npy",
                                    "fragments_target2.npy",
                                    "survivors_target2.npy",
                                    "fragments_target3.npy",
                                    "survivors_target3.npy"};

}  // namespace

TEST_CASE("run: the pixels of targets without depth are counted in every fidelity and by every reference") {
  const Place place;
  const fs::path file = place.path / "bare.ptf";
  halfspace::write_ptf(frame_of_bare_targets(), file);
  const std::string first = (place.path / "0").string();
  int number = 0;
  for (const char* options :
       {"--core fast", "--core readable", "--core fast --threads 2", "--fidelity recurrence",
        "--fidelity systemc", "--set hi_z.enabled=true", "--set tile_walker.tile_size=16",
        "--set tile_walker.tile_size=4 --set block_walker.block_size=16 --core fast", "--reference exact",
        "--reference scanline", "--reference incremental", "--reference barycentric"}) {
    CAPTURE(options);
    const fs::path out = place.path / std::to_string(number++);
    const Outcome outcome =
        place.run("run " + file.string() + " --no-pictures --out " + out.string() + " " + options);
    CAPTURE(outcome.err);
    REQUIRE(outcome.status == 0);
    CHECK(outcome.out.find("bare: 5 draws on 1 depth surfaces and 2 targets without depth") == 0);
    CHECK(entries(out) == kArrays);
    for (const char* kind : {"fragments", "survivors"}) {
      CHECK(counts_are(out / (std::string(kind) + "_target2.npy"), on_target_2));
      CHECK(counts_are(out / (std::string(kind) + "_target3.npy"), on_target_3));
    }
    const Json surfaces = read_stats(out)["surfaces"];
    REQUIRE(surfaces.size() == 3);
    CHECK(surfaces[0]["surface"] == 0);
    CHECK(surfaces[0]["target"].is_null());
    CHECK(surfaces[1]["surface"].is_null());
    CHECK(surfaces[1]["target"] == 2);
    CHECK(surfaces[1]["format"] == "none");
    CHECK(surfaces[1]["width"] == kTargetSide);
    CHECK(surfaces[1]["counters"]["quad_generator"]["fragments"] == 7 * 9 + 55 + 11 * 2);
    CHECK(surfaces[1]["counters"]["early_z"]["tested"] == 0);
    CHECK(surfaces[2]["target"] == 3);
    CHECK(surfaces[2]["counters"]["quad_generator"]["fragments"] == 2 * 14);
    if (std::string(options).find("--set") == std::string::npos) {
      CHECK(place.run("diff " + first + " " + out.string()).status == 0);
    }
  }
}

TEST_CASE("run: targets without depth have pictures of all but depth") {
  const Place place;
  const fs::path file = place.path / "bare.ptf";
  halfspace::write_ptf(frame_of_bare_targets(), file);
  std::set<std::string> expected = kArrays;
  for (const char* label : {"0", "_target2", "_target3"}) {
    for (const char* kind : {"shaded", "overdraw", "quads", "tiles"}) {
      expected.insert(std::string(kind) + label + ".png");
    }
  }
  expected.insert("depth0.png");
  const std::string run = "run " + file.string() + " --out ";
  for (const char* options : {" --core fast", " --core readable", " --fidelity systemc"}) {
    const fs::path out = place.path / "result";
    REQUIRE(place.run(run + out.string() + options).status == 0);
    CHECK(entries(out) == expected);
    CHECK(read_stats(out)["files"].get<std::set<std::string>>() == expected);
  }
  const fs::path colored = place.path / "colored";
  REQUIRE(place.run(run + colored.string() + " --reference barycentric").status == 0);
  for (const char* label : {"0", "_target2", "_target3"}) {
    CHECK(fs::exists(colored / (std::string("colors") + label + ".png")));
  }
}

TEST_CASE("diff: finds a pixel of a target without depth that differs") {
  const Place place;
  halfspace::Frame frame = frame_of_bare_targets();
  const std::string out = place.path.string();
  halfspace::write_ptf(frame, place.path / "a.ptf");
  frame.commands.back().scissor = {0, 0, 16, 14};
  halfspace::write_ptf(frame, place.path / "b.ptf");
  for (const std::string name : {"a", "b"}) {
    REQUIRE(place.run("run " + out + "/" + name + ".ptf --no-pictures --out " + out + "/" + name).status ==
            0);
  }
  const Outcome outcome = place.run("diff " + out + "/a " + out + "/b");
  CHECK(outcome.status == 1);
  CHECK(outcome.out.find("fragments_target3.npy: 2 differences, first: pixel (1, 14): value 1 and 0") !=
        std::string::npos);
  CHECK(outcome.out.find("fragments_target2.npy:") == std::string::npos);
}
