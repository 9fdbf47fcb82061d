// The program: its results, its errors, its exit status.
#include "program.hpp"

#include <catch2/catch.hpp>
#include <cstring>
#include <fstream>

#include "halfspace/report/npy.hpp"

using namespace halfspace::testing;

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
  const Json stats = read_stats(out);
  CHECK(stats["files"].get<std::set<std::string>>() == expected);
  CHECK(stats["schema_version"] == 5);
  CHECK(stats["cycles"].is_null());
  CHECK(stats["seed"].is_null());
  CHECK(stats["stalls"].is_null());
  CHECK(!stats["frame"].contains("time"));
  CHECK(!stats["draws"][0].contains("time"));
  CHECK(stats["frame"]["counters"]["quad_generator"]["fragments"] == 74783);
  CHECK(stats["config"]["tile_walker.tile_size"] == "8");

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

TEST_CASE("run: both cores write the same files") {
  const Place place;
  for (const char* frame : {"vkcube.ptf.xz", "cc0_truck.ptf.xz"}) {
    const std::string run = "run " + scene(frame) + " --out " + place.path.string();
    REQUIRE(place.run(run + "/a --core fast").status == 0);
    REQUIRE(place.run(run + "/b --core readable").status == 0);
    for (const std::string& name : entries(place.path / "a")) {
      CAPTURE(frame, name);
      std::string ours = slurp(place.path / "a" / name);
      const std::string fast = "\"core\": \"fast\"";
      if (name == "stats.json") {
        REQUIRE(ours.find(fast) != std::string::npos);
        ours.replace(ours.find(fast), fast.size(), "\"core\": \"readable\"");
      }
      CHECK(ours == slurp(place.path / "b" / name));
    }
  }
}

TEST_CASE("run: the core is one that there is, of a fidelity that has one, and covers the run") {
  const Place place;
  const std::string run = "run " + scene("vkcube.ptf.xz") + " ";
  check_error(place.run(run + "--core quick"), {"--core", "quick", "auto,fast,readable"});
  check_error(place.run(run + "--core fast --fidelity systemc"),
              {"systemc", "core", "legal", "functional", "recurrence"});
  check_error(place.run(run + "--core fast --set tile_walker.tile_size=16"),
              {"core is 'fast'", "tile_walker.tile_size = 16", "legal: auto, readable"});
  CHECK(place.run(run + "--core fast --fidelity recurrence").status == 0);
  check_error(place.run(run + "--core fast --fidelity recurrence --timeline --no-pictures --out " +
                        (place.path / "results").string()),
              {"core is 'fast'", "a timeline"});
  check_error(place.run(run + "--core fast --quads --out " + place.path.string() + "/quads"),
              {"core is 'fast'", "packets are recorded"});
}

