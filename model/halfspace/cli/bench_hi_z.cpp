/// halfspace bench hi-z: the share of an oracle's kills that hi_z has, by bits of a bound and lag.
#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "halfspace/cli/bench.hpp"
#include "halfspace/cli/options.hpp"
#include "halfspace/scene/load.hpp"
#include "halfspace/whatif/hi_z_study.hpp"

namespace halfspace {
namespace {

struct HiZOptions {
  std::vector<std::string> inputs;
  MachineOptions machine;
  std::vector<int> bits{8, 32};
  std::vector<int> lags{1, 4, 16, 64, 128, 256, 1024};
};

std::string share(std::uint64_t part, std::uint64_t all) {
  return all == 0 ? "-"
                  : fmt::format("{:.1f} %", 100.0 * static_cast<double>(part) / static_cast<double>(all));
}

void bench_hi_z(const HiZOptions& options) {
  const Config config = options.machine.config();
  std::vector<whatif::HiZChoice> choices;
  for (const int bits : options.bits) {
    for (const int lag : options.lags) {
      choices.push_back({.bits = bits, .lag = lag});
    }
  }
  std::string head = "| frame | bursts that test | die | oracle kills | knowing the plane |";
  std::string rule = "|---|---:|---:|---:|---:|";
  for (const whatif::HiZChoice& choice : choices) {
    head += fmt::format(" {} bits, lag {} |", choice.bits, choice.lag);
    rule += "---:|";
  }
  fmt::print("shares: of all bursts; of those that die; then of the oracle's kills\n\n{}\n{}\n", head, rule);
  for (const std::string& input : options.inputs) {
    const Frame frame = load(input);
    const whatif::HiZKills kills = whatif::count_hi_z_kills(frame, config, choices);
    fmt::print("| {} | {} | {} | {} | {} |", frame.name, kills.bursts, share(kills.dead, kills.bursts),
               share(kills.oracle_samples, kills.dead), share(kills.oracle_plane, kills.oracle_samples));
    for (const std::uint64_t stopped : kills.choices) {
      fmt::print(" {} |", share(stopped, kills.oracle_samples));
    }
    fmt::print("\n");
  }
}

}  // namespace

void add_bench_hi_z(CLI::App& bench) {
  auto options = std::make_shared<HiZOptions>();
  CLI::App* command =
      bench.add_subcommand("hi-z", "the bursts that hi_z stops, beside an oracle, by bits and lag");
  command->add_option("INPUT", options->inputs, "frames (PTF1) or synthetic:NAME")->required();
  options->machine.add_to(*command);
  command->add_option("--bits", options->bits, "bits of a bound")
      ->delimiter(',')
      ->check(CLI::Range(4, 32))
      ->capture_default_str();
  command->add_option("--lags", options->lags, "lags, in tile jobs")
      ->delimiter(',')
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->callback([options] { bench_hi_z(*options); });
}

}  // namespace halfspace
