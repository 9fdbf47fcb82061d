/// Triangles for tests: random ones of every kind, and the bridge to the reference.
#pragma once

#include <algorithm>
#include "property/random.hpp"

#include "halfspace/reference/exact_triangle.hpp"
#include "halfspace/units/packets.hpp"
#include "halfspace/units/setup.hpp"

namespace halfspace::testing {

inline reference::GridTriangle grid(const ScreenTriangle& t) {
  reference::GridTriangle g;
  for (std::size_t i = 0; i < 3; ++i) {
    g[i] = {t.v[i].x, t.v[i].y};
  }
  return g;
}

/// A state that culls nothing, on a target of `size` pixels square.
inline SetupState open_state(int size, int sub_pixel_bits = 8) {
  return {.sub_pixel_bits = sub_pixel_bits,
          .front_positive_area = true,
          .cull_front = false,
          .cull_back = false,
          .fill_rule = FillRule::kTopLeft,
          .bounds = {.x_first = 0, .y_first = 0, .x_last = size - 1, .y_last = size - 1},
          .depth_format = DepthFormat::kUnorm24,
          .interpolator = DepthInterpolator::kPlane};
}

/// Draws triangles of mixed kinds: any three points, small ones, slivers, vertices on pixel centres, far
/// outside.
class TriangleSource {
 public:
  TriangleSource(std::uint64_t seed, int size, int sub_pixel_bits)
      : random_(seed), size_(size), bits_(sub_pixel_bits) {}

  ScreenTriangle next(std::uint32_t z_limit = 0x7FFFFF80u) {
    ScreenTriangle t;
    const int kind = integer(0, 4);
    const int extent = size_ << bits_;
    const ScreenVertex centre{integer(0, extent), integer(0, extent), 0};
    for (std::size_t i = 0; i < 3; ++i) {
      ScreenVertex& v = t.v[i];
      switch (kind) {
        case 0:  // anywhere on the target and a little beyond
          v = {integer(-extent / 4, extent * 5 / 4), integer(-extent / 4, extent * 5 / 4), 0};
          break;
        case 1:  // about a pixel
          v = {centre.x + integer(-1 << bits_, 1 << bits_), centre.y + integer(-1 << bits_, 1 << bits_), 0};
          break;
        case 2:  // a sliver: the third vertex lies next to the line through the others
          v = i < 2 ? ScreenVertex{integer(0, extent), integer(0, extent), 0}
                    : ScreenVertex{(t.v[0].x + t.v[1].x) / 2 + integer(-3, 3),
                                   (t.v[0].y + t.v[1].y) / 2 + integer(-3, 3), 0};
          break;
        case 3:  // on pixel centres, so that edges run through samples
          v = {(integer(0, size_ - 1) << bits_) + (1 << (bits_ - 1)),
               (integer(0, size_ - 1) << bits_) + (1 << (bits_ - 1)), 0};
          break;
        default: {  // reaches to the guard band
          const int far = 32767 << bits_;
          v = {integer(-far, far), integer(-far, far), 0};
        }
      }
      v.z = static_cast<std::uint32_t>(integer(0, static_cast<int>(z_limit)));
    }
    return t;
  }

  int integer(int least, int most) { return static_cast<int>(random_.between(least, most)); }

 private:
  Random random_;
  int size_;
  int bits_;
};

}  // namespace halfspace::testing