TEST_CASE("record: both cores write the same file") {
  const Place place;
  const fs::path file = place.path / "packets.rec";
  const std::string record = "record " + scene("cc0_truck.ptf.xz") + " --out " + file.string() + " --core ";
  REQUIRE(place.run(record + "fast").status == 0);
  const std::string ours = slurp(file);
  REQUIRE(place.run(record + "readable").status == 0);
  CHECK(ours == slurp(file));
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
    REQUIRE(place.run(run + "/b --set tile_walker.tile_size=16").status == 0);
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
  SECTION("a run with time has the same function") {
    REQUIRE(place.run(run + "/b --fidelity recurrence").status == 0);
    const Outcome outcome = place.run(diff);
    CAPTURE(outcome.out);
    CHECK(outcome.status == 0);
  }
  SECTION("the two engines that move packets agree in everything") {
    const std::string stalls = " --stall source:30:9 --stall edge_evaluator:20:30 --seed 4";
    REQUIRE(place.run(run + "/a --fidelity recurrence" + stalls).status == 0);
    REQUIRE(place.run(run + "/b --fidelity systemc" + stalls).status == 0);
    const Outcome outcome = place.run(diff);
    CAPTURE(outcome.out);
    CHECK(outcome.status == 0);
  }
  SECTION("a byte order mark in stats.json is none of its text") {
    const fs::path stats = place.path / "b" / "stats.json";
    const std::string text = slurp(stats);
    std::ofstream(stats, std::ios::binary) << "\xEF\xBB\xBF" << text;
    CHECK(place.run(diff).status == 0);
    CHECK(place.run(run + "/b").status == 0);  // it is still the result of a run
  }
  SECTION("two runs with time are compared in time too") {
    REQUIRE(place.run(run + "/a --fidelity recurrence").status == 0);
    REQUIRE(place.run(run + "/b --fidelity recurrence").status == 0);
    CHECK(place.run(diff).status == 0);
    REQUIRE(place.run(run + "/b --fidelity recurrence --set memory.latency=101").status == 0);
    const Outcome outcome = place.run(diff);
    CHECK(outcome.status == 1);
    CHECK(outcome.out.find("quads.npy: ") == 0);
    CHECK(outcome.out.find("cycle ") != std::string::npos);
    CHECK(outcome.out.find("stats.json: ") != std::string::npos);
    CHECK(outcome.out.find("frame/time/") != std::string::npos);
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
  check_error(place.run("run " + cube + " --set tile_walker.tile_size=5"),
              {"tile_walker.tile_size", "'5'", "4, 8, 16"});
  check_error(place.run("run " + cube + " --set tile_walker.tile_sise=8"),
              {"unknown", "tile_walker.tile_sise", "tile_walker.tile_size"});
  check_error(place.run("run " + cube + " --set raster.sub_pixel_bits=9"),
              {"raster.sub_pixel_bits", "'9'", "4 to 8"});
  check_error(place.run("run " + cube + " --set tile_walker.tile_size=16 --set block_walker.block_size=16"),
              {"block_walker.block_size", "16"});
  check_error(place.run("run " + cube + " --set late_z"), {"late_z", "KEY=VALUE"});
  check_error(place.run("run " + cube + " --fidelity guess"), {"guess", "functional", "rtl"});
  check_error(place.run("run " + cube + " --quads"), {"--quads", "--out"});
  check_error(place.run("run " + cube + " --timeline"), {"--timeline", "--out"});
  check_error(place.run("run " + cube + " --timeline-draws 0:1"), {"--timeline-draws", "--timeline"});
  const std::string timed = "run " + cube + " --fidelity recurrence";
  for (const char* stall : {"sink", "sink:10", "sink:10:4:1", "sink:101:4", "sink:-1:4", "sink:10:0",
                            "sink:10:65536", "drain:10:4", "sink:10:", ":10:4"}) {
    CAPTURE(stall);
    check_error(place.run(timed + " --stall " + stall),
                {"--stall", stall,
                 "source, setup, block_walker, hi_z, tile_walker, edge_evaluator, quad_generator, sink",
                 "0 to 100", "1 to 65535"});
  }
  check_error(place.run(timed + " --stall sink:10:4 --stall sink:10:5"),
              {"--stall", "sink:10:5", "given before"});
  for (const char* seed : {"-1", "many", "1:2", "18446744073709551616"}) {
    check_error(place.run(timed + " --seed=" + seed), {"--seed", seed, "0 to 18446744073709551615"});
  }
  check_error(place.run("run " + cube + " --stall sink:10:4"), {"--stall", "functional", "recurrence"});
  check_error(place.run("run " + cube + " --fidelity sampled"),
              {"--fidelity", "sampled", "functional,recurrence,systemc,rtl"});
  check_error(place.run("run " + cube + " --fidelity recurrence --vcd w.vcd"),
              {"--vcd", "recurrence", "systemc"});
  check_error(place.run("run " + cube + " --fidelity recurrence --rtl-every-cycle"),
              {"--rtl-every-cycle", "recurrence", "rtl"});
  check_error(place.run("run " + cube + " --fidelity systemc --vcd /proc/nowhere/w"),
              {"/proc/nowhere/w.vcd", "cannot be written"});
  check_error(place.run("run " + cube + " --seed 1"), {"--seed", "functional", "recurrence"});
  check_error(place.run("run nothing.ptf"), {"nothing.ptf"});
  check_error(place.run("run " + scene("README.md")), {"README.md", ".ptf"});
  check_error(place.run("run " + cube + " --config nothing.toml"), {"nothing.toml"});
  std::ofstream(place.path / "a.obj") << "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n";
  const std::string mesh = (place.path / "a.obj").string();
  check_error(place.run("run " + mesh + " --eye 1,2"), {"--eye", "'1,2'", "X,Y,Z"});
  check_error(place.run("run " + mesh + " --size 10"), {"--size", "'10'", "16384"});
  check_error(place.run("run"), {"INPUT"});
  check_error(place.run("nonsense"), {"nonsense"});
  std::ofstream(place.path / "bad.toml") << "[tile_walker]\ntile_size = \"large\"\n";
  check_error(place.run("config --config " + (place.path / "bad.toml").string()),
              {"bad.toml", "tile_walker.tile_size", "'large'"});
  std::ofstream(place.path / "worse.toml") << "[tile_walker\n";
  check_error(place.run("config --config " + (place.path / "worse.toml").string()), {"worse.toml", "line 1"});
}

TEST_CASE("help is there for every command, and info and config say what they should") {
  const Place place;
  for (const char* command :
       {"", "run", "info", "config", "diff", "bench", "bench speed", "bench stages", "bench surfaces"}) {
    const Outcome outcome = place.run(std::string(command) + " --help");
    CHECK(outcome.status == 0);
    CHECK(outcome.out.find("Usage") != std::string::npos);
  }
  const Outcome info = place.run("info --commands " + scene("vkcube.ptf.xz"));
  CHECK(info.status == 0);
  CHECK(info.out.find("1 targets, 1 draws, 1 clears, 12 triangles") != std::string::npos);
  CHECK(info.out.find("500x500 depth unorm16 surface 0") != std::string::npos);
}

TEST_CASE("run: with time, quads leave in the order of their cycles, at most the width of early_z in one") {
  const Place place;
  const fs::path out = place.path / "result";
  REQUIRE(place
              .run("run " + scene("vkcube.ptf.xz") + " --fidelity recurrence --quads --no-pictures --out " +
                   out.string())
              .status == 0);
  const halfspace::NpyArray quads = halfspace::read_npy(out / "quads.npy");
  constexpr std::size_t kRecord = 46;
  constexpr std::size_t kCycleAt = 38;
  std::uint64_t before = 0;
  int together = 0;
  for (std::size_t at = 0; at < quads.data.size(); at += kRecord) {
    std::uint64_t cycle = 0;
    std::memcpy(&cycle, quads.data.data() + at + kCycleAt, sizeof cycle);
    REQUIRE(cycle >= before);
    together = cycle == before ? together + 1 : 1;
    REQUIRE(together <= 4);
    before = cycle;
  }
  CHECK(before == read_stats(out)["draws"][0]["time"]["end"]);
}

TEST_CASE("run: stalls are a function of their seed, cost time and nothing else") {
  const Place place;
  const std::string run =
      "run " + scene("vkcube.ptf.xz") + " --no-pictures --fidelity recurrence --out " + place.path.string();
  const std::string stalls = " --stall sink:30:20 --stall tile_walker:10:65535";
  REQUIRE(place.run(run + "/plain").status == 0);
  REQUIRE(place.run(run + "/a --seed 7" + stalls).status == 0);
  REQUIRE(place.run(run + "/b --seed 7" + stalls).status == 0);
  REQUIRE(place.run(run + "/c --seed 8" + stalls).status == 0);
  const auto stats = [&](const char* name) { return read_stats(place.path / name); };
  CHECK(stats("a") == stats("b"));
  CHECK(stats("a")["cycles"] != stats("c")["cycles"]);
  CHECK(stats("a")["cycles"] > stats("plain")["cycles"]);
  CHECK(stats("a")["seed"] == 7);
  CHECK(stats("a")["stalls"] == Json{{"sink", {{"percent", 30}, {"max_cycles", 20}}},
                                     {"tile_walker", {{"percent", 10}, {"max_cycles", 65535}}}});
  CHECK(stats("plain")["seed"] == 0);
  CHECK(stats("plain")["stalls"] == Json::object());
  CHECK(stats("a")["frame"]["counters"] == stats("plain")["frame"]["counters"]);
  CHECK(slurp(place.path / "a" / "depth0.npy") == slurp(place.path / "plain" / "depth0.npy"));
}

TEST_CASE("retime: a table of machines, exact or sampled") {
  const Place place;
  const std::string record = (place.path / "truck.rec").string();
  REQUIRE(place.run("record " + scene("cc0_truck.ptf.xz") + " --out " + record).status == 0);
  const std::string sweep = "retime " + record + " --sweep memory.latency=20,200 --json ";
  std::vector<Json> results;
  for (const std::string fidelity : {"recurrence", "sampled"}) {
    const std::string file = (place.path / fidelity).string();
    const Outcome outcome = place.run(sweep + file + " --fidelity " + fidelity);
    REQUIRE(outcome.status == 0);
    CHECK(outcome.out.find("| cc0_truck | recorded | 200 | ") != std::string::npos);
    results.push_back(Json::parse(slurp(file)));
    CHECK(results.back()["fidelity"] == fidelity);
  }
  for (std::size_t i = 0; i < 2; ++i) {
    const double exact = results[0]["machines"][i]["cycles"].get<double>();
    const double sampled = results[1]["machines"][i]["cycles"].get<double>();
    CHECK(sampled != exact);
    CHECK(sampled == Approx(exact).epsilon(0.15));
  }
  const Outcome outcome =
      place.run("retime " + record + " --fidelity sampled --set tile_walker.tile_size=16");
  check_error(outcome, {"tile_walker.tile_size", "a new record"});
}

TEST_CASE("run: systemc writes a waveform") {
  const Place place;
  const std::string run =
      "run " + scene("vkcube.ptf.xz") + " --fidelity systemc --vcd " + place.path.string();
  for (const char* name : {"/a.vcd", "/b"}) {
    REQUIRE(place.run(run + name).status == 0);
  }
  for (const char* name : {"a.vcd", "b.vcd"}) {
    CHECK(slurp(place.path / name).find("$enddefinitions") != std::string::npos);
  }
}

TEST_CASE("run: the table says where the cycles went, where there are some") {
  const Place place;
  const std::string run = "run " + scene("vkcube.ptf.xz");
  CHECK(place.run(run).out.find("cycle") == std::string::npos);
  const std::string table = place.run(run + " --fidelity recurrence").out;
  CAPTURE(table);
  for (const char* part : {"\n  cycles  ", "quads a cycle\n", "\n  z_lookup  ", "%  busy, ", "no_credit ",
                           "\n  memory  ", "of the cycles), "}) {
    CHECK(table.find(part) != std::string::npos);
  }
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
  const Json stats = read_stats(place.path / "r");
  const double fragments = stats["frame"]["counters"]["quad_generator"]["fragments"];
  CHECK(fragments >= 43 * 43);
  CHECK(fragments <= 44 * 44);
}
