#include <numeric>

#include "fuzz_input.hpp"
#include "halfspace/core/functional.hpp"
#include "halfspace/scene/ptf.hpp"

namespace {

/// Small enough for thousands of runs a second.
bool is_small(const halfspace::Frame& frame) {
  const auto pixels = [](std::uint64_t sum, const halfspace::Target& t) {
    return sum + std::uint64_t{t.width} * t.height;
  };
  const auto indices = [](std::uint64_t sum, const halfspace::Command& c) { return sum + c.index_count; };
  return std::accumulate(frame.targets.begin(), frame.targets.end(), std::uint64_t{0}, pixels) < 65536 &&
         std::accumulate(frame.commands.begin(), frame.commands.end(), std::uint64_t{0}, indices) < 3000;
}

}  // namespace

// A frame that the reader accepts runs on every tile size, and each gives the same counts.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace halfspace;
  const auto frame = fuzz::read_or_reject([&] { return parse_ptf(fuzz::as_bytes(data, size), "fuzz"); });
  if (!frame || !is_small(*frame)) return 0;
  std::uint64_t survivors = 0;
  for (const int tile_size : {4, 8, 16}) {
    Config config;
    config.tile_walker.tile_size = tile_size;
    const Counters counters = run_functional(*frame, config).counters;
    if (tile_size != 4 && counters.early_z.survivors != survivors) std::abort();
    survivors = counters.early_z.survivors;
  }
  return 0;
}
