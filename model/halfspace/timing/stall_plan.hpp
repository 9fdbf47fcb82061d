/// Injected stalls: which packets of a link are held back, and for how long. A function of seed, link and
/// packet alone, so that every engine sees the same.
#pragma once

#include <array>
#include <cstdint>

#include "halfspace/machine/shape.hpp"
#include "halfspace/numerics/split_mix.hpp"

namespace halfspace {

struct StallPlan {
  /// Points whose packets share a stream of numbers; the next have that of the next seed.
  static constexpr std::uint64_t kStreams = 8;

  struct Rate {
    std::uint32_t percent = 0;     ///< of the packets that are held back, 0 to 100
    std::uint32_t max_cycles = 0;  ///< each for 1 to so many cycles

    [[nodiscard]] bool any() const { return percent != 0 && max_cycles != 0; }
  };
  std::uint64_t seed = 0;
  std::array<Rate, kStallPoints> rate{};

  [[nodiscard]] bool any() const {
    for (const Rate& point : rate) {
      if (point.any()) {
        return true;
      }
    }
    return false;
  }

  /// Cycles by which packet n is held back.
  [[nodiscard]] std::uint64_t cycles(StallPoint point, std::uint64_t n) const {
    const Rate& here = rate[static_cast<std::size_t>(point)];
    if (!here.any()) {
      return 0;
    }
    const auto i = static_cast<std::uint64_t>(point);
    const std::uint64_t z = SplitMix64::at(seed + i / kStreams, n * kStreams + i % kStreams).next();
    return (z & 0xFFFFFFFFu) % 100 < here.percent ? 1 + (z >> 32) % here.max_cycles : 0;
  }
};

}  // namespace halfspace
