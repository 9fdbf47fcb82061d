/// Random triangles whose depth is measured, by family: what they look like and what their draw does to
/// depth.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string_view>

#include "halfspace/reference/exact_triangle.hpp"
#include "halfspace/scene/frame.hpp"

namespace halfspace::stress {

enum class DepthFamily { kAny, kPixel, kSliver, kGuardBand, kReversed, kOffset, kClamp };

struct DepthFamilyName {
  DepthFamily family;
  std::string_view text;
};

inline constexpr std::array kDepthFamilies{
    DepthFamilyName{DepthFamily::kAny, "any on the target"},
    DepthFamilyName{DepthFamily::kPixel, "about a pixel"},
    DepthFamilyName{DepthFamily::kSliver, "slivers"},
    DepthFamilyName{DepthFamily::kGuardBand, "to the guard band"},
    DepthFamilyName{DepthFamily::kReversed, "reversed: any exponent, and 0"},
    DepthFamilyName{DepthFamily::kOffset, "polygon offset"},
    DepthFamilyName{DepthFamily::kClamp, "depth clamp: up to 2^20 and below 0"},
};

/// A triangle in window coordinates that a float32 of clip space holds, on the grid of 1/256 pixel, and the
/// state of its draw.
struct DepthSample {
  std::array<std::array<std::int64_t, 2>, 3> xy;  ///< in sub-pixels
  std::array<float, 3> z;
  Command state;

  [[nodiscard]] reference::GridTriangle grid() const {
    return {reference::GridPoint{xy[0][0], xy[0][1]}, {xy[1][0], xy[1][1]}, {xy[2][0], xy[2][1]}};
  }
};

class DepthFamilySource {
 public:
  DepthFamilySource(DepthFamily family, std::int64_t size, std::uint64_t seed)
      : family_(family), extent_(size * 256), random_(seed) {}

  DepthSample next() {
    DepthSample sample;
    const int shape = family_ == DepthFamily::kAny         ? 0
                      : family_ == DepthFamily::kPixel     ? 1
                      : family_ == DepthFamily::kSliver    ? 2
                      : family_ == DepthFamily::kGuardBand ? 3
                                                           : static_cast<int>(between(0, 3));
    place(sample, shape);
    const bool flat = between(0, 15) == 0;
    for (float& z : sample.z) {
      z = flat && &z != sample.z.data() ? sample.z[0] : depth();
    }
    if (family_ == DepthFamily::kOffset) {
      sample.state.flags |= bits({Flag::kPolygonOffset});
      sample.state.offset_factor = between(0, 3) == 0 ? 0 : any(-10, 3);
      sample.state.offset_units = between(0, 3) == 0 ? 0 : any(0, 20);
      sample.state.offset_clamp = between(0, 1) == 0 ? 0 : any(-10, -1);
    }
    if (family_ == DepthFamily::kClamp) {
      sample.state.flags |= bits({Flag::kDepthClamp});
    }
    return sample;
  }

  /// 0 to 1.
  double fraction() { return static_cast<double>(between(0, 1 << 24)) / (1 << 24); }

 private:
  /// low to high, both included, but for a bias of the remainder below 2^-30.
  std::int64_t between(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(high - low + 1));
  }

  void place(DepthSample& sample, int shape) {
    constexpr std::int64_t kFar = std::int64_t{32766} * 256;
    const std::array centre{between(0, extent_), between(0, extent_)};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t axis = 0; axis < 2; ++axis) {
        std::int64_t& value = sample.xy[i][axis];
        switch (shape) {
          case 0:
            value = between(-extent_ / 4, extent_ * 5 / 4);
            break;
          case 1:
            value = centre[axis] + between(-256, 256);
            break;
          case 2:  // the third vertex lies next to the line through the others
            value =
                i < 2 ? between(0, extent_) : (sample.xy[0][axis] + sample.xy[1][axis]) / 2 + between(-3, 3);
            break;
          default:
            value = between(-kFar, kFar);
        }
      }
    }
  }

  float depth() {
    if (family_ == DepthFamily::kReversed) {
      const int kind = static_cast<int>(between(0, 7));
      return kind == 0 ? 0 : std::ldexp(unit(), -static_cast<int>(between(0, kind < 3 ? 149 : 40)));
    }
    if (family_ == DepthFamily::kClamp) {
      return any(-24, 20);
    }
    const int kind = static_cast<int>(between(0, 9));
    return kind == 0 ? 0 : kind == 1 ? 1 : unit();
  }

  float unit() { return static_cast<float>(fraction()); }
  float any(int least, int most) {
    return std::ldexp(2 * unit() - 1, static_cast<int>(between(least, most)));
  }

  DepthFamily family_;
  std::int64_t extent_;
  std::mt19937_64 random_;  // its output is fixed by the C++ standard
};

}  // namespace halfspace::stress
