/// Bench of hi_z: the RTL against the C++ unit and the contract of docs/units/hi_z.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "common/failure.hpp"
#include "hi_z/hi_z_coverage.hpp"
#include "hi_z/hi_z_run.hpp"
#include "hi_z/models.hpp"
#include "hi_z/workload.hpp"

namespace halfspace::tb {
namespace {

constexpr int kBinsMissed = 18;  // exit status, after those of FailureKind

struct HiZCommandLine {
  std::string model;
  std::string test_case = "all";
  std::uint64_t seed = 1;
  std::uint64_t blocks = 20000;
  std::string wave;
  std::string coverage;
  std::string fault = "none";
  std::uint64_t fault_packet = 100;
  std::string check = "all";
};

struct HiZCase {
  std::string name;
  HiZStyle style = HiZStyle::kDrawn;
  HiZRunOptions options;
};

/// The stalls and delays that the runs of each case go through.
std::vector<HiZCase> hi_z_cases(const HiZCommandLine& command_line) {
  using enum StallProfile;
  struct Profile {
    StallProfile idle;
    StallProfile stall;
    std::uint64_t delay;
  };
  static constexpr std::array<Profile, 6> kProfiles = {{{kNone, kNone, 1},
                                                        {kNone, kNone, 60},
                                                        {kLight, kLight, 8},
                                                        {kNone, kHeavy, 30},
                                                        {kHeavy, kNone, 200},
                                                        {kBursty, kBursty, 20}}};
  struct Kind {
    const char* name;
    HiZStyle style;
  };
  static constexpr std::array<Kind, 4> kKinds = {{{"random", HiZStyle::kDrawn},
                                                  {"one-block", HiZStyle::kOneBlock},
                                                  {"words", HiZStyle::kMadeUp},
                                                  {"reset", HiZStyle::kOneBlock}}};
  std::vector<HiZCase> all;
  for (const Kind& kind : kKinds) {
    for (std::size_t i = 0; i < kProfiles.size(); ++i) {
      const Profile& profile = kProfiles[i];
      const bool reset = std::string(kind.name) == "reset";
      HiZRunOptions options{.seed = command_line.seed + all.size(),
                            .idle = profile.idle,
                            .stall = profile.stall,
                            .delay = profile.delay,
                            .cut = reset ? 30 + 97 * i * i : 0,
                            .fault = hi_z_fault_by_name(command_line.fault).value(),
                            .fault_packet = command_line.fault_packet,
                            .packets = command_line.check != "timing",
                            .timing = command_line.check != "packets",
                            .wave_file = {},
                            .coverage_file = {}};
      all.push_back({kind.name, kind.style, options});
    }
  }
  std::erase_if(all, [&](const HiZCase& one) {
    return command_line.test_case != "all" && one.name != command_line.test_case;
  });
  return all;
}

int run_all(const HiZCommandLine& command_line) {
  const std::vector<HiZModel> models = hi_z_models();
  const auto model = command_line.model.empty()
                         ? models.begin()
                         : std::ranges::find(models, command_line.model, &HiZModel::name);
  if (model == models.end()) {
    fmt::print(stderr, "model '{}' is not in this bench\n", command_line.model);
    return 1;
  }
  const std::vector<HiZCase> all = hi_z_cases(command_line);
  HiZCoverage coverage(model->shape);
  std::uint64_t blocks = 0;
  std::uint64_t rejected = 0;
  std::uint64_t cycles = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    HiZRunOptions options = all[i].options;
    if (!command_line.wave.empty()) {
      options.wave_file = fmt::format("{}{}.fst", command_line.wave, i);
    }
    if (!command_line.coverage.empty()) {
      options.coverage_file = fmt::format("{}{}.dat", command_line.coverage, i);
    }
    const HiZWorkload workload =
        make_hi_z_workload(model->shape, all[i].style, options.seed, command_line.blocks / all.size() + 1);
    const std::unique_ptr<HiZDut> dut = model->make(options.seed);
    const HiZRunResult result = run_hi_z(*dut, model->shape, workload, options, coverage);
    const std::string name =
        fmt::format("{} idle={} stall={} delay={} seed={}", all[i].name, to_string(options.idle),
                    to_string(options.stall), options.delay, options.seed);
    if (result.failure) {
      fmt::print("FAIL hi_z {}: {}\n{} in cycle {}: {}\n", model->name, name, to_string(result.failure->kind),
                 result.failure->cycle, result.failure->message);
      return static_cast<int>(result.failure->kind);
    }
    fmt::print("pass {}: {} blocks left, {} rejected whole, in {} cycles\n", name, result.blocks,
               result.rejected, result.cycles);
    blocks += result.blocks;
    rejected += result.rejected;
    cycles += result.cycles;
  }
  const bool whole =
      command_line.test_case == "all" && command_line.check == "all" && command_line.coverage.empty();
  if (!coverage.report() && whole) {
    return kBinsMissed;
  }
  fmt::print("PASS hi_z {}: {} blocks compared, {} rejected whole, {} cycles\n", model->name, blocks,
             rejected, cycles);
  return 0;
}

}  // namespace
}  // namespace halfspace::tb

int main(int argc, char** argv) {
  using namespace halfspace::tb;
  HiZCommandLine command_line;
  CLI::App app{"Compares the RTL of hi_z with its C++ definition, block by block and cycle by cycle"};
  app.add_option("--model", command_line.model, "configuration of the RTL");
  app.add_option("--case", command_line.test_case, "what to send")
      ->check(CLI::IsMember({"all", "random", "one-block", "words", "reset"}))
      ->capture_default_str();
  app.add_option("--seed", command_line.seed, "of stimulus, stalls and register values before reset")
      ->capture_default_str();
  app.add_option("--blocks", command_line.blocks, "of all runs together")->capture_default_str();
  app.add_option("--wave", command_line.wave, "beginning of the names of waveforms (FST), one a run");
  app.add_option("--coverage", command_line.coverage, "the same for coverage, of a model built with it");
  app.add_option("--fault", command_line.fault, "fault between the RTL and its checkers, which must find it")
      ->check([](const std::string& name) {
        return hi_z_fault_by_name(name) ? std::string() : "no fault of the name " + name;
      });
  app.add_option("--fault-packet", command_line.fault_packet, "the block or job that it is about")
      ->capture_default_str();
  app.add_option("--check", command_line.check, "checkers to use")
      ->check(CLI::IsMember({"all", "packets", "timing"}))
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  return run_all(command_line);
}
