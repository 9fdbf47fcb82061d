// The named machines in configs/.
#include "program.hpp"

#include <catch2/catch.hpp>
#include <map>
#include <regex>

#include "halfspace/config/config.hpp"
#include "halfspace/timing/contract.hpp"
#include "halfspace/timing/rtl/pipeline_arguments.hpp"

using namespace halfspace::testing;

namespace {

std::map<std::string, fs::path> machines() {
  std::map<std::string, fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(HALFSPACE_SOURCE) / "configs")) {
    if (entry.path().extension() == ".toml") {
      files[entry.path().stem().string()] = entry.path();
    }
  }
  return files;
}

std::uint64_t sum(const Json& stage) {
  std::uint64_t cycles = stage["busy"];
  for (const auto& [reason, count] : stage["stalls"].items()) {
    cycles += count.get<std::uint64_t>();
  }
  return cycles;
}

}  // namespace

TEST_CASE("configs: the machines that the documentation names") {
  const std::set<std::string> expected{"baseline", "small", "wide", "shallow", "slow_memory"};
  std::set<std::string> names;
  for (const auto& [name, path] : machines()) {
    names.insert(name);
  }
  CHECK(names == expected);
}

TEST_CASE("configs: every file lists every key, nothing else, and is what the program would write") {
  const Place place;
  for (const auto& [name, path] : machines()) {
    CAPTURE(name);
    const Outcome again = place.run("config --toml --config " + path.string());
    REQUIRE(again.status == 0);
    // What is read is printed with every key: where the two are the same, none is missing and none is more.
    CHECK(slurp(path) == again.out);
  }
  CHECK(slurp(machines()["baseline"]) == place.run("config --toml").out);
}

TEST_CASE("configs: docs/config.md is what the program prints; `make generated` prints it anew") {
  const Place place;
  const Outcome printed = place.run("config --markdown");
  REQUIRE(printed.status == 0);
  CHECK(slurp(fs::path(HALFSPACE_SOURCE) / "docs" / "config.md") == printed.out);
  CHECK(place.run("config --markdown --set late_z=opaque").status != 0);  // it prints the defaults
}

// The parameters of raster_pipeline.sv have the order and the defaults of the keys that set them.
TEST_CASE("configs: Verilator's arguments are the parameters of raster_pkg.sv and raster_pipeline.sv") {
  const fs::path rtl = fs::path(HALFSPACE_SOURCE) / "rtl";
  const auto find_all = [](const std::string& text, const std::regex& pattern, const char* option) {
    std::vector<std::string> arguments;
    for (std::sregex_iterator at(text.begin(), text.end(), pattern), end; at != end; ++at) {
      arguments.push_back(option + at->str(1) + "=" + at->str(2));
    }
    return arguments;
  };
  std::vector<std::string> expected =
      find_all(slurp(rtl / "raster_pkg.sv"),
               // The last of the standard positions is that of one sample.
               std::regex(R"(`define (\w+) (?:\(PixelSamples[^`]*?)?(\d+(?:'h\w+)?)\)?\n)"), "-D");
  const std::vector<std::string> parameters =
      find_all(slurp(rtl / "raster_pipeline.sv"),
               std::regex(R"(\n  parameter (?:int unsigned|bit) +(\w+) = ([\w']+),)"), "-G");
  expected.insert(expected.end(), parameters.begin(), parameters.end());
  for (const char* const name : {"-GCounterBits=50", "-GThinLines=1'b0"}) {
    std::erase(expected, name);  // no key sets it
  }
  CHECK(halfspace::rtl::pipeline_arguments({}) == expected);
}

TEST_CASE("configs: 'shallow' has the smallest value of everything that holds packets") {
  const halfspace::Config config = halfspace::read_config(machines()["shallow"]);
  for (const halfspace::ConfigKey& key : halfspace::config_keys(config)) {
    const bool holds_packets = key.name.ends_with(".fifo") || key.name.ends_with(".queue") ||
                               key.name.ends_with(".pending") || key.name == "z_cache.lines" ||
                               key.name == "z_cache.ways" || key.name == "z_cache.parts" ||
                               key.name == "z_cache.misses_in_flight" || key.name == "z_cache.write_buffers";
    CAPTURE(key.name, key.value, key.legal);
    const std::string smallest = key.legal.substr(0, key.legal.find_first_of(" ,"));
    CHECK((!holds_packets || key.value == smallest));
  }
}

