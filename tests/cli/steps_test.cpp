// run --steps: the walk of each triangle, held against the definitions of the orders; run --time.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "halfspace/report/npy.hpp"
#include "program.hpp"

using namespace halfspace::testing;

namespace {

#pragma pack(push, 1)
struct Triangle {  // docs/guides/results.md
  std::uint32_t draw, triangle, surface;
  std::uint8_t verdict, shape;
  std::int32_t x[3], y[3], x_first, y_first, x_last, y_last;
};
struct Step {
  std::uint32_t draw, triangle, x, y;
  std::uint16_t side;
  std::uint8_t kind, sample;
  std::uint64_t touched, left;
};
#pragma pack(pop)
enum : std::uint8_t { kLead, kDecide, kJob };

template <class Record>
std::vector<Record> records(const fs::path& file) {
  const halfspace::NpyArray array = halfspace::read_npy(file);
  REQUIRE(array.data.size() == array.shape.at(0) * sizeof(Record));
  std::vector<Record> all(array.shape[0]);
  std::memcpy(all.data(), array.data.data(), array.data.size());
  return all;
}

/// The upper left half of 64 x 64 pixels, with vertices on their corners, as a mesh, and how it is seen so.
std::string half_square(const Place& place) {
  const fs::path mesh = place.path / "half.obj";
  std::ofstream(mesh) << "v -1 1 0\nv -1 -1 0\nv 1 1 0\nf 1 2 3\n";
  return "run " + mesh.string() + " --size 64x64 --eye 0,0,1 --at 0,0,0 --fov 90 --steps ";
}

using Cells = std::vector<std::pair<int, int>>;

/// The tiles of the flat walk over the half square in this order, by column and row, as they are decided.
Cells flat_walk(const Place& place, const std::string& order) {
  const std::string out = (place.path / order).string();
  REQUIRE(place
              .run(half_square(place) + "--set block_walker.levels=1 --set block_walker.order=" + order +
                   " --out " + out)
              .status == 0);
  Cells cells;
  for (const Step& step : records<Step>(place.path / order / "steps.npy")) {
    if (step.kind == kDecide) {
      CHECK(step.side == 8);
      const int x = static_cast<int>(step.x) / 8;
      const int y = static_cast<int>(step.y) / 8;
      CHECK((step.left != 0) == (x + y <= 7));
      cells.emplace_back(x, y);
    }
  }
  return cells;
}

/// The number on Morton's curve: the bits of column and row by turns.
int morton(const std::pair<int, int>& cell) {
  int number = 0;
  for (int bit = 0; bit < 3; ++bit) {
    number |= (cell.first >> bit & 1) << (2 * bit) | (cell.second >> bit & 1) << (2 * bit + 1);
  }
  return number;
}

}  // namespace

TEST_CASE("steps: the triangle has the vertices that setup takes, and its bounds") {
  const Place place;
  REQUIRE(place.run(half_square(place) + "--out " + place.path.string() + "/a").status == 0);
  const std::vector<Triangle> triangles = records<Triangle>(place.path / "a" / "triangles.npy");
  REQUIRE(triangles.size() == 1);
  const Triangle& t = triangles[0];
  CHECK((t.draw == 0 && t.triangle == 0 && t.surface == 0 && t.verdict == 0 && t.shape == 0));
  CHECK((t.x[0] == 0 && t.x[1] == 0 && t.x[2] == 64 * 256));
  CHECK((t.y[0] == 0 && t.y[1] == 64 * 256 && t.y[2] == 0));
  CHECK((t.x_first == 0 && t.y_first == 0 && t.x_last == 63 && t.y_last == 63));
}

TEST_CASE("steps: flat walks visit the tiles of the bounds by the definitions of their orders") {
  const Place place;
  Cells rows;
  Cells back_and_forth;
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      rows.emplace_back(x, y);
      back_and_forth.emplace_back(y % 2 == 0 ? x : 7 - x, y);
    }
  }
  CHECK(flat_walk(place, "raster") == rows);
  CHECK(flat_walk(place, "boustrophedonic") == back_and_forth);
  const Cells curve = flat_walk(place, "morton");
  REQUIRE(curve.size() == 64);
  for (int i = 0; i < 64; ++i) {
    CHECK(morton(curve[static_cast<std::size_t>(i)]) == i);
  }
  // Hilbert's curve goes from neighbour to neighbour, and ends in a corner beside that of its beginning.
  Cells hilbert = flat_walk(place, "hilbert");
  REQUIRE(hilbert.size() == 64);
  for (std::size_t i = 1; i < 64; ++i) {
    CHECK(std::abs(hilbert[i].first - hilbert[i - 1].first) +
              std::abs(hilbert[i].second - hilbert[i - 1].second) ==
          1);
  }
  CHECK(std::abs(hilbert[63].first - hilbert[0].first) + std::abs(hilbert[63].second - hilbert[0].second) ==
        7);
  std::sort(hilbert.begin(), hilbert.end(),
            [](auto a, auto b) { return std::pair(a.second, a.first) < std::pair(b.second, b.first); });
  CHECK(hilbert == rows);
}

