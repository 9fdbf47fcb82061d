/// Rectangles of pixels.
#pragma once

#include <algorithm>
#include <cstdint>

namespace halfspace::reference {

/// Pixels first_x <= x < end_x, first_y <= y < end_y.
struct PixelRect {
  std::int64_t first_x = 0;
  std::int64_t first_y = 0;
  std::int64_t end_x = 0;
  std::int64_t end_y = 0;
};

constexpr PixelRect intersect(const PixelRect& a, const PixelRect& b) {
  return {std::max(a.first_x, b.first_x), std::max(a.first_y, b.first_y), std::min(a.end_x, b.end_x),
          std::min(a.end_y, b.end_y)};
}

}  // namespace halfspace::reference
