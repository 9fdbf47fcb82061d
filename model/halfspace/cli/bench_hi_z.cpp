/// halfspace bench hi-z: the share of an oracle's kills that hi_z has, by bits of a bound and lag, and by
/// time.
#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "halfspace/cli/bench.hpp"
#include "halfspace/cli/load_input.hpp"
#include "halfspace/cli/options.hpp"
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
    choices.push_back({.bits = bits, .lag = config.hi_z.lag, .timed = true});
    choices.push_back({.bits = bits, .lag = std::nullopt});
  }
  const std::size_t row = options.lags.size() + 2;
  std::string head = "| frame | bursts that test | die | first oracle | second oracle | bits |";
  std::string rule = "|---|---:|---:|---:|---:|---:|";
  for (const int lag : options.lags) {
    head += fmt::format(" lag {} |", lag);
    rule += "---:|";
  }
  head += fmt::format(" by time | cycles, lag {} | cycles, by time |", config.hi_z.lag);
  rule += "---:|---:|---:|";
  fmt::print(
      "die: of all bursts; oracles: of those that die; by lag and by time: of those that the second oracle "
      "kills\n\n");
  fmt::print("{}\n{}\n", head, rule);
  for (const std::string& input : options.inputs) {
    const Frame frame = load_input(input);
    const whatif::HiZKills kills = whatif::count_hi_z_kills(frame, config, choices);
    for (std::size_t i = 0; i < options.bits.size(); ++i) {
      fmt::print("| {} | {} | {} | {} | {} | {} |", frame.name, kills.bursts, share(kills.dead, kills.bursts),
                 share(kills.oracle_samples, kills.dead), share(kills.oracle_plane, kills.dead),
                 options.bits[i]);
      for (std::size_t k = 0; k < options.lags.size(); ++k) {
        fmt::print(" {} |", share(kills.choices[i * row + k], kills.oracle_plane));
      }
      const std::size_t by_time = i * row + row - 1;
      fmt::print(" {} | {} | {} |\n", share(kills.choices[by_time], kills.oracle_plane),
                 kills.cycles[by_time - 1], kills.cycles[by_time]);
    }
  }
}

}  // namespace

void add_bench_hi_z(CLI::App& bench) {
  auto options = std::make_shared<HiZOptions>();
  CLI::App* command =
      bench.add_subcommand("hi-z", "the bursts that hi_z stops, beside an oracle, by bits, lag and time");
  command->add_option("INPUT", options->inputs, "frames, meshes or synthetic:NAME")->required();
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
