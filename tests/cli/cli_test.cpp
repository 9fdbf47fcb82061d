// The program: its results, its errors, its exit status.
#include <sys/wait.h>

#include <catch2/catch.hpp>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "halfspace/report/npy.hpp"

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

struct Outcome {
  int status = -1;
  std::string out;
  std::string err;
};

std::string slurp(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A folder for one test, empty at first and removed afterwards.
class Place {
 public:
  Place() {
    std::string pattern = (fs::temp_directory_path() / "halfspace_cli.XXXXXX").string();
    REQUIRE(mkdtemp(pattern.data()) != nullptr);
    path = pattern;
  }
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;
  ~Place() { fs::remove_all(path); }

  [[nodiscard]] Outcome run(const std::string& arguments) const {
    const std::string command = std::string(HALFSPACE_PROGRAM) + " " + arguments + " >" +
                                (path / "out").string() + " 2>" + (path / "err").string() + " </dev/null";
    const int status = std::system(command.c_str());
    Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1, slurp(path / "out"), slurp(path / "err")};
    return outcome;
  }

  fs::path path;
};

std::string scene(const char* name) { return std::string(HALFSPACE_SOURCE) + "/scenes/" + name; }

std::set<std::string> entries(const fs::path& folder) {
  std::set<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    names.insert(entry.path().filename().string());
  }
  return names;
}

/// One line on stderr that holds all of `parts`, and a status that is not 0.
void check_error(const Outcome& outcome, std::initializer_list<const char*> parts) {
  CAPTURE(outcome.out, outcome.err);
  CHECK(outcome.status != 0);
  CHECK(outcome.status != -1);
  CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
  for (const char* part : parts) {
    CAPTURE(part);
    CHECK(outcome.err.find(part) != std::string::npos);
  }
}

}  // namespace

TEST_CASE("run: writes every file of the contract, and stats.json lists them") {
  const Place place;
  const fs::path out = place.path / "result";
  const Outcome outcome =
      place.run("run " + scene("vkcube.ptf.xz") + " --quads --tiles --out " + out.string());
  REQUIRE(outcome.status == 0);
  CHECK(outcome.err.empty());
  const std::set<std::string> expected{"stats.json",    "depth0.npy", "fragments0.npy", "survivors0.npy",
                                       "quads.npy",     "tiles.npy",  "shaded0.png",    "depth0.png",
                                       "overdraw0.png", "tiles0.png", "quads0.png"};
  CHECK(entries(out) == expected);
  const Json stats = Json::parse(slurp(out / "stats.json"));
  CHECK(stats["files"].get<std::set<std::string>>() == expected);
  CHECK(stats["schema_version"] == 1);
  CHECK(stats["frame"]["counters"]["quad_generator"]["fragments"] == 74783);
  CHECK(stats["config"]["walker.tile_size"] == "8");

  const halfspace::NpyArray depth = halfspace::read_npy(out / "depth0.npy");
  CHECK(depth.descr == "'<f4'");
  CHECK(depth.shape == std::vector<std::uint64_t>{500, 500});
  const halfspace::NpyArray quads = halfspace::read_npy(out / "quads.npy");
  CHECK(quads.descr ==
        "[('draw','<u4'),('triangle','<u4'),('surface','<u4'),('x','<u4'),('y','<u4'),('mask','|u1'),('"
        "passed','|u1'),"
        "('depth','<u4',(4,)),('cycle','<u8')]");
  CHECK(quads.shape == std::vector<std::uint64_t>{19263});
  CHECK(quads.data.size() == 19263u * 46);
}

TEST_CASE("run: replaces an earlier result, refuses any other folder, leaves nothing half-written") {
  const Place place;
  const std::string out = (place.path / "result").string();
  const std::string command = "run " + scene("vkcube.ptf.xz") + " --no-pictures --out " + out;
  REQUIRE(place.run(command + " --quads").status == 0);
  REQUIRE(place.run(command).status == 0);
  CHECK(entries(out).count("quads.npy") == 0);
  SECTION("a folder with something else") {
    std::ofstream(place.path / "result" / "mine.txt") << "keep";
    check_error(place.run(command), {out.c_str(), "not of an earlier run"});
    CHECK(fs::exists(place.path / "result" / "mine.txt"));
  }
  SECTION("a file in the way") {
    std::ofstream(place.path / "file") << "keep";
    check_error(place.run("run " + scene("vkcube.ptf.xz") + " --out " + (place.path / "file").string()),
                {"file", "folder"});
  }
  SECTION("a place that cannot be written") {
    check_error(place.run("run " + scene("vkcube.ptf.xz") + " --out /proc/nowhere/out"),
                {"/proc/nowhere/out", "cannot be made"});
  }
  SECTION("a folder whose parent is a file") {
    std::ofstream(place.path / "file") << "keep";
    check_error(place.run("run " + scene("vkcube.ptf.xz") + " --out " + (place.path / "file" / "x").string()),
                {"cannot be made"});
  }
  CHECK(entries(place.path).count("result") == 1);
  for (const std::string& name : entries(place.path)) {
    CHECK(name.rfind(".result.", 0) != 0);
  }
}