TEST_CASE("configs: each machine draws the same picture, and every cycle of every stage has its reason") {
  const Place place;
  const auto run = [&](const std::string& name, const fs::path& path) {
    const fs::path out = place.path / name;
    const Outcome outcome = place.run("run " + scene("vkcube.ptf.xz") + " --no-pictures --config " +
                                      path.string() + " --fidelity recurrence --out " + out.string());
    CAPTURE(outcome.err);
    REQUIRE(outcome.status == 0);
    return out;
  };
  const std::map<std::string, fs::path> files = machines();
  const fs::path baseline = run("baseline", files.at("baseline"));
  for (const auto& [name, path] : files) {
    CAPTURE(name);
    const fs::path out = run(name, path);
    for (const char* array : {"depth0.npy", "fragments0.npy", "survivors0.npy"}) {
      CAPTURE(array);
      CHECK(slurp(out / array) == slurp(baseline / array));
    }
    const Json stats = read_stats(out);
    const Json& frame = stats["frame"]["time"];
    CHECK(stats["cycles"] == frame["cycles"]);
    for (const auto& [stage, cycles] : frame["stages"].items()) {
      CAPTURE(stage);
      CHECK(sum(cycles) == stats["cycles"]);
      CHECK(cycles["cycles"] == stats["cycles"]);
      std::uint64_t of_draws = 0;
      for (const Json& draw : stats["draws"]) {
        const Json& own = draw["time"]["stages"][stage];
        CHECK(sum(own) == own["cycles"]);
        of_draws += sum(own);
      }
      // What a stage did for a draw was done before the draw's end; the rest of the frame is the flush.
      CHECK(of_draws <= stats["draws"].back()["time"]["end"].get<std::uint64_t>());
    }
    // A decision, a job and an empty coverage take a cycle each, whatever the machine.
    const Json& counters = stats["draws"][0]["counters"];
    const Json& draw = stats["draws"][0]["time"];
    CHECK(draw["stages"]["setup"]["busy"] == counters["setup"]["triangles"]);
    CHECK(draw["stages"]["edge_evaluator"]["busy"] == draw["links"]["tile_walker"]["packets"]);
    CHECK(draw["links"]["setup_queue"]["packets"] == counters["setup"]["triangles"]);
    CHECK(draw["links"]["setup"]["packets"] == counters["setup"]["drawn"]);
    CHECK(draw["links"]["early_z"]["packets"] == counters["quad_generator"]["tiles"]);
    for (const auto& [link, use] : frame["links"].items()) {
      CAPTURE(link);
      const auto occupancy = use["occupancy"].get<std::vector<std::uint64_t>>();
      std::uint64_t cycles = 0;
      std::uint64_t held = 0;
      for (std::size_t i = 0; i < occupancy.size(); ++i) {
        cycles += occupancy[i];
        held += i * occupancy[i];
      }
      CHECK(cycles == stats["cycles"]);
      CHECK(held == use["held"]);
      CHECK(occupancy[use["max_occupancy"].get<std::size_t>()] != 0);
    }
    const Json& memory = frame["memory"];
    const auto bytes_a_cycle = [&](const char* key) {
      return static_cast<std::uint64_t>(std::stoi(stats["config"][key].get<std::string>()));
    };
    // Lines of 16 bits a sample are no smaller than what memory moves in a cycle.
    CHECK(memory["bytes_read"] ==
          memory["read_busy"].get<std::uint64_t>() * bytes_a_cycle("memory.read_bytes"));
    CHECK(memory["bytes_written"] ==
          memory["write_busy"].get<std::uint64_t>() * bytes_a_cycle("memory.write_bytes"));
  }
}

TEST_CASE("stats: draw after draw, every cycle of every stage has its reason") {
  const Place place;
  const fs::path out = place.path / "result";
  REQUIRE(place
              .run("run " + scene("cc0_truck.ptf.xz") + " --no-pictures --fidelity recurrence --out " +
                   out.string())
              .status == 0);
  const Json stats = read_stats(out);
  std::map<std::string, std::uint64_t> up_to_here;
  std::map<std::string, std::uint64_t> held;
  std::uint64_t end = 0;
  for (const Json& draw : stats["draws"]) {
    CAPTURE(draw["draw"]);
    const Json& time = draw["time"];
    for (const auto& [name, stage] : time["stages"].items()) {
      CAPTURE(name);
      CHECK(sum(stage) == stage["cycles"]);
      up_to_here[name] += sum(stage);
    }
    for (const auto& [name, link] : time["links"].items()) {
      held[name] += link["held"].get<std::uint64_t>();
    }
    CHECK(time["end"] >= end);
    end = time["end"];
    // Nothing holds the sink up: a beat is there kTestLatency cycles after it was tested, the last one too.
    CHECK(end + 1 == up_to_here["z_test"] + halfspace::kTestLatency);
  }
  CHECK(end < stats["cycles"]);
  for (const auto& [name, cycles] : up_to_here) {
    CHECK(cycles <= end);
  }
  for (const auto& [name, link] : stats["frame"]["time"]["links"].items()) {
    CHECK(link["held"] == held[name]);  // no clear is drawn
  }
}
