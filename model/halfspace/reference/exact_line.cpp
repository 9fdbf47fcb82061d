#include "halfspace/reference/exact_line.hpp"

#include <array>
#include <cmath>
#include <cstdlib>

namespace halfspace::reference {
namespace {

__extension__ using Wide = __int128;

constexpr Wide magnitude(Wide value) { return value < 0 ? -value : value; }

/// A segment relative to the centre of a pixel, on a finer grid.
struct Segment {
  Wide ax;
  Wide ay;
  Wide bx;
  Wide by;
};

/// A point of it, numerator / denominator of the way from a to b; coordinates times the denominator, above 0.
struct OnSegment {
  Wide x;
  Wide y;
  Wide denominator;
  [[nodiscard]] Wide distance() const { return magnitude(x) + magnitude(y); }
};

OnSegment at(const Segment& s, Wide numerator, Wide denominator) {
  return {.x = s.ax * denominator + (s.bx - s.ax) * numerator,
          .y = s.ay * denominator + (s.by - s.ay) * numerator,
          .denominator = denominator};
}

/// Where |x| + |y| along the segment may be least: it is convex, and straight between the ends and the axes.
struct Candidates {
  std::array<OnSegment, 4> point;
  std::array<std::array<Wide, 2>, 4> way;  ///< numerator and denominator
  std::size_t count = 0;

  explicit Candidates(const Segment& s) {
    add(s, 0, 1);
    add(s, 1, 1);
    add_crossing(s, s.ax, s.bx);
    add_crossing(s, s.ay, s.by);
  }

  void add(const Segment& s, Wide numerator, Wide denominator) {
    point[count] = at(s, numerator, denominator);
    way[count] = {numerator, denominator};
    ++count;
  }