TEST_CASE("diff: 0 for equal runs, 1 and the first difference for others") {
  const Place place;
  const std::string run =
      "run " + scene("vkcube.ptf.xz") + " --no-pictures --quads --tiles --out " + place.path.string();
  REQUIRE(place.run(run + "/a").status == 0);
  REQUIRE(place.run(run + "/b").status == 0);
  const std::string diff = "diff " + place.path.string() + "/a " + place.path.string() + "/b";
  CHECK(place.run(diff).status == 0);
  SECTION("another machine walks otherwise and draws the same") {
    REQUIRE(place.run(run + "/b --set walker.tile_size=16").status == 0);
    const Outcome outcome = place.run(diff);
    CHECK(outcome.status == 1);
    CHECK(outcome.out.find("tiles.npy: ") != std::string::npos);
    CHECK(outcome.out.find("depth0.npy") == std::string::npos);
  }
  SECTION("one flipped bit is found, with its quad and field") {
    std::fstream file(place.path / "b" / "quads.npy", std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(0, std::ios::end);
    const std::streamoff at =
        static_cast<std::streamoff>(file.tellg()) - 46 * 100 + 20;  // field mask, 100th from the end
    file.seekg(at);
    const char mask = static_cast<char>(file.get());
    file.seekp(at);
    file.put(static_cast<char>(mask ^ 8));
    file.close();
    const Outcome outcome = place.run(diff);
    CHECK(outcome.status == 1);
    CHECK(outcome.out.find("quads.npy: 1 differences, first: record 19163 (draw 0, triangle ") == 0);
    CHECK(outcome.out.find("mask ") != std::string::npos);
  }
  SECTION("damage is an error") {
    fs::resize_file(place.path / "b" / "depth0.npy", 1000);
    check_error(place.run(diff), {"depth0.npy", "bytes"});
  }
  SECTION("so is a folder that is no result") {
    check_error(place.run("diff " + place.path.string() + "/a /"), {"is not the result of a run"});
  }
}

TEST_CASE("errors are one line that names the thing, its value and what is legal") {
  const Place place;
  const std::string cube = scene("vkcube.ptf.xz");
  check_error(place.run("run " + cube + " --set walker.tile_size=5"),
              {"walker.tile_size", "'5'", "4, 8, 16"});
  check_error(place.run("run " + cube + " --set walker.tile_sise=8"),
              {"unknown", "walker.tile_sise", "walker.tile_size"});
  check_error(place.run("run " + cube + " --set raster.sub_pixel_bits=9"),
              {"raster.sub_pixel_bits", "'9'", "4 to 8"});
  check_error(place.run("run " + cube + " --set walker.tile_size=16 --set walker.block_size=16"),
              {"walker.block_size", "16"});
  check_error(place.run("run " + cube + " --set late_z"), {"late_z", "KEY=VALUE"});
  check_error(place.run("run " + cube + " --fidelity rtl"), {"rtl", "functional"});
  check_error(place.run("run " + cube + " --quads"), {"--quads", "--out"});
  check_error(place.run("run nothing.ptf"), {"nothing.ptf"});
  check_error(place.run("run " + scene("README.md")), {"README.md", ".ptf"});
  check_error(place.run("run " + cube + " --config nothing.toml"), {"nothing.toml"});
  check_error(place.run("run " + cube + " --eye 1,2"), {"--eye", "'1,2'", "X,Y,Z"});
  check_error(place.run("run " + cube + " --size 10"), {"--size", "'10'", "16384"});
  check_error(place.run("run"), {"INPUT"});
  check_error(place.run("nonsense"), {"nonsense"});
  std::ofstream(place.path / "bad.toml") << "[walker]\ntile_size = \"large\"\n";
  check_error(place.run("config --config " + (place.path / "bad.toml").string()),
              {"bad.toml", "walker.tile_size", "'large'"});
  std::ofstream(place.path / "worse.toml") << "[walker\n";
  check_error(place.run("config --config " + (place.path / "worse.toml").string()), {"worse.toml", "line 1"});
}

TEST_CASE("help is there for every command, and info and config say what they should") {
  const Place place;
  for (const char* command : {"", "run", "info", "config", "diff", "bench", "bench speed"}) {
    const Outcome outcome = place.run(std::string(command) + " --help");
    CHECK(outcome.status == 0);
    CHECK(outcome.out.find("Usage") != std::string::npos);
  }
  const Outcome info = place.run("info --commands " + scene("vkcube.ptf.xz"));
  CHECK(info.status == 0);
  CHECK(info.out.find("1 targets, 1 draws, 1 clears, 12 triangles") != std::string::npos);
  CHECK(info.out.find("500x500 depth unorm16 surface 0") != std::string::npos);
  const Outcome bench = place.run("bench speed --repeat 1 " + scene("vkcube.ptf.xz"));
  CHECK(bench.status == 0);
  CHECK(bench.out.find("Mquads/s") != std::string::npos);
}

TEST_CASE("configs/baseline.toml lists every key with its default") {
  const Place place;
  const Outcome defaults = place.run("config --toml");
  CHECK(defaults.status == 0);
  CHECK(slurp(fs::path(HALFSPACE_SOURCE) / "configs" / "baseline.toml") == defaults.out);
  CHECK(place.run("config --config " + std::string(HALFSPACE_SOURCE) + "/configs/baseline.toml").out ==
        place.run("config").out);
}

TEST_CASE("a mesh runs with a camera of its own") {
  const Place place;
  std::ofstream(place.path / "cube.obj") << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
  const std::string cube = (place.path / "cube.obj").string();
  const Outcome outcome =
      place.run("run " + cube + " --eye 0.5,0.5,2 --at 0.5,0.5,0 --fov 60 --size 200x100 --out " +
                (place.path / "r").string());
  REQUIRE(outcome.status == 0);
  // The square spans 1 / (2 tan 30 degrees * 2) of the height: 43.3 pixels on a side.
  const Json stats = Json::parse(slurp(place.path / "r" / "stats.json"));
  const double fragments = stats["frame"]["counters"]["quad_generator"]["fragments"];
  CHECK(fragments >= 43 * 43);
  CHECK(fragments <= 44 * 44);
}
