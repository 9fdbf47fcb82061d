#include "halfspace/units/thin_line.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace halfspace {
namespace {

std::int64_t floor_quotient(std::int64_t value, std::int64_t by) {  // by > 0
  return value >= 0 ? value / by : -((by - 1 - value) / by);
}

std::int64_t ceil_quotient(std::int64_t value, std::int64_t by) { return -floor_quotient(-value, by); }

/// A line with its major axis as u, its minor as v: u = x where it is x-major.
struct Line {
  LineRule rule;
  bool x_major;
  int width;
  int bits;  ///< of sub-pixels
  std::int64_t ua;
  std::int64_t va;
  std::int64_t ub;
  std::int64_t vb;

  [[nodiscard]] std::int64_t half() const { return std::int64_t{1} << (bits - 1); }
  [[nodiscard]] std::int64_t du() const { return ub - ua; }
  [[nodiscard]] std::int64_t dv() const { return vb - va; }
  [[nodiscard]] std::int64_t length() const { return std::abs(du()); }
  [[nodiscard]] std::int64_t direction() const { return du() < 0 ? -1 : 1; }
  [[nodiscard]] std::int64_t centre(std::int64_t column) const { return (column << bits) + half(); }

  /// Half-way between two pixels the line takes the one of larger v.
  [[nodiscard]] bool ties_go_up() const {
    switch (rule) {
      case LineRule::kBresenham:  // moved by (-e, -e^2)
        return x_major && (dv() > 0) == (du() > 0) && dv() != 0;
      case LineRule::kMidpoint:  // stays at the start's
        return dv() < 0;
      case LineRule::kDda:
        return true;
      case LineRule::kDiamondExit:  // bottom and right corners are in
      case LineRule::kRectangular:
        break;
    }
    return false;
  }
};

/// E = value at the centre of pixel (0, 0) + (u_step u + v_step v) 2^bits.
struct Band {
  std::int64_t u_step;
  std::int64_t v_step;
  std::int64_t value;  ///< of the line: 0 on it, above 0 where v is less than the line's
  std::int64_t half;   ///< what the value changes by in half the width
};

/// E = length (v of the line - v), in sub-pixel units.
Band exact_band(const Line& line) {
  const std::int64_t u_step = line.dv() * line.direction();
  const std::int64_t v_step = -line.length();
  return {.u_step = u_step,
          .v_step = v_step,
          .value = u_step * (line.half() - line.ua) + v_step * (line.half() - line.va),
          .half = line.length() * line.width * line.half()};
}

/// v of column u is that of the start and |u - start| slopes, in 2^-kDdaFraction pixel.
Band dda_band(const Line& line) {
  const std::int64_t rise = (line.dv() >> line.bits) << kDdaFraction;
  const std::int64_t run = line.length() >> line.bits;
  const std::int64_t slope = floor_quotient(2 * rise + run, 2 * run);
  const std::int64_t u_step = slope * line.direction();
  const std::int64_t v_step = -(std::int64_t{1} << kDdaFraction);
  return {.u_step = u_step,
          .v_step = v_step,
          .value = u_step * (line.half() - line.ua) + v_step * (line.half() - line.va),
          .half = std::int64_t{line.width} << (kDdaFraction - 1 + line.bits)};
}

Band band_of(const Line& line) { return line.rule == LineRule::kDda ? dda_band(line) : exact_band(line); }

/// The least of the pixels that a column has where its middle is a point of the line at `v`; of a line of
/// width 1 the pixel that holds the point.
std::int64_t least_pixel(const Line& line, std::int64_t v) {
  const std::int64_t moved = v - (line.width - 1) * line.half();
  return (line.ties_go_up() ? moved : moved - 1) >> line.bits;
}

/// Whether the diamond of a pixel of the column holds a point of the line that Vulkan and Direct3D rasterize
/// for lines of this width: it is moved so that the least pixel of a column is that of a line of width 1.
bool diamond_holds(const Line& line, std::int64_t u, std::int64_t v, std::int64_t column) {
  const std::int64_t off_u = u - line.centre(column);
  const std::int64_t off_v = v - (line.width - 1) * line.half() - line.centre(least_pixel(line, v));
  const std::int64_t distance = std::abs(off_u) + std::abs(off_v);
  if (distance != line.half()) {
    return distance < line.half();
  }
  const std::int64_t x = line.x_major ? off_u : off_v;
  const std::int64_t y = line.x_major ? off_v : off_u;
  if (line.rule == LineRule::kBresenham) {
    return x > 0;  // the point is moved by (-e, -e^2)
  }
  return y > 0 || (!line.x_major && y == 0 && x > 0);
}

/// The columns of lines that leave diamonds. Along a line |u| + |v| from the centre of a pixel is least in
/// the column's middle, so a line meets the diamond of a pixel of its band if it passes the middle, or starts
/// behind it inside the diamond. It leaves it unless it ends inside. A point in a diamond behind the middle
/// is in that of the pixel that the column has: with a slope of at most 1 the line does not leave the pixel
/// in between.
void find_columns(const Line& line, ThinLine& out) {
  const std::int64_t size = std::int64_t{1} << line.bits;
  const bool moved = line.rule == LineRule::kBresenham;  // by less than anything along u
  const std::int64_t step = line.direction();
  std::int64_t start = 0;
  std::int64_t end = 0;
  if (step > 0) {
    start = ceil_quotient(line.ua - line.half(), size);
    end =
        moved ? ceil_quotient(line.ub - line.half(), size) - 1 : floor_quotient(line.ub - line.half(), size);
  } else {
    start =
        moved ? ceil_quotient(line.ua - line.half(), size) - 1 : floor_quotient(line.ua - line.half(), size);
    end = ceil_quotient(line.ub - line.half(), size);
  }
  const std::int64_t before = start - step;
  const bool has_before =
      diamond_holds(line, line.ua, line.va, before) && !diamond_holds(line, line.ub, line.vb, before);
  if ((end - start) * step >= 0 && diamond_holds(line, line.ub, line.vb, end)) {
    end -= step;
  }
  start = has_before ? before : start;
  out.first = static_cast<std::int32_t>(std::min(start, end));
  out.last = static_cast<std::int32_t>(std::max(start, end));
  if ((end - start) * step < 0) {
    out.last = out.first - 1;
  }
}

/// From the pixel of the start up to that of the end, which is left out.
void find_columns_of_pixels(const Line& line, ThinLine& out) {
  const std::int64_t start = line.ua >> line.bits;
  const std::int64_t end = line.ub >> line.bits;
  out.first = static_cast<std::int32_t>(std::min(start, end + 1));
  out.last = static_cast<std::int32_t>(std::max(start, end - 1));
  if (start == end) {
    out.last = out.first - 1;
  }
}

Edge edge_of(const Line& line, std::int64_t u_step, std::int64_t v_step, std::int64_t c) {
  return {.a = static_cast<std::int32_t>(line.x_major ? u_step : v_step),
          .b = static_cast<std::int32_t>(line.x_major ? v_step : u_step),
          .c = c};
}

bool joins_pixels(LineRule rule) { return rule == LineRule::kMidpoint || rule == LineRule::kDda; }

}  // namespace

