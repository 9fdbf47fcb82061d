#include "halfspace/reference/scanline.hpp"

#include <algorithm>

namespace halfspace::reference {
namespace {

/// The quotient rounded down; the divisor is positive.
std::int64_t floor_of(std::int64_t dividend, std::int64_t divisor) {
  return dividend / divisor - (dividend % divisor < 0 ? 1 : 0);
}

/// The first pixel whose centre is at `position` or beyond, or, with an open end, beyond.
std::int64_t first_centre(std::int64_t position, bool closed, int subpixel_bits) {
  const std::int64_t pixel = std::int64_t{1} << subpixel_bits;
  const std::int64_t from_centre = position - pixel / 2;
  return closed ? -floor_of(-from_centre, pixel) : floor_of(from_centre, pixel) + 1;
}

/// Where an edge crosses the row of centres on which it stands, in pixels from the first centre of the row: a
/// whole number and rest / divisor.
class ActiveEdge {
 public:
  /// On the row of centres `y`, a position on the grid. `top` is above `bottom`.
  ActiveEdge(const GridPoint& top, const GridPoint& bottom, std::int64_t y, int subpixel_bits) {
    const std::int64_t pixel = std::int64_t{1} << subpixel_bits;
    const std::int64_t dx = bottom.x - top.x;
    const std::int64_t dy = bottom.y - top.y;
    const std::int64_t crossing = (top.x - pixel / 2) * dy + (y - top.y) * dx;
    divisor_ = dy * pixel;
    whole_ = floor_of(crossing, divisor_);
    rest_ = crossing - whole_ * divisor_;
    whole_step_ = floor_of(dx, dy);
    rest_step_ = (dx - whole_step_ * dy) * pixel;
  }

  void step_down() {
    whole_ += whole_step_;
    rest_ += rest_step_;
    if (rest_ >= divisor_) {
      ++whole_;
      rest_ -= divisor_;
    }
  }

  /// The first pixel whose centre is on the edge or to its right, or, with an open end, to its right.
  [[nodiscard]] std::int64_t first_pixel(bool closed) const {
    return closed && rest_ == 0 ? whole_ : whole_ + 1;
  }

 private:
  std::int64_t divisor_;
  std::int64_t whole_;
  std::int64_t rest_;
  std::int64_t whole_step_;
  std::int64_t rest_step_;
};

}  // namespace

void cover_by_scanlines(const Piece& piece, std::vector<Fragment>& fragments) {
  GridTriangle v = piece.grid;
  std::sort(v.begin(), v.end(), [](const GridPoint& a, const GridPoint& b) { return a.y < b.y; });
  const bool middle_is_right = twice_area(v[0], v[1], v[2]) > 0;
  const bool left_closed = owns_left(piece.rule);
  const auto row_at = [&](const GridPoint& p) {
    return std::clamp(first_centre(p.y, owns_top(piece.rule), piece.subpixel_bits), piece.bounds.first_y,
                      std::max(piece.bounds.first_y, piece.bounds.end_y));
  };
  if (row_at(v[0]) == row_at(v[2])) return;
  ActiveEdge far_side(v[0], v[2], piece.centre(0, row_at(v[0])).y, piece.subpixel_bits);
  for (std::size_t half = 0; half < 2; ++half) {
    const GridPoint top = v[half];
    const GridPoint bottom = v[half + 1];
    if (row_at(top) == row_at(bottom)) continue;
    ActiveEdge near_side(top, bottom, piece.centre(0, row_at(top)).y, piece.subpixel_bits);
    const ActiveEdge& left = middle_is_right ? far_side : near_side;
    const ActiveEdge& right = middle_is_right ? near_side : far_side;
    for (std::int64_t y = row_at(top); y < row_at(bottom); ++y) {
      const std::int64_t end = std::min(right.first_pixel(left_closed), piece.bounds.end_x);
      for (std::int64_t x = std::max(left.first_pixel(left_closed), piece.bounds.first_x); x < end; ++x) {
        fragments.push_back(piece.fragment(x, y));
      }
      near_side.step_down();
      far_side.step_down();
    }
  }
}

}  // namespace halfspace::reference
