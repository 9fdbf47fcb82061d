// timeline.json: what a viewer is shown agrees with what was counted.
#include "program.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>

#include "halfspace/timing/cycle_stats.hpp"

using namespace halfspace::testing;

namespace {

constexpr int kStages = 1;  // the groups of tracks, by the number that events name them with
constexpr int kLinks = 2;
constexpr int kMemory = 3;

struct Slice {
  std::uint64_t from = 0;
  std::uint64_t to = 0;
  std::string category;
  std::string name;
  Json arguments;
};

using Track = std::pair<int, int>;

struct TimelineFile {
  std::map<Track, std::vector<Slice>> slices;                                            ///< in order of time
  std::map<std::string, std::vector<std::pair<std::uint64_t, std::uint64_t>>> counters;  ///< cycle, credits
  std::map<Track, std::string> names;
};

TimelineFile read_timeline(const fs::path& folder) {
  const Json json = Json::parse(slurp(folder / "timeline.json"));
  CHECK(json["otherData"]["time"] == "1 cycle is shown as 1 us");
  TimelineFile timeline;
  for (const Json& event : json["traceEvents"]) {
    if (event["ph"] == "X") {
      timeline.slices[{event["pid"], event["tid"]}].push_back(
          {.from = event["ts"],
           .to = event["ts"].get<std::uint64_t>() + event["dur"].get<std::uint64_t>(),
           .category = event["cat"],
           .name = event["name"],
           .arguments = event["args"]});
    } else if (event["ph"] == "C") {
      CHECK(event["pid"] == kLinks);
      timeline.counters[event["name"]].emplace_back(event["ts"], event["args"]["credits"]);
    } else if (event["name"] == "thread_name") {
      timeline.names[{event["pid"], event["tid"]}] = event["args"]["name"];
    }
  }
  for (auto& [track, slices] : timeline.slices) {
    std::stable_sort(slices.begin(), slices.end(),
                     [](const Slice& l, const Slice& r) { return l.from < r.from; });
  }
  return timeline;
}

void check_no_overlap(const TimelineFile& timeline) {
  for (const auto& [track, slices] : timeline.slices) {
    CAPTURE(track);
    const auto overlap = std::adjacent_find(slices.begin(), slices.end(),
                                            [](const Slice& l, const Slice& r) { return l.to > r.from; });
    CHECK(overlap == slices.end());
  }
}

std::uint64_t total(const std::vector<Slice>& slices, const std::string& category, const std::string& name) {
  std::uint64_t cycles = 0;
  for (const Slice& slice : slices) {
    cycles += slice.category == category && (name.empty() || slice.name == name) ? slice.to - slice.from : 0;
  }
  return cycles;
}

void check_against_stats(const TimelineFile& timeline, const Json& stats) {
  const Json& frame = stats["frame"]["time"];
  const std::uint64_t cycles = stats["cycles"];
  for (int i = 0; i < static_cast<int>(halfspace::kStages); ++i) {
    const Track track{kStages, i};
    const std::string& name = timeline.names.at(track);
    CAPTURE(name);
    const std::vector<Slice>& slices = timeline.slices.at(track);
    CHECK(slices.front().from == 0);
    CHECK(slices.back().to == cycles);
    CHECK(total(slices, "busy", "") == frame["stages"][name]["busy"]);
    for (const auto& [reason, count] : frame["stages"][name]["stalls"].items()) {
      CAPTURE(reason);
      CHECK(total(slices, "stall", reason) == count);
    }
  }
  for (const auto& [name, link] : frame["links"].items()) {
    CAPTURE(name);
    std::vector<std::uint64_t> occupancy(link["occupancy"].size());
    const auto& changes = timeline.counters.at(name);
    for (std::size_t i = 0; i < changes.size(); ++i) {
      const std::uint64_t until = i + 1 < changes.size() ? changes[i + 1].first : cycles;
      REQUIRE(until >= changes[i].first);
      occupancy.at(changes[i].second) += until - changes[i].first;
    }
    CHECK(occupancy == link["occupancy"].get<std::vector<std::uint64_t>>());
  }
  for (const char* channel : {"read", "write"}) {
    for (int i = 0; i < 2; ++i) {
      const auto slices = timeline.slices.find({kMemory, i});
      if (timeline.names.at({kMemory, i}) == channel) {
        CHECK((slices == timeline.slices.end() ? 0 : total(slices->second, "busy", "")) ==
              frame["memory"][std::string(channel) + "_busy"]);
      }
    }
  }
}

std::string run_command(const Place& place, const std::string& frame, const std::string& options) {
  return "run " + scene(frame.c_str()) + " --no-pictures --fidelity recurrence --timeline --out " +
         (place.path / "result").string() + " " + options;
}

}  // namespace

