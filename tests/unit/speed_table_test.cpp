// The tables of `bench speed` and `bench stages`.
#include "halfspace/speed/speed_table.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

#include "halfspace/core/functional.hpp"
#include "halfspace/scene/synthetic.hpp"
#include "halfspace/speed/stage_cost.hpp"

using namespace halfspace;

namespace {

/// Ours, a yardstick of half the time, and one that is not there.
SpeedTable example() {
  return {.config = {},
          .repeat = 3,
          .contenders = {{.name = "ours", .about = "the model"},
                         {.name = "plain_loop", .yardstick = true, .about = "a loop"},
                         {.name = "other", .yardstick = true, .about = "not installed", .absent = true}},
          .rows = {{.name = "list",
                    .depth = DepthFormat::kFloat32,
                    .triangles = 1000,
                    .fragments = 9000,
                    .quads = 8000,
                    .runs = {{.milliseconds = {4, 8, 2}, .survivors = 7000},
                             {.milliseconds = {2, 4, 0.5}, .survivors = 7003},
                             {}}}}};
}

std::size_t columns(const std::string& line, char separator) {
  return static_cast<std::size_t>(std::ranges::count(line, separator));
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line);
  }
  return lines;
}

}  // namespace

TEST_CASE("a spread is the median, the least and the most; of an even number, the mean of the middle two") {
  CHECK(spread({3, 1, 2}).median == 2);
  CHECK(spread({4, 1, 2, 3}).median == 2.5);
  CHECK(spread({3, 1, 2}).least == 1);
  CHECK(spread({3, 1, 2}).most == 3);
}

TEST_CASE("contenders are compared pass by pass") {
  const SpeedTable table = example();
  const Spread ratio = table.times_as_fast(table.rows[0], 0, 1);
  CHECK(ratio.median == 0.5);
  CHECK(ratio.least == 0.25);
  CHECK(ratio.most == 0.5);
}

TEST_CASE("the table of speed leaves out who is absent, says why, and has as many cells as columns") {
  const std::vector<std::string> lines = lines_of(speed_markdown(example()));
  REQUIRE(lines.size() == 5);
  CHECK(lines[0].find("3 passes") != std::string::npos);
  CHECK(lines[0].find("other is left out: not installed") != std::string::npos);
  CHECK(lines[2].find("| plain loop |") != std::string::npos);
  CHECK(lines[2].find("| other |") == std::string::npos);
  CHECK(lines[4].find(
            "| 4.00 (2.00 to 8.00) | 2.00 (0.50 to 4.00) | 0.50 (0.25 to 0.50) | 2.00 | 4000 | +3 |") !=
        std::string::npos);
  CHECK(columns(lines[2], '|') == columns(lines[3], '|'));
  CHECK(columns(lines[2], '|') == columns(lines[4], '|'));
}

TEST_CASE("the CSV of speed has as many cells as columns, empty ones for who is absent") {
  const std::vector<std::string> lines = lines_of(speed_csv(example()));
  REQUIRE(lines.size() == 2);
  CHECK(columns(lines[0], ',') == columns(lines[1], ','));
  CHECK(lines[1].find(
            "list,float32,1000,9000,8000,7000,4.0000,2.0000,8.0000,7003,2.0000,0.5000,4.0000,,,,,") == 0);
}

TEST_CASE("the JSON of speed has every pass") {
  const nlohmann::json json = nlohmann::json::parse(speed_json(example()));
  CHECK(json["schema"] == kSpeedSchema);
  CHECK(json["schema_version"] == kSpeedSchemaVersion);
  CHECK(json["contenders"].size() == 3);
  const nlohmann::json& workload = json["workloads"].at(0);
  CHECK(workload["runs"]["ours"]["milliseconds"] == std::vector<double>{4, 8, 2});
  CHECK(!workload["runs"].contains("other"));
  REQUIRE(workload["times_as_fast"].size() == 1);
  CHECK(workload["times_as_fast"][0]["yardstick"] == "plain_loop");
  CHECK(workload["times_as_fast"][0]["median"] == 0.5);
}

TEST_CASE("stage costs: a time for each pass, and the packets that the units count") {
  const Frame frame = synthetic_frame("medium");
  const StageCosts costs = stage_costs(frame, Config{}, 2);
  CHECK(costs.functional.size() == 2);
  const Counters counters = run_functional(frame, Config{}).counters;
  std::vector<std::uint64_t> items;
  for (const StageCost& cost : costs.stages) {
    CHECK(cost.milliseconds.size() == 2);
    items.push_back(cost.items);
  }
  const std::uint64_t fragments = counters.quad_generator.fragments;
  CHECK(items == std::vector<std::uint64_t>{
                     1920 * 1080, 5000, 5000, counters.block_walker.blocks,
                     counters.tile_walker.tiles_accepted + counters.tile_walker.tiles_partial,
                     counters.edge_evaluator.tiles + counters.edge_evaluator.tiles_skipped,
                     counters.quad_generator.tiles, fragments, fragments, counters.early_z.z_bursts});
}
