#include "halfspace/reference/incremental.hpp"

namespace halfspace::reference {
namespace {

/// E = A (x - x_i) + B (y - y_i) of the edge from vertex i to vertex j, at one sample.
struct EdgeStepper {
  std::int64_t value;
  std::int64_t right;  ///< what a pixel to the right adds
  std::int64_t down;

  EdgeStepper(const GridPoint& i, const GridPoint& j, const GridPoint& first, const Piece& piece) {
    const std::int64_t a = i.y - j.y;
    const std::int64_t b = j.x - i.x;
    const std::int64_t pixel = std::int64_t{1} << piece.subpixel_bits;
    value = a * (first.x - i.x) + b * (first.y - i.y) - (owns_samples(a, b, piece.rule) ? 0 : 1);
    right = a * pixel;
    down = b * pixel;
  }
};

}  // namespace

void cover_by_increments(const Piece& piece, std::vector<Fragment>& fragments) {
  const GridTriangle t = clockwise(piece.grid);
  const PixelRect& box = piece.bounds;
  const GridPoint first = piece.centre(box.first_x, box.first_y);
  std::array<EdgeStepper, 3> row = {EdgeStepper(t[0], t[1], first, piece),
                                    EdgeStepper(t[1], t[2], first, piece),
                                    EdgeStepper(t[2], t[0], first, piece)};
  for (std::int64_t y = box.first_y; y < box.end_y; ++y) {
    std::array<EdgeStepper, 3> at = row;
    for (std::int64_t x = box.first_x; x < box.end_x; ++x) {
      if (at[0].value >= 0 && at[1].value >= 0 && at[2].value >= 0) {
        fragments.push_back(piece.fragment(x, y));
      }
      for (EdgeStepper& edge : at) edge.value += edge.right;
    }
    for (EdgeStepper& edge : row) edge.value += edge.down;
  }
}

}  // namespace halfspace::reference
