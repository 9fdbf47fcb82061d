/// halfspace_study_precision: how wrong the arithmetics of edges and of depth are, and how fast, as JSON.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "halfspace/numerics/error.hpp"
#include "halfspace/scene/load.hpp"
#include "halfspace/study/precision/depth_report.hpp"
#include "halfspace/study/precision/edge_report.hpp"

namespace {

void write(const nlohmann::ordered_json& report, const std::string& path) {
  const std::string text = report.dump(1) + "\n";
  if (path == "-") {
    fmt::print("{}", text);
    return;
  }
  std::ofstream out(path);
  out << text;
  out.close();
  if (!out) {
    throw halfspace::InputError(fmt::format("{} cannot be written", path));
  }
}

}  // namespace

int main(int argc, char** argv) {
  using namespace halfspace;
  CLI::App app{"How wrong the arithmetics of edges and of depth are, and how fast: docs/guides/precision.md",
               "halfspace_study_precision"};
  std::uint64_t samples = 4'000'000;
  std::uint64_t depth_samples = 100'000;
  std::uint64_t seed = 1;
  int rounds = 15;
  std::string json = "-";
  std::vector<std::filesystem::path> frames;
  app.add_option("--samples", samples, "samples of edges in each family")->capture_default_str();
  app.add_option("--depth-samples", depth_samples, "samples of depth in each family and format")
      ->capture_default_str();
  app.add_option("--seed", seed, "of all that is random")->capture_default_str();
  app.add_option("--rounds", rounds, "of the measurement of run time")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  app.add_option("--json", json, "file for the results; -: standard output")->capture_default_str();
  app.add_option("frames", frames, "frames (.ptf, .ptf.xz) to draw too");
  CLI11_PARSE(app, argc, argv);
  try {
    for (const std::filesystem::path& frame : frames) {
      (void)load(frame);  // what is wrong with one is better said before minutes of measuring
    }
    nlohmann::ordered_json report{{"schema", "halfspace-precision"}, {"schema_version", 1}, {"seed", seed}};
    report["edges"] = study::edge_report(samples, seed, rounds, frames);
    report["depth"] = study::depth_report(depth_samples, seed, frames);
    write(report, json);
  } catch (const InputError& error) {
    fmt::print(stderr, "halfspace_study_precision: {}\n", error.what());
    return 1;
  }
  return 0;
}
