/// Injected stalls: which packets of a link are held back, and for how long. A function of seed, link and
/// packet alone, so that every engine sees the same.
#pragma once

#include <array>
#include <cstdint>

namespace halfspace {

/// Where stalls can be injected. Packet n of a link counts as visible so many cycles later; triangle n of the
/// source arrives, and burst n at the sink is taken, so many cycles later.
enum class StallPoint : std::uint8_t {
  kSource,
  kSetup,
  kTileWalker,
  kEdgeEvaluator,
  kQuadGenerator,
  kSink,
};
inline constexpr std::size_t kStallPoints = 6;
inline constexpr std::array<const char*, kStallPoints> kStallPointName{
    "source", "setup", "tile_walker", "edge_evaluator", "quad_generator", "sink"};

struct StallPlan {
  struct Rate {
    std::uint32_t percent = 0;     ///< of the packets that are held back, 0 to 100
    std::uint32_t max_cycles = 0;  ///< each for 1 to so many cycles
  };
  std::uint64_t seed = 0;
  std::array<Rate, kStallPoints> rate{};

  [[nodiscard]] bool any() const {
    for (const Rate& point : rate) {
      if (point.percent != 0 && point.max_cycles != 0) {
        return true;
      }
    }
    return false;
  }

  /// Cycles by which packet n is held back.
  [[nodiscard]] std::uint64_t cycles(StallPoint point, std::uint64_t n) const {
    const Rate& here = rate[static_cast<std::size_t>(point)];
    if (here.percent == 0 || here.max_cycles == 0) {
      return 0;
    }
    // splitmix64: G. L. Steele, D. Lea, C. H. Flood, "Fast splittable pseudorandom number generators", 2014
    std::uint64_t z = seed + (n * kStallPoints + static_cast<std::uint64_t>(point) + 1) * 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    z ^= z >> 31;
    return (z & 0xFFFFFFFFu) % 100 < here.percent ? 1 + (z >> 32) % here.max_cycles : 0;
  }
};

}  // namespace halfspace
