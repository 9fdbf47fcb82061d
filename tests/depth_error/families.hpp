/// Random triangles whose depth is measured, by family: what they look like and what their draw does to
/// depth.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string_view>

#include "../frames.hpp"
#include "../property/random.hpp"
#include "halfspace/reference/exact_triangle.hpp"
#include "halfspace/scene/frame.hpp"

namespace halfspace::testing {

enum class Family { kAny, kPixel, kSliver, kGuardBand, kReversed, kOffset, kClamp };

struct FamilyName {
  Family family;
  std::string_view text;
};

inline constexpr std::array kFamilies{
    FamilyName{Family::kAny, "any on the target"},
    FamilyName{Family::kPixel, "about a pixel"},
    FamilyName{Family::kSliver, "slivers"},
    FamilyName{Family::kGuardBand, "to the guard band"},
    FamilyName{Family::kReversed, "reversed: any exponent, and 0"},
    FamilyName{Family::kOffset, "polygon offset"},
    FamilyName{Family::kClamp, "depth clamp: up to 2^20 and below 0"},
};

/// A triangle in window coordinates that a float32 of clip space holds, on the grid of 1/256 pixel, and the
/// state of its draw.
struct Sample {
  std::array<std::array<std::int64_t, 2>, 3> xy;  ///< in sub-pixels
  std::array<float, 3> z;
  Command state;

  [[nodiscard]] reference::GridTriangle grid() const {
    return {reference::GridPoint{xy[0][0], xy[0][1]}, {xy[1][0], xy[1][1]}, {xy[2][0], xy[2][1]}};
  }
};

class FamilySource {
 public:
  FamilySource(Family family, std::int64_t size, std::uint64_t seed)
      : family_(family), extent_(size * 256), random_(seed) {}

  Sample next() {
    Sample sample;
    const int shape = family_ == Family::kAny         ? 0
                      : family_ == Family::kPixel     ? 1
                      : family_ == Family::kSliver    ? 2
                      : family_ == Family::kGuardBand ? 3
                                                      : static_cast<int>(random_.between(0, 3));
    place(sample, shape);
    const bool flat = random_.between(0, 15) == 0;
    for (float& z : sample.z) {
      z = flat && &z != sample.z.data() ? sample.z[0] : depth();
    }
    if (family_ == Family::kOffset) {
      sample.state.flags |= bits({Flag::kPolygonOffset});
      sample.state.offset_factor = random_.between(0, 3) == 0 ? 0 : any(-10, 3);
      sample.state.offset_units = random_.between(0, 3) == 0 ? 0 : any(0, 20);
      sample.state.offset_clamp = random_.between(0, 1) == 0 ? 0 : any(-10, -1);
    }
    if (family_ == Family::kClamp) {
      sample.state.flags |= bits({Flag::kDepthClamp});
    }
    return sample;
  }

  /// 0 to 1.
  double fraction() { return static_cast<double>(random_.between(0, 1 << 24)) / (1 << 24); }

 private:
  void place(Sample& sample, int shape) {
    constexpr std::int64_t kFar = std::int64_t{32766} * 256;
    const std::array centre{random_.between(0, extent_), random_.between(0, extent_)};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t axis = 0; axis < 2; ++axis) {
        std::int64_t& value = sample.xy[i][axis];
        switch (shape) {
          case 0:
            value = random_.between(-extent_ / 4, extent_ * 5 / 4);
            break;
          case 1:
            value = centre[axis] + random_.between(-256, 256);
            break;
          case 2:  // the third vertex lies next to the line through the others
            value = i < 2 ? random_.between(0, extent_)
                          : (sample.xy[0][axis] + sample.xy[1][axis]) / 2 + random_.between(-3, 3);
            break;
          default:
            value = random_.between(-kFar, kFar);
        }
      }
    }
  }

  float depth() {
    if (family_ == Family::kReversed) {
      const int kind = static_cast<int>(random_.between(0, 7));
      return kind == 0 ? 0 : std::ldexp(unit(), -static_cast<int>(random_.between(0, kind < 3 ? 149 : 40)));
    }
    if (family_ == Family::kClamp) {
      return any(-24, 20);
    }
    const int kind = static_cast<int>(random_.between(0, 9));
    return kind == 0 ? 0 : kind == 1 ? 1 : unit();
  }

  float unit() { return static_cast<float>(fraction()); }
  float any(int least, int most) {
    return std::ldexp(2 * unit() - 1, static_cast<int>(random_.between(least, most)));
  }

  Family family_;
  std::int64_t extent_;
  Random random_;
};

}  // namespace halfspace::testing