TEST_CASE("timeline: slices of a track do not overlap, and add up to the stats of the frame") {
  for (const char* options :
       {"", "--stall source:20:30 --stall quad_generator:20:9 --stall sink:30:20 --seed 3",
        "--set z_cache.fast_clear=false",
        "--set z_cache.lines=4 --set z_cache.ways=2 --set z_cache.parts=2 --set tile_walker.tile_size=4",
        "--set z_cache.write_buffers=1 --set memory.write_bytes=1 --set early_z.quads_per_cycle=1"}) {
    CAPTURE(options);
    const Place place;
    REQUIRE(place.run(run_command(place, "vkcube.ptf.xz", options)).status == 0);
    const Json stats = read_stats(place.path / "result");
    CHECK(stats["files"].get<std::set<std::string>>().count("timeline.json") == 1);
    const TimelineFile timeline = read_timeline(place.path / "result");
    check_no_overlap(timeline);
    check_against_stats(timeline, stats);
  }
}

TEST_CASE("timeline: slices name the packet, as the other files do") {
  const Place place;
  REQUIRE(place.run(run_command(place, "vkcube.ptf.xz", "--set z_cache.fast_clear=false")).status == 0);
  const TimelineFile timeline = read_timeline(place.path / "result");
  const Json counters = read_stats(place.path / "result")["draws"][0]["counters"];
  const std::vector<Slice>& tests = timeline.slices.at({kStages, static_cast<int>(halfspace::Stage::kZTest)});
  std::set<std::uint64_t> bursts;
  for (const Slice& slice : tests) {
    if (slice.category == "busy" && slice.name.rfind("draw 0 burst ", 0) == 0) {
      CHECK(slice.arguments["draw"] == 0);
      CHECK(slice.arguments["x"].get<int>() % 8 == 0);
      CHECK(slice.arguments["y"].get<int>() % 8 == 0);
      CHECK(slice.arguments["triangle"] < 12);
      CHECK(slice.name == "draw 0 burst " + slice.arguments["burst"].dump());
      bursts.insert(slice.arguments["burst"].get<std::uint64_t>());
    }
  }
  CHECK(bursts.size() == counters["quad_generator"]["tiles"]);
  // The clear is drawn before: its bursts belong to no draw, and no tile of it was observed.
  const auto clear = std::find_if(tests.begin(), tests.end(),
                                  [](const Slice& slice) { return slice.name == "clear burst 0"; });
  REQUIRE(clear != tests.end());
  CHECK(!clear->arguments.contains("draw"));
  CHECK(!clear->arguments.contains("x"));
  const std::vector<Slice>& writes = timeline.slices.at({kMemory, 1});
  CHECK(writes.back().name == "flush");
}

