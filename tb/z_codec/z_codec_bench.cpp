/// Bench of z_codec: z_encoder and z_decoder against the C++ unit and the contract of docs/units/z_codec.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "common/failure.hpp"
#include "z_codec/codec_coverage.hpp"
#include "z_codec/codec_run.hpp"
#include "z_codec/models.hpp"

namespace halfspace::tb {
namespace {

constexpr int kBinsMissed = 18;  // exit status, after those of FailureKind
constexpr std::uint64_t kResetPeriod = 20;

struct CodecCommandLine {
  std::string model;
  std::string test_case = "all";
  std::uint64_t seed = 1;
  std::uint64_t lines = 8000;
  std::string wave;
  std::string coverage;
  std::string fault = "none";
  std::string side = "encoder";
  std::uint64_t fault_packet = 100;
  std::string check = "all";
};

struct CodecCase {
  std::string name;
  CodecRunOptions options;
};

/// Every case without gaps and with short, long and mixed ones.
std::vector<CodecCase> codec_cases(const CodecCommandLine& command_line) {
  static constexpr std::array kProfiles = {StallProfile::kNone, StallProfile::kLight, StallProfile::kHeavy,
                                           StallProfile::kBursty};
  std::vector<CodecCase> all;
  for (const char* name : {"directed", "random", "reset"}) {
    for (const StallProfile idle : kProfiles) {
      CodecChecks checks{.packets = command_line.check != "timing",
                         .timing = command_line.check != "packets"};
      CodecRunOptions options{.seed = command_line.seed + all.size(),
                              .idle = idle,
                              .directed = std::string(name) == "directed",
                              .reset_period = std::string(name) == "reset" ? kResetPeriod : 0,
                              .encoder = checks,
                              .decoder = checks,
                              .wave_file = {},
                              .coverage_file = {}};
      CodecChecks& faulty = command_line.side == "encoder" ? options.encoder : options.decoder;
      faulty.fault = codec_fault_by_name(command_line.fault).value();
      faulty.fault_packet = command_line.fault_packet;
      all.push_back({name, options});
    }
  }
  std::erase_if(all, [&](const CodecCase& one) {
    return command_line.test_case != "all" && one.name != command_line.test_case;
  });
  const auto random = static_cast<std::uint64_t>(
      std::ranges::count_if(all, [](const CodecCase& one) { return !one.options.directed; }));
  for (CodecCase& one : all) {
    one.options.lines = one.options.directed ? 0 : command_line.lines / random + 1;
  }
  return all;
}

int run_all(const CodecCommandLine& command_line) {
  const std::vector<CodecModel> models = z_codec_models();
  const auto model = command_line.model.empty()
                         ? models.begin()
                         : std::ranges::find(models, command_line.model, &CodecModel::name);
  if (model == models.end()) {
    fmt::print(stderr, "model '{}' is not in this bench\n", command_line.model);
    return 1;
  }
  const std::vector<CodecCase> all = codec_cases(command_line);
  CodecCoverage coverage(model->shape);
  std::uint64_t encoded = 0;
  std::uint64_t decoded = 0;
  std::uint64_t cycles = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    CodecRunOptions options = all[i].options;
    if (!command_line.wave.empty()) {
      options.wave_file = fmt::format("{}{}.fst", command_line.wave, i);
    }
    if (!command_line.coverage.empty()) {
      options.coverage_file = fmt::format("{}{}.dat", command_line.coverage, i);
    }
    const std::unique_ptr<CodecDut> dut = model->make(options.seed);
    const CodecRunResult result = run_codec(*dut, model->shape, options, coverage);
    const std::string name =
        fmt::format("{} idle={} seed={}", all[i].name, to_string(options.idle), options.seed);
    if (result.failure) {
      fmt::print("FAIL z_codec {}: {}\n{} in cycle {}: {}\n", model->name, name,
                 to_string(result.failure->kind), result.failure->cycle, result.failure->message);
      return static_cast<int>(result.failure->kind);
    }
    fmt::print("pass {}: {} lines encoded, {} decoded, in {} cycles\n", name, result.encoded, result.decoded,
               result.cycles);
    encoded += result.encoded;
    decoded += result.decoded;
    cycles += result.cycles;
  }
  const bool whole =
      command_line.test_case == "all" && command_line.check == "all" && command_line.coverage.empty();
  if (!coverage.report() && whole) {
    return kBinsMissed;
  }
  fmt::print("PASS z_codec {}: {} lines encoded, {} decoded, {} cycles\n", model->name, encoded, decoded,
             cycles);
  return 0;
}

}  // namespace
}  // namespace halfspace::tb

int main(int argc, char** argv) {
  using namespace halfspace::tb;
  CodecCommandLine command_line;
  CLI::App app{"Compares the RTL of z_codec with its C++ definition, line by line and cycle by cycle"};
  app.add_option("--model", command_line.model, "configuration of the RTL");
  app.add_option("--case", command_line.test_case, "what to send")
      ->check(CLI::IsMember({"all", "directed", "random", "reset"}))
      ->capture_default_str();
  app.add_option("--seed", command_line.seed, "of stimulus, gaps and register values before reset")
      ->capture_default_str();
  app.add_option("--lines", command_line.lines, "random ones of all runs together, for either side")
      ->capture_default_str();
  app.add_option("--wave", command_line.wave, "beginning of the names of waveforms (FST), one a run");
  app.add_option("--coverage", command_line.coverage, "the same for coverage, of a model built with it");
  app.add_option("--fault", command_line.fault, "fault between the RTL and its checkers, which must find it")
      ->check([](const std::string& name) {
        return codec_fault_by_name(name) ? std::string() : "no fault of the name " + name;
      });
  app.add_option("--side", command_line.side, "where it is")
      ->check(CLI::IsMember({"encoder", "decoder"}))
      ->capture_default_str();
  app.add_option("--fault-packet", command_line.fault_packet, "the line that it is about")
      ->capture_default_str();
  app.add_option("--check", command_line.check, "checkers to use")
      ->check(CLI::IsMember({"all", "packets", "timing"}))
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  return run_all(command_line);
}
