/// halfspace bench roof: how many depth tests a second the processor does at best.
#include <fmt/format.h>

#include <memory>

#include "halfspace/cli/bench.hpp"
#include "halfspace/cli/options.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/speed/roof.hpp"
#include "halfspace/speed/speed_table.hpp"

namespace halfspace {
namespace {

/// Thousands of millions of tests a second, over and over in the same memory.
Spread tests(std::size_t bytes, int repeat) {
  constexpr std::size_t kTests = std::size_t{1} << 28;
  constexpr std::uint32_t kFar = 0x7FFFFFFF;
  std::vector<std::uint32_t> stored(bytes / sizeof(std::uint32_t), kFar);
  std::uint32_t first = kFar;
  std::uint64_t passed = 0;
  std::vector<double> rates;
  const std::size_t passes = std::max<std::size_t>(kTests / stored.size(), 1);
  for (int i = 0; i < repeat; ++i) {
    const double ms = milliseconds([&] {
      for (std::size_t pass = 0; pass < passes; ++pass) {
        passed += test_in_a_row(stored, --first, 0);
      }
    });
    rates.push_back(static_cast<double>(passes * stored.size()) / ms / 1e6);
  }
  if (passed != passes * stored.size() * static_cast<std::size_t>(repeat)) {
    throw DisagreementError(fmt::format("bench roof: {} tests passed; all should", passed));
  }
  return spread(rates);
}

void bench_roof(int repeat) {
  fmt::print("one thread, medians of {} runs (least to most); every sample is tested and written\n\n",
             repeat);
  fmt::print("| depth codes | MiB | Gsamples/s |\n|---|---:|---:|\n");
  constexpr std::size_t kKiB = 1024;
  constexpr std::size_t kFullHd = std::size_t{1920} * 1080 * sizeof(std::uint32_t);
  for (const auto& [name, bytes] :
       {std::pair{"in the first cache", 16 * kKiB}, std::pair{"in the second", 256 * kKiB},
        std::pair{"a surface of 1920x1080", kFullHd}, std::pair{"in memory", 512 * kKiB * kKiB}}) {
    const Spread rate = tests(bytes, repeat);
    fmt::print("| {} | {:.3g} | {:.1f} ({:.1f} to {:.1f}) |\n", name,
               static_cast<double>(bytes) / static_cast<double>(kKiB * kKiB), rate.median, rate.least,
               rate.most);
  }
}

}  // namespace

void add_bench_roof(CLI::App& bench) {
  auto repeat = std::make_shared<int>(5);
  CLI::App* command =
      bench.add_subcommand("roof", "how many depth tests a second the processor does at best");
  command->add_option("--repeat", *repeat, "number of timed runs of each")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->callback([repeat] { bench_roof(*repeat); });
}

}  // namespace halfspace