  void add_crossing(const Segment& s, Wide from, Wide to) {
    if ((from < 0 && to > 0) || (from > 0 && to < 0)) {
      add(s, magnitude(from), magnitude(from) + magnitude(to));
    }
  }
};

/// Whether a point less than `half` away, in |x| + |y|, is on the segment.
bool meets_open(const Candidates& candidates, Wide half) {
  for (std::size_t i = 0; i < candidates.count; ++i) {
    const OnSegment& p = candidates.point[i];
    if (p.distance() < half * p.denominator) {
      return true;
    }
  }
  return false;
}

/// Whether Direct3D's diamond has a point of its border.
bool has_border_point(const OnSegment& p, bool x_major) {
  const bool is_right_corner = p.x > 0 && p.y == 0;
  return p.y > 0 || (!x_major && is_right_corner);
}

bool direct3d_holds(const OnSegment& p, Wide half, bool x_major) {
  const Wide border = half * p.denominator;
  return p.distance() < border || (p.distance() == border && has_border_point(p, x_major));
}

}  // namespace

bool leaves_vulkan_diamond(const GridLine& line, const PixelPlace& pixel, int subpixel_bits) {
  // Lines are 2^19 sub-pixels long at most, so from a centre they are 1 / 2^19 away at least, if at all, and
  // no slope is less but 0. e is 2^-20 of a sub-pixel: it moves a line by less, and by e^2 less than by e
  // slope.
  constexpr int kBits = 40;
  const Wide one = Wide{1} << kBits;
  const Wide move_x = Wide{1} << (kBits - 20);
  const Wide move_y = 1;
  const Wide half = one << (subpixel_bits - 1);
  const Wide x = (Wide{pixel.x} << (subpixel_bits + kBits)) + half;
  const Wide y = (Wide{pixel.y} << (subpixel_bits + kBits)) + half;
  const Segment s{.ax = line.ax * one - move_x - x,
                  .ay = line.ay * one - move_y - y,
                  .bx = line.bx * one - move_x - x,
                  .by = line.by * one - move_y - y};
  return meets_open(Candidates(s), half) && magnitude(s.bx) + magnitude(s.by) >= half;
}

bool leaves_direct3d_diamond(const GridLine& line, const PixelPlace& pixel, int subpixel_bits) {
  const Wide half = Wide{1} << (subpixel_bits - 1);
  const Wide x = (Wide{pixel.x} << subpixel_bits) + half;
  const Wide y = (Wide{pixel.y} << subpixel_bits) + half;
  const Segment s{.ax = line.ax - x, .ay = line.ay - y, .bx = line.bx - x, .by = line.by - y};
  const bool x_major = magnitude(s.by - s.ay) <= magnitude(s.bx - s.ax);
  if (direct3d_holds(at(s, 1, 1), half, x_major)) {
    return false;
  }
  const Candidates candidates(s);
  if (meets_open(candidates, half)) {
    return true;
  }
  // At most the border is met: in one point, or along an edge. The ends of that piece, and its middle, tell.
  std::vector<std::array<Wide, 2>> ways;
  for (std::size_t i = 0; i < candidates.count; ++i) {
    const OnSegment& p = candidates.point[i];
    if (p.distance() != half * p.denominator) {
      continue;
    }
    for (const std::array<Wide, 2>& other : ways) {
      const auto& way = candidates.way[i];
      const Wide sum = way[0] * other[1] + other[0] * way[1];
      if (direct3d_holds(at(s, sum, 2 * way[1] * other[1]), half, x_major)) {
        return true;
      }
    }
    ways.push_back(candidates.way[i]);
    if (direct3d_holds(p, half, x_major)) {
      return true;
    }
  }
  return false;
}

std::vector<PixelPlace> midpoint_line(const PixelPlace& a, const PixelPlace& b) {
  const std::int64_t dx = std::abs(b.x - a.x);
  const std::int64_t dy = std::abs(b.y - a.y);
  const std::int64_t step_x = b.x < a.x ? -1 : 1;
  const std::int64_t step_y = b.y < a.y ? -1 : 1;
  std::vector<PixelPlace> pixels;
  PixelPlace at = a;
  const bool steep = dy > dx;
  const std::int64_t run = steep ? dy : dx;
  const std::int64_t rise = steep ? dx : dy;
  std::int64_t decision = 2 * rise - run;
  for (std::int64_t i = 0; i < run; ++i) {
    pixels.push_back(at);
    if (decision > 0) {
      (steep ? at.x : at.y) += steep ? step_x : step_y;
      decision -= 2 * run;
    }
    (steep ? at.y : at.x) += steep ? step_y : step_x;
    decision += 2 * rise;
  }
  return pixels;
}

std::vector<PixelPlace> dda_line(const PixelPlace& a, const PixelPlace& b, int fraction_bits) {
  const std::int64_t dx = b.x - a.x;
  const std::int64_t dy = b.y - a.y;
  const bool steep = std::abs(dy) > std::abs(dx);
  const std::int64_t run = std::abs(steep ? dy : dx);
  const double one = std::ldexp(1.0, fraction_bits);
  std::vector<PixelPlace> pixels;
  if (run == 0) {
    return pixels;
  }
  // A quotient of integers below 2^32 by one below 2^16 is rounded once, and no half lies as near to another.
  const double slope =
      std::floor(static_cast<double>(steep ? dx : dy) * one / static_cast<double>(run) + 0.5);
  double minor = static_cast<double>(steep ? a.x : a.y) * one;
  std::int64_t major = steep ? a.y : a.x;
  const std::int64_t step = (steep ? dy : dx) < 0 ? -1 : 1;
  for (std::int64_t i = 0; i < run; ++i) {
    const auto pixel = static_cast<std::int64_t>(std::floor(minor / one + 0.5));
    pixels.push_back(steep ? PixelPlace{pixel, major} : PixelPlace{major, pixel});
    minor += slope;
    major += step;
  }
  return pixels;
}

}  // namespace halfspace::reference
