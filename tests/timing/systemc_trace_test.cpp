// The waveform tells the same as the counts.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "halfspace/timing/systemc/run_systemc.hpp"
#include "random_machine.hpp"

using namespace halfspace;
using namespace halfspace::testing;

namespace {

/// By signal, the cycles that each value lasted before `end`.
std::map<std::string, std::map<std::uint64_t, std::uint64_t>> read_vcd(const std::filesystem::path& path,
                                                                       std::uint64_t end) {
  std::map<std::string, std::string> name_of_code;
  std::map<std::string, std::pair<std::uint64_t, std::uint64_t>> now;  // by name: value, since when
  std::map<std::string, std::map<std::uint64_t, std::uint64_t>> lasted;
  std::ifstream file(path);
  std::string scope;
  std::uint64_t time = 0;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "$scope") {
      words >> word >> scope;
    } else if (word == "$var") {
      std::string code;
      std::string name;
      words >> word >> word >> code >> name;
      name_of_code[code] = scope + "." + name;
    } else if (word.starts_with('#')) {
      time = std::stoull(word.substr(1));
    } else if (word.starts_with('b')) {
      std::string code;
      words >> code;
      auto& [value, since] = now[name_of_code.at(code)];
      lasted[name_of_code[code]][value] += std::min(time, end) - std::min(since, end);
      value = std::stoull(word.substr(1), nullptr, 2);
      since = time;
    }
  }
  for (const auto& [name, state] : now) {
    lasted[name][state.first] += end - std::min(state.second, end);
  }
  return lasted;
}

}  // namespace

TEST_CASE("a waveform has every change of every link and every busy cycle of every stage", "[timing]") {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("halfspace_trace_" + std::to_string(getpid()) + ".vcd");
  for (std::uint64_t n = 0; n < 20; ++n) {
    CAPTURE(seed(), n);
    Random random(seed() + n);
    const Config config = random_config(random);
    const Frame frame = random_frame(random);
    const EngineOptions options{.watch = {}, .stalls = random_stalls(random)};
    const TimedResult run = run_systemc(frame, config, options);
    REQUIRE(run_systemc(frame, config, options, {.vcd = path}).cycles == run.cycles);

    auto lasted = read_vcd(path, run.cycles.cycles);
    for (std::size_t i = 0; i < kLinks; ++i) {
      CAPTURE(kLinkName[i]);
      const Occupancy& occupancy = run.cycles.stats.occupancy[i];
      auto& values = lasted.at("links." + std::string(kLinkName[i]));
      for (std::size_t used = 0; used < occupancy.size(); ++used) {
        CHECK(values[used] == occupancy[used]);
      }
    }
    for (std::size_t i = 0; i < kStages; ++i) {
      CAPTURE(kStageInfo[i].name);
      CHECK(lasted.at("stages." + std::string(kStageInfo[i].name))[0] == run.cycles.stats.stage[i].busy);
    }
  }
  std::filesystem::remove(path);
}
