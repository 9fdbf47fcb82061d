/// Places of vertices for the setup bench.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "job.hpp"

namespace halfspace::tb {

inline constexpr std::int32_t kScreen = 16383;  ///< last pixel

struct Point {
  std::int64_t x = 0;
  std::int64_t y = 0;
};

/// The guard band of a configuration.
struct Band {
  explicit Band(const Widths& widths)
      : one(std::int64_t{1} << widths.SubPixelBits),
        low(-(std::int64_t{1} << (widths.CoordBits - 1))),
        high(-low - 1) {}

  [[nodiscard]] Point clamp(Point p) const {
    return {std::clamp(p.x, low, high), std::clamp(p.y, low, high)};
  }
  [[nodiscard]] Point centre(std::int64_t x, std::int64_t y) const {
    return {x * one + one / 2, y * one + one / 2};
  }

  std::int64_t one;  ///< a pixel
  std::int64_t low;
  std::int64_t high;
};

inline void set_vertices(SetupJob& job, const std::array<Point, 3>& points) {
  for (std::size_t i = 0; i < 3; ++i) {
    job.triangle.x[i] = static_cast<std::int32_t>(points[i].x);
    job.triangle.y[i] = static_cast<std::int32_t>(points[i].y);
  }
}

/// The whole screen, nothing culled.
inline DrawStatePacket open_state(std::uint8_t format) {
  DrawStatePacket state;
  state.x_last = state.y_last = kScreen;
  state.format = format;
  state.most_code = largest_code(static_cast<DepthFormat>(format));
  return state;
}

}  // namespace halfspace::tb
