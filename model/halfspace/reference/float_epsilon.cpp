#include "halfspace/reference/float_epsilon.hpp"

#include <cmath>

namespace halfspace::reference {
namespace {

struct FloatEdge {
  float a;
  float b;
  float c;

  FloatEdge(const GridPoint& from, const GridPoint& to, int subpixel_bits) {
    const auto pixels = [&](std::int64_t n) { return std::ldexp(static_cast<float>(n), -subpixel_bits); };
    a = pixels(from.y) - pixels(to.y);
    b = pixels(to.x) - pixels(from.x);
    c = -(a * pixels(from.x) + b * pixels(from.y));
  }

  [[nodiscard]] bool has_inside(float x, float y, TieRule rule) const {
    const float e = a * x + b * y + c;
    return std::abs(e) <= kEdgeEpsilon ? owns_samples(a, b, rule) : e > 0;
  }
};

}  // namespace

void cover_with_epsilon(const Piece& piece, std::vector<Fragment>& fragments) {
  const GridTriangle t = clockwise(piece.grid);
  const std::array<FloatEdge, 3> edges = {FloatEdge(t[0], t[1], piece.subpixel_bits),
                                          FloatEdge(t[1], t[2], piece.subpixel_bits),
                                          FloatEdge(t[2], t[0], piece.subpixel_bits)};
  const PixelRect& box = piece.bounds;
  for (std::int64_t y = box.first_y; y < box.end_y; ++y) {
    for (std::int64_t x = box.first_x; x < box.end_x; ++x) {
      const float centre_x = static_cast<float>(x) + 0.5F;
      const float centre_y = static_cast<float>(y) + 0.5F;
      if (edges[0].has_inside(centre_x, centre_y, piece.rule) &&
          edges[1].has_inside(centre_x, centre_y, piece.rule) &&
          edges[2].has_inside(centre_x, centre_y, piece.rule)) {
        fragments.push_back(piece.fragment(x, y));
      }
    }
  }
}

}  // namespace halfspace::reference
