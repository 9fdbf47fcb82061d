/// What the makers of triangles share: the guard band, and jobs to begin with.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "job.hpp"

namespace halfspace::tb {

inline constexpr std::int32_t kScreen = 16383;  // last pixel
inline constexpr std::array<std::uint8_t, 4> kFormats = {0, 1, 2, 4};

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
  [[nodiscard]] Point in_pixel(std::int64_t x, std::int64_t y, const SamplePosition& at) const {
    return {x * one + at.x * one / kSampleGrid, y * one + at.y * one / kSampleGrid};
  }
  [[nodiscard]] Point centre(std::int64_t x, std::int64_t y) const { return in_pixel(x, y, {}); }

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

/// A number for each job, in a field that only passes through.
inline void number(SetupJob& job, std::uint64_t index) {
  job.state.first_tile = static_cast<std::uint32_t>(index);
}

/// The whole screen, nothing culled.
inline DrawStatePacket open_state(std::uint8_t format) {
  DrawStatePacket state;
  state.x_last = state.y_last = kScreen;
  state.format = format;
  state.most_code = largest_code(static_cast<DepthFormat>(format));
  return state;
}

inline std::uint32_t largest_depth(std::uint8_t format) {
  const auto depth_format = static_cast<DepthFormat>(format);
  return format == 0
             ? 0x7FFFFFFF
             : static_cast<std::uint32_t>(vertex_depth_of_code(depth_format, largest_code(depth_format)));
}

}  // namespace halfspace::tb
