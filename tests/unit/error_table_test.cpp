// Does the error table see every difference, with its sign, its stage and its draw?
#include "halfspace/report/error_table.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>

#include "halfspace/numerics/error.hpp"

using namespace halfspace;
using Catch::Matchers::Contains;

namespace {

namespace fs = std::filesystem;

/// Draws of 1000, 2000, 4000 and 10 cycles, and 90 more to the end of the frame.
FidelityRun made_up(const std::string& fidelity) {
  FidelityRun run;
  run.fidelity = fidelity;
  run.milliseconds = {4, 2, 8};
  Surface surface;
  surface.codes = TiledImage<std::uint32_t>(10, 6, 8, 7);
  surface.fragments = TiledImage<std::uint16_t>(10, 6, 8, 2);
  surface.survivors = TiledImage<std::uint16_t>(10, 6, 8, 1);
  run.frame.surfaces.push_back(surface);
  run.frame.draws.resize(4);
  run.frame.counters.front_end.triangles = 12;
  run.frame.counters.quad_generator.fragments = 120;
  FrameCycles& frame = run.cycles.emplace();
  frame.cycles = 7100;
  for (const std::uint64_t end : {1000, 3000, 7000, 7010}) {
    frame.draws.push_back({.end = end, .stats = {}});
  }
  for (StageCycles& stage : frame.stats.stage) {
    stage = {.busy = 4000, .stall = {3000, 100}};
  }
  return run;
}

/// Of a record: no function, draws and stages.
FidelityRun estimated(std::uint64_t cycles) {
  FidelityRun run;
  run.fidelity = "sampled";
  run.milliseconds = {5, 4, 3};
  run.record_cycles = cycles;
  return run;
}

/// What the table says of a copy of the truth with one change.
FidelityError changed(const std::function<void(FidelityRun&)>& change) {
  FidelityRun run = made_up("recurrence");
  change(run);
  return compare_to_rtl(run, made_up("rtl"));
}

ErrorTable small_table() {
  ErrorTable table{.config = {}, .repeat = 3, .workloads = {}};
  std::vector<FidelityRun> runs{made_up("functional"), estimated(7000), made_up("recurrence"),
                                made_up("rtl")};
  runs[0].cycles.reset();
  runs[3].milliseconds = {100};
  runs[3].rtl = {.compared = 55, .different = 0, .first = {}};
  table.workloads.push_back(compare_fidelities("frame", runs));
  return table;
}

std::string slurp(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

TEST_CASE("error table: equal runs have no error anywhere") {
  const FidelityError line = changed([](FidelityRun&) {});
  CHECK(line.cycles == 7100);
  CHECK(line.error->cycles == 0);
  CHECK(line.error->percent() == 0);
  CHECK(line.draws->draws == 4);
  CHECK(line.draws->off == 0);
  CHECK(line.draws->cycles_off == 0);
  CHECK(line.draws->long_draws == 3);
  CHECK(line.draws->mean_percent == 0);
  CHECK(line.draws->worst_percent == 0);
  for (const StageError& stage : *line.stages) {
    CHECK(stage.off == 0);
    CHECK(stage.largest.empty());
  }
  CHECK(line.function->total() == 0);
}

TEST_CASE("error table: too many cycles are positive, too few negative") {
  const FidelityError more = changed([](FidelityRun& run) { run.cycles->cycles += 71; });
  CHECK(more.error->cycles == 71);
  CHECK(more.error->percent() == Approx(1));
  const FidelityError less = changed([](FidelityRun& run) { run.cycles->cycles -= 142; });
  CHECK(less.error->cycles == -142);
  CHECK(less.error->percent() == Approx(-2));
  CHECK(CycleError{.truth = 0, .cycles = 3}.percent() == 300);
}

TEST_CASE("error table: draws are compared by their own cycles") {
  SECTION("one end moved makes two draws wrong, in opposite directions") {
    const FidelityError line = changed([](FidelityRun& run) { run.cycles->draws[1].end -= 200; });
    CHECK(line.draws->off == 2);
    CHECK(line.draws->cycles_off == 400);
    CHECK(line.draws->mean_percent == Approx((-10.0 + 5.0) / 3));
    CHECK(line.draws->mean_magnitude_percent == Approx((10.0 + 5.0) / 3));
    CHECK(line.draws->worst_draw == 1);
    CHECK(line.draws->worst_percent == Approx(-10));
    CHECK(line.error->cycles == 0);
  }
  SECTION("the last draw, a short one, is not missed, though it has no percentage") {
    const FidelityError line = changed([](FidelityRun& run) { run.cycles->draws[3].end += 5; });
    CHECK(line.draws->off == 1);
    CHECK(line.draws->cycles_off == 5);
    CHECK(line.draws->worst_percent == 0);
    CHECK(line.draws->long_draws == 3);
  }
  SECTION("nor is a draw that is not there at all") {
    const FidelityError line = changed([](FidelityRun& run) { run.cycles->draws.pop_back(); });
    CHECK(line.draws->off == 1);
    CHECK(line.draws->cycles_off == 10);
  }
  SECTION("nor one too many, even of no cycles") {
    const FidelityError line =
        changed([](FidelityRun& run) { run.cycles->draws.push_back(run.cycles->draws.back()); });
    CHECK(line.draws->off == 1);
    CHECK(line.draws->draws == 4);
  }
  SECTION("of a record there are none") {
    const FidelityError line = compare_to_rtl(estimated(7000), made_up("rtl"));
    CHECK(line.cycles == 7000);
    CHECK(line.error->cycles == -100);
    CHECK_FALSE(line.draws);
    CHECK_FALSE(line.stages);
    CHECK_FALSE(line.function);
  }
}

TEST_CASE("error table: a stage's cycles may not move from one reason to another") {
  for (std::size_t i = 0; i < kStages; ++i) {
    const FidelityError line = changed([i](FidelityRun& run) {
      StageCycles& stage = run.cycles->stats.stage[i];
      stage.busy += 5;
      stage.stall[0] += 2;
      stage.stall[1] -= 7;
    });
    for (std::size_t k = 0; k < kStages; ++k) {
      const StageError& stage = (*line.stages)[k];
      CHECK(stage.off == (k == i ? 14 : 0));
      CHECK(stage.largest == (k == i ? kStageInfo[i].stall[1] : ""));
      CHECK(stage.largest_cycles == (k == i ? -7 : 0));
    }
  }
  const FidelityError line = changed([](FidelityRun& run) { run.cycles->stats.stage[5].busy -= 1; });
  CHECK((*line.stages)[5].largest == "busy");
  CHECK((*line.stages)[5].largest_cycles == -1);
}

TEST_CASE("error table: every functional difference counts once") {
  const auto function = [](const std::function<void(FrameResult&)>& change) {
    return *changed([&](FidelityRun& run) { change(run.frame); }).function;
  };
  CHECK(function([](FrameResult& r) { r.surfaces[0].codes.at(9, 5) ^= 1; }).codes == 1);
  CHECK(function([](FrameResult& r) { r.surfaces[0].fragments.at(0, 5) += 1; }).fragments == 1);
  CHECK(function([](FrameResult& r) { r.surfaces[0].survivors.at(9, 0) -= 1; }).survivors == 1);
  CHECK(function([](FrameResult& r) { r.surfaces[0].counters.early_z.tested += 1; }).counters == 1);
  CHECK(function([](FrameResult& r) { r.counters.early_z.bytes_written += 64; }).counters == 1);
  CHECK(function([](FrameResult& r) { r.draws[3].counters.setup.culled += 1; }).counters == 1);
  CHECK(function([](FrameResult& r) { r.drawn_clears.setup.drawn += 1; }).counters == 1);
  CHECK(function([](FrameResult& r) { r.flushed_lines += 1; }).counters == 1);
  CHECK(function([](FrameResult& r) { r.clears += 1; }).counters == 1);
  const FunctionErrors none = function([](FrameResult& r) { r.surfaces.clear(); });
  CHECK(none.codes == 60);
  CHECK(none.fragments == 60);
  CHECK(none.survivors == 60);
  const FunctionErrors two = function([](FrameResult& r) {
    r.surfaces[0].codes.at(1, 1) = 0;
    r.surfaces[0].codes.at(2, 2) = 0;
  });
  CHECK(two.codes == 2);
  CHECK(two.total() == 2);
}

TEST_CASE("error table: medians and speed") {
  FidelityRun run = made_up("recurrence");
  CHECK(compare_to_rtl(run, made_up("rtl")).median_milliseconds() == 4);
  CHECK(*compare_to_rtl(run, made_up("rtl")).megacycles_a_second() == Approx(7100 / 4e3));
  run.milliseconds = {3, 1};
  CHECK(compare_to_rtl(run, made_up("rtl")).median_milliseconds() == 2);
}

TEST_CASE("error table: the RTL is not compared with itself, and has to be there") {
  const ErrorTable table = small_table();
  const WorkloadErrors& workload = table.workloads[0];
  CHECK(workload.triangles == 12);
  CHECK(workload.fragments == 120);
  REQUIRE(workload.fidelities.size() == 4);
  CHECK_FALSE(workload.fidelities[0].cycles);
  CHECK_FALSE(workload.fidelities[0].error);
  CHECK(workload.fidelities[0].function->total() == 0);
  CHECK_FALSE(workload.fidelities[3].error);
  CHECK_FALSE(workload.fidelities[3].function);
  CHECK(workload.fidelities[3].packets->compared == 55);
  CHECK_THROWS_AS(compare_fidelities("frame", {made_up("systemc")}), std::invalid_argument);
}

TEST_CASE("error table: function agrees unless a value or a packet differs, whatever the cycles") {
  ErrorTable table = small_table();
  CHECK(table.function_agrees());
  SECTION("value") { table.workloads[0].fidelities[2].function->survivors = 1; }
  SECTION("packet") { table.workloads[0].fidelities[3].packets->different = 1; }
  CHECK_FALSE(table.function_agrees());
}

TEST_CASE("error table: what a person reads") {
  const std::string text = error_markdown(small_table());
  CAPTURE(text);
  CHECK_THAT(text, Contains("| functional | - | 25.0 | - | - | - | - | 0 |"));
  CHECK_THAT(text, Contains("| sampled | 1.77 | 25.0 | 1.41 | -1.41 (frame) | - | - | - |"));
  CHECK_THAT(text, Contains("| recurrence | 1.77 | 25.0 | 0 | 0 | 0 of 4 | 0 | 0 |"));
  CHECK_THAT(text, Contains("| frame | functional | 4.00 | - | - | - | - | - | - | - | - | - | - | 0 | - |"));
  CHECK_THAT(
      text,
      Contains("| frame | sampled | 4.00 | 7000 | 1.75 | -100 | -1.41 | - | - | - | - | - | - | - | - |"));
  CHECK_THAT(
      text,
      Contains("| frame | recurrence | 4.00 | 7100 | 1.77 | 0 | 0 | 0 of 4 | 0 | 0 | 0 | 0 | - | 0 | - |"));
  CHECK_THAT(text,
             Contains("| frame | rtl | 100 | 7100 | 0.07 | - | - | - | - | - | - | - | - | - | 0 of 55 |"));

  ErrorTable off = small_table();
  off.workloads[0].fidelities[2] = changed([](FidelityRun& run) {
    run.cycles->cycles = 7'100'001;
    run.cycles->stats.stage[static_cast<std::size_t>(Stage::kZLookup)].stall[stall::kLookupFillBuffers] += 12;
  });
  off.workloads[0].fidelities[2].error->truth = 7'100'000;
  off.workloads[0].fidelities[2].error->cycles = 1;
  CHECK_THAT(error_markdown(off), Contains("| +1 | +1.4e-05 |"));  // never 0
  CHECK_THAT(error_markdown(off), Contains("| 12 | z_lookup fill_buffers +12 |"));
}

TEST_CASE("error table: every line of the CSV has as many cells as its head") {
  const std::string text = error_csv(small_table());
  std::istringstream lines(text);
  std::string line;
  std::size_t count = 0;
  std::ptrdiff_t commas = 0;
  for (; std::getline(lines, line); ++count) {
    commas = count == 0 ? std::ranges::count(line, ',') : commas;
    CHECK(std::ranges::count(line, ',') == commas);
  }
  CHECK(count == 5);
  CHECK_THAT(text, Contains("frame,sampled,3,4.0000,7000,1.75,-100,-1.408"));
}

TEST_CASE("error table: files, which are the same for the same table, and replaced by the next") {
  std::string pattern = (fs::temp_directory_path() / "halfspace_error.XXXXXX").string();
  REQUIRE(mkdtemp(pattern.data()) != nullptr);
  const fs::path place = fs::path(pattern) / "out";
  std::string before;
  for (int i = 0; i < 2; ++i) {
    OutputFolder folder(place);
    write_error_files(folder, small_table());
    folder.commit();
    const std::string text = slurp(place / "error.json");
    CHECK((i == 0 || text == before));
    before = text;
  }
  const auto json = nlohmann::json::parse(before);
  CHECK(json["schema"] == "halfspace-error");
  CHECK(json["schema_version"] == 2);
  CHECK(json["config_hash"] == config_hash(Config{}));
  CHECK(json["files"] == nlohmann::json{"error.md", "error.csv", "error.json"});
  const auto& lines = json["workloads"][0]["fidelities"];
  CHECK(lines[0]["cycles"].is_null());
  CHECK(lines[1]["error"]["cycles"] == -100);
  CHECK(lines[1]["draws"].is_null());
  CHECK(lines[1]["function"].is_null());
  CHECK(lines[2]["draws"]["draws"] == 4);
  CHECK(lines[2]["stages"]["z_test"]["cycles_off"] == 0);
  CHECK(lines[3]["runs"] == nlohmann::json{100});
  CHECK(slurp(place / "error.md") == error_markdown(small_table()));
  CHECK(slurp(place / "error.csv") == error_csv(small_table()));
  std::ofstream(place / "mine.txt") << "keep";
  CHECK_THROWS_AS(OutputFolder(place), InputError);
  fs::remove_all(pattern);
}