TEST_CASE("steps: every walk has as many steps and jobs as the counters, each job in what was decided last") {
  const Place place;
  const int samples = GENERATE(1, 4);
  for (const char* walk :
       {"levels=1 --set block_walker.order=backtracking", "levels=1 --set block_walker.order=zigzag",
        "levels=2", "levels=2 --set block_walker.order=hilbert --set tile_walker.order=hilbert",
        "levels=2 --set block_walker.order=backtracking", "levels=3",
        "levels=3 --set block_walker.order=morton --set tile_walker.order=morton"}) {
    CAPTURE(walk);
    REQUIRE(place
                .run("run " + kCube +
                     " --no-pictures --steps --set raster.samples=" + std::to_string(samples) +
                     " --set block_walker." + walk + " --out " + place.path.string() + "/a")
                .status == 0);
    const Json counters = read_stats(place.path / "a")["frame"]["counters"];
    std::uint64_t count[3] = {};
    Step decided{};
    bool inside = true;
    for (const Step& step : records<Step>(place.path / "a" / "steps.npy")) {
      REQUIRE(step.kind <= kJob);
      ++count[step.kind];
      if (step.kind == kDecide) {
        decided = step;
      } else if (step.kind == kJob) {
        const std::uint32_t row = decided.side == 8 ? 1 : decided.side / 8;
        const std::uint32_t tile = (step.y - decided.y) / 8 * row + (step.x - decided.x) / 8;
        inside &= step.triangle == decided.triangle && step.side == 8 && step.sample < samples &&
                  step.x - decided.x < decided.side && step.y - decided.y < decided.side;
        inside &= decided.side == 8 ? decided.left != 0 : (decided.left >> tile & 1) != 0;
      }
    }
    CHECK(inside);
    CHECK(count[kLead] == counters["block_walker"]["passes"]);
    CHECK(count[kDecide] == counters["block_walker"]["blocks"]);
    CHECK(count[kJob] == counters["tile_walker"]["tiles_accepted"].get<std::uint64_t>() +
                             counters["tile_walker"]["tiles_partial"].get<std::uint64_t>());
    const auto triangles = records<Triangle>(place.path / "a" / "triangles.npy");
    CHECK(triangles.size() == counters["setup"]["triangles"]);
    CHECK(static_cast<std::uint64_t>(std::count_if(triangles.begin(), triangles.end(), [](const Triangle& t) {
            return t.verdict == 0;
          })) == counters["setup"]["drawn"]);
  }
}

TEST_CASE("steps: the recurrence records the same; others refuse by name") {
  const Place place;
  const auto run = [&](const char* options, const char* name) {
    return place.run("run " + kCube + " --no-pictures --steps " + options + " --out " +
                     (place.path / name).string());
  };
  REQUIRE(run("", "a").status == 0);
  REQUIRE(run("--fidelity recurrence", "b").status == 0);
  const Outcome outcome =
      place.run("diff " + (place.path / "a").string() + " " + (place.path / "b").string());
  CHECK(outcome.status == 0);
  REQUIRE(run("--set block_walker.order=hilbert", "b").status == 0);
  CHECK(place.run("diff " + (place.path / "a").string() + " " + (place.path / "b").string())
            .out.find("steps.npy") != std::string::npos);
  for (const char* fidelity : {"systemc", "rtl"}) {
    check_error(run((std::string("--fidelity ") + fidelity).c_str(), "c"),
                {fidelity, "--steps", "functional, recurrence"});
  }
  check_error(run("--reference exact", "c"), {"--reference is 'exact'", "--steps"});
  check_error(run("--core fast", "c"), {"core is 'fast'", "packets are recorded"});
  check_error(place.run("run " + kCube + " --steps"), {"--steps", "--out"});
}

TEST_CASE("time: a pass of what was asked for, and the files stay the same") {
  const Place place;
  const auto run = [&](const std::string& options) { return place.run("run " + kCube + " " + options); };
  const auto nanoseconds = [&](const Outcome& outcome, const char* by) {
    REQUIRE(outcome.status == 0);
    const std::size_t line = outcome.out.find("\n  time ");
    REQUIRE(line != std::string::npos);
    CAPTURE(outcome.out);
    CHECK(outcome.out.find("ns a frame, the median of 3 passes of " + std::string(by), line) !=
          std::string::npos);
    return std::stod(outcome.out.substr(line + 8));
  };
  // Half a million samples of the clear and the cube take more than a microsecond and less than a minute.
  for (const auto& [options, by] :
       {std::pair{"", "functional on the fast core"},
        std::pair{"--core readable", "functional on the readable core"},
        std::pair{"--fidelity recurrence", "recurrence on the"}, std::pair{"--fidelity systemc", "systemc\n"},
        std::pair{"--reference scanline", "the reference scanline\n"}}) {
    const double time = nanoseconds(run(std::string(options) + " --time 3"), by);
    CHECK((time > 1e3 && time < 6e10));
  }
  const std::string a = (place.path / "a").string();
  const std::string b = (place.path / "b").string();
  REQUIRE(run("--quads --out " + a).status == 0);
  REQUIRE(run("--quads --time 2 --out " + b).status == 0);
  for (const std::string& name : entries(a)) {
    CHECK(slurp(fs::path(a) / name) == slurp(fs::path(b) / name));
  }
  CHECK(run("").out.find("\n  time ") == std::string::npos);
  check_error(run("--time 0"), {"--time", "0", "1 to 1000"});
}
