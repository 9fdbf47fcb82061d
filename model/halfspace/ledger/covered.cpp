#include "halfspace/ledger/covered.hpp"

#include <algorithm>
#include <array>

namespace halfspace::ledger {

Covered covered(const SetupTriangle& triangle, int sub_pixel_bits) {
  const PixelRect& bounds = triangle.bounds;
  Covered found;
  for (int top = bounds.y_first & ~1; top <= bounds.y_last; top += 2) {
    std::int64_t last_quad = -1;  // of the two rows together, quads are counted from left to right
    std::array<std::array<std::int64_t, 3>, 2> e{};
    const int x_first = bounds.x_first;
    for (std::size_t row = 0; row < 2; ++row) {
      for (std::size_t i = 0; i < 3; ++i) {
        const Edge& edge = triangle.edge[i];
        e[row][i] =
            edge.c + ((std::int64_t{edge.a} * x_first + std::int64_t{edge.b} * (top + static_cast<int>(row)))
                      << sub_pixel_bits);
      }
    }
    for (int x = x_first; x <= bounds.x_last; ++x) {
      for (int row = 0; row < 2; ++row) {
        auto& at = e[static_cast<std::size_t>(row)];
        const int y = top + row;
        if ((at[0] | at[1] | at[2]) >= 0 && y >= bounds.y_first && y <= bounds.y_last) {
          ++found.samples;
          found.quads += last_quad != x / 2 ? 1 : 0;
          last_quad = x / 2;
        }
        for (std::size_t i = 0; i < 3; ++i) {
          at[i] += std::int64_t{triangle.edge[i].a} << sub_pixel_bits;
        }
      }
    }
  }
  return found;
}

}  // namespace halfspace::ledger