ThinLine thin_line(const LinePoint& a, const LinePoint& b, LineRule rule, int width, int sub_pixel_bits) {
  Line line{.rule = rule,
            .x_major = true,
            .width = width,
            .bits = sub_pixel_bits,
            .ua = a.x,
            .va = a.y,
            .ub = b.x,
            .vb = b.y};
  if (joins_pixels(rule)) {
    for (std::int64_t* const coordinate : {&line.ua, &line.va, &line.ub, &line.vb}) {
      *coordinate = line.centre(*coordinate >> line.bits);
    }
  }
  line.x_major = std::abs(line.dv()) <= std::abs(line.du());
  if (!line.x_major) {
    std::swap(line.ua, line.va);
    std::swap(line.ub, line.vb);
  }
  ThinLine out{.x_major = line.x_major, .forward = line.du() > 0};
  if (line.du() == 0) {
    return out;
  }
  const Band band = band_of(line);
  const std::int64_t up = line.ties_go_up() ? 1 : 0;
  out.edge[0] = edge_of(line, band.u_step, band.v_step, band.half + band.value - (1 - up));
  out.edge[1] = edge_of(line, -band.u_step, -band.v_step, band.half - band.value - up);
  if (joins_pixels(rule)) {
    find_columns_of_pixels(line, out);
  } else {
    find_columns(line, out);
  }
  if (out.empty()) {
    return out;
  }
  // A column's pixels are between those of the ends, whose rounding is monotonous; DDA's slope too is that of
  // a line which does not go beyond its end.
  const auto [low, high] = std::minmax({line.va, line.vb});
  out.minor_first = static_cast<std::int32_t>(least_pixel(line, low));
  out.minor_last = static_cast<std::int32_t>(least_pixel(line, high) + width - 1);
  return out;
}

}  // namespace halfspace