TEST_CASE("timeline: a range of cycles is the same part of the whole") {
  const Place place;
  REQUIRE(place.run(run_command(place, "vkcube.ptf.xz", "")).status == 0);
  const TimelineFile whole = read_timeline(place.path / "result");
  REQUIRE(place.run(run_command(place, "vkcube.ptf.xz", "--timeline-cycles 1000:1999")).status == 0);
  const TimelineFile part = read_timeline(place.path / "result");
  check_no_overlap(part);
  for (int i = 0; i < static_cast<int>(halfspace::kStages); ++i) {
    const std::vector<Slice>& slices = part.slices.at({kStages, i});
    CHECK(slices.front().from == 1000);
    CHECK(slices.back().to == 2000);
    CHECK(total(slices, "busy", "") + total(slices, "stall", "") == 1000);
  }
  for (const auto& [link, changes] : whole.counters) {
    CAPTURE(link);
    std::vector<std::pair<std::uint64_t, std::uint64_t>> expected;
    for (const auto& [cycle, credits] : changes) {
      if (cycle <= 1000) {
        expected = {{1000, credits}};
      } else if (cycle <= 1999) {
        expected.emplace_back(cycle, credits);
      }
    }
    CHECK(part.counters.at(link) == expected);
  }
}

TEST_CASE("timeline: a range of draws holds their slices and no others") {
  const Place place;
  REQUIRE(place.run(run_command(place, "cc0_truck.ptf.xz", "--timeline-draws 40:41")).status == 0);
  const Json stats = read_stats(place.path / "result");
  const TimelineFile timeline = read_timeline(place.path / "result");
  check_no_overlap(timeline);
  for (int i = 0; i < static_cast<int>(halfspace::kStages); ++i) {
    if (i == static_cast<int>(halfspace::Stage::kHiZ) ||
        i == static_cast<int>(halfspace::Stage::kInterpolator)) {
      continue;  // off: it has no packet
    }
    const Track track{kStages, i};
    const std::string& name = timeline.names.at(track);
    CAPTURE(name);
    std::map<int, std::uint64_t> busy;
    std::map<int, std::uint64_t> cycles;
    for (const Slice& slice : timeline.slices.at(track)) {
      const int draw = slice.arguments["draw"];
      cycles[draw] += slice.to - slice.from;
      busy[draw] += slice.category == "busy" ? slice.to - slice.from : 0;
    }
    CHECK(cycles.size() == 2);
    for (const int draw : {40, 41}) {
      const Json& stage = stats["draws"][static_cast<std::size_t>(draw)]["time"]["stages"][name];
      CHECK(busy[draw] == stage["busy"]);
      CHECK(cycles[draw] == stage["cycles"]);
    }
  }
  // Counters show all credits in use, those of the neighbouring draws too.
  // hi_z and interpolator are off: their links have no packet
  CHECK(timeline.counters.size() == halfspace::kLinks - 2);
  for (const auto& [link, changes] : timeline.counters) {
    CAPTURE(link);
    const std::uint64_t most = stats["frame"]["time"]["links"][link]["max_occupancy"];
    for (const auto& [cycle, in_use] : changes) {
      REQUIRE(in_use <= most);
    }
    CHECK(std::is_sorted(changes.begin(), changes.end()));
  }
}

TEST_CASE("timeline: what cannot be shown is refused, and nothing is left behind") {
  const Place place;
  const auto refused = [&](const std::string& frame, const std::string& options,
                           std::initializer_list<const char*> parts) {
    check_error(place.run(run_command(place, frame, options)), parts);
    CHECK(entries(place.path) == std::set<std::string>{"stderr", "stdout"});
  };
  refused("cc0_truck.ptf.xz", "", {"2000000 events", "--timeline-draws", "--timeline-cycles"});
  refused("vkcube.ptf.xz", "--timeline-draws 0:1", {"draws 0 to 1", "vkcube", "has 1"});
  refused("vkcube.ptf.xz", "--timeline-cycles 1000000:1000001", {"cycle 1000000", "the frame's last is "});
  for (const char* range : {"1", "2:1", "a:b", "1:2:3", "-1:2"}) {
    refused("vkcube.ptf.xz", std::string("--timeline-cycles=") + range,
            {"--timeline-cycles", range, "FIRST:LAST"});
    refused("vkcube.ptf.xz", std::string("--timeline-draws=") + range,
            {"--timeline-draws", range, "FIRST:LAST"});
  }
  check_error(place.run("run " + scene("vkcube.ptf.xz") + " --timeline --out " + (place.path / "r").string()),
              {"--timeline", "functional", "recurrence"});
}
