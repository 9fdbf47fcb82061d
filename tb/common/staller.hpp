/// When the source of a link idles and its sink is not ready.
#pragma once

#include <cstdint>
#include <string>

#include "random.hpp"

namespace halfspace::tb {

enum class StallProfile : std::uint8_t {
  kNone,
  kLight,   ///< one cycle in eight
  kHeavy,   ///< three cycles in four
  kBursty,  ///< runs of 1 to 64 cycles of either
  kCustom,  ///< a given share of the cycles
};

inline std::string to_string(StallProfile profile) {
  switch (profile) {
    case StallProfile::kNone:
      return "none";
    case StallProfile::kLight:
      return "light";
    case StallProfile::kHeavy:
      return "heavy";
    case StallProfile::kBursty:
      return "bursty";
    case StallProfile::kCustom:
      return "custom";
  }
  return "?";
}

class Staller {
 public:
  /// `share` counts for kCustom only.
  Staller(StallProfile profile, double share, std::uint64_t seed)
      : profile_(profile), share_(share), random_(seed) {}

  /// One draw a cycle.
  bool stalled() {
    switch (profile_) {
      case StallProfile::kNone:
        return false;
      case StallProfile::kLight:
        return random_.below(8) == 0;
      case StallProfile::kHeavy:
        return random_.below(4) != 0;
      case StallProfile::kBursty:
        if (left_ == 0) {
          stalling_ = !stalling_;
          left_ = 1 + random_.below(64);
        }
        --left_;
        return stalling_;
      case StallProfile::kCustom:
        return random_.chance(share_);
    }
    return false;
  }

 private:
  StallProfile profile_;
  double share_;
  Random random_;
  bool stalling_ = false;
  std::uint64_t left_ = 0;
};

}  // namespace halfspace::tb
