/// Depth as the machine has it: the front end, the unit setup, and the interpolator of the unit z_test.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "halfspace/study/precision/depth_triangle.hpp"
#include "halfspace/units/z_test.hpp"

namespace halfspace::study {

class UnitDepth {
 public:
  /// `size`: a power of two that the triangle's target has on a side.
  UnitDepth(const DepthTriangle& t, DepthFormat format, DepthInterpolator interpolator, std::uint32_t size);

  /// The stored code at a covered pixel of the target.
  [[nodiscard]] std::uint32_t code(std::int64_t x, std::int64_t y) const;

 private:
  EarlyZState state_;
  std::vector<SetupTriangle> pieces_;  ///< float32: the front end may give some pixels depths of their own
};

}  // namespace halfspace::study
