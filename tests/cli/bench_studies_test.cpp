// halfspace bench depth-traffic and hi-z: what they print, beside what a run says.
#include <catch2/catch.hpp>
#include <sstream>

#include "program.hpp"

namespace halfspace::testing {
namespace {

/// The cells of the last row of a table of Markdown that has a cell `name`.
std::vector<std::string> row(const std::string& table, const std::string& name) {
  std::vector<std::string> found;
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) {
    if (line.find("| " + name + " |") == std::string::npos) {
      continue;
    }
    found.clear();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, '|');) {
      const std::size_t first = cell.find_first_not_of(' ');
      found.push_back(
          first == std::string::npos ? "" : cell.substr(first, cell.find_last_not_of(' ') - first + 1));
    }
  }
  return found;
}

}  // namespace

TEST_CASE("bench depth-traffic: what moves is what a run counts") {
  const Place place;
  const Outcome outcome = place.run("bench depth-traffic " + scene("vkcube.ptf.xz"));
  REQUIRE(outcome.status == 0);
  const std::vector<std::string> moved = row(outcome.out, "moved");
  REQUIRE(moved.size() == 10);
  const std::string out = (place.path / "run").string();
  for (const bool coded : {false, true}) {
    REQUIRE(place
                .run("run " + scene("vkcube.ptf.xz") + " --no-pictures --set z_cache.compression=" +
                     (coded ? "true" : "false") + " --out " + out)
                .status == 0);
    const Json frame = read_stats(out)["frame"];
    const Json& early_z = frame["counters"]["early_z"];
    CHECK(moved[coded ? 5 : 4] == std::to_string(early_z["bytes_read"].get<int>()));
    CHECK(moved[coded ? 8 : 7] ==
          std::to_string(early_z["bytes_written"].get<int>() + frame["flushed_bytes"].get<int>()));
  }
  CHECK(row(outcome.out, "cleared").at(8) == "0");
}

TEST_CASE("bench hi-z: the cycles by order are those of a run, and there is a column by time") {
  const Place place;
  const Outcome outcome = place.run("bench hi-z synthetic:medium --bits 8 --lags 16 --set hi_z.lag=16");
  REQUIRE(outcome.status == 0);
  const std::vector<std::string> head = row(outcome.out, "by time");
  REQUIRE(head.size() == 11);
  CHECK(head[8] == "by time");
  CHECK(head[9] == "cycles, lag 16");
  CHECK(head[10] == "cycles, by time");
  const std::string out = (place.path / "run").string();
  REQUIRE(place
              .run("run synthetic:medium --no-pictures --fidelity recurrence --set hi_z.enabled=true --set "
                   "hi_z.lag=16 --out " +
                   out)
              .status == 0);
  CHECK(row(outcome.out, "medium").at(9) == std::to_string(read_stats(out)["cycles"].get<int>()));
}

}  // namespace halfspace::testing
