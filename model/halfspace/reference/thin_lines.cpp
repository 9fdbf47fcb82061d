#include "halfspace/reference/thin_lines.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>

#include "halfspace/numerics/error.hpp"
#include "halfspace/numerics/line_rule.hpp"
#include "halfspace/reference/clipped_triangle.hpp"
#include "halfspace/reference/exact_line.hpp"
#include "halfspace/reference/window.hpp"

namespace halfspace::reference {
namespace {

constexpr std::int64_t kMostForDiamonds = std::int64_t{1} << 18;  ///< sub-pixels; see exact_line.hpp
constexpr double kWindowLimit = 32734;  ///< the guard band of lines, whose width needs room

double evaluate(const Homogeneous& plane, const Homogeneous& v) {
  return plane.x * v.x + plane.y * v.y + plane.z * v.z + plane.w * v.w;
}

std::vector<Homogeneous> planes_of(const DrawState& draw) {
  Options options = draw.options;
  options.window_limit = std::min(options.window_limit, kWindowLimit);
  return guard_band({draw.command, options, draw.storage, draw.window, draw.rule});
}

/// Nothing where nothing is left inside the planes.
std::optional<std::array<Corner, 2>> clip_segment(std::array<Corner, 2> ends,
                                                  const std::vector<Homogeneous>& planes) {
  for (const Homogeneous& plane : planes) {
    const std::array<double, 2> distance{evaluate(plane, ends[0]), evaluate(plane, ends[1])};
    if (distance[0] < 0 && distance[1] < 0) {
      return std::nullopt;
    }
    if (distance[0] >= 0 && distance[1] >= 0) {
      continue;
    }
    const std::size_t out = distance[0] < 0 ? 0 : 1;
    const Corner& in = ends[1 - out];
    const double t = distance[1 - out] / (distance[1 - out] - distance[out]);
    Corner cut = in;
    cut.x += t * (ends[out].x - in.x);
    cut.y += t * (ends[out].y - in.y);
    cut.z += t * (ends[out].z - in.z);
    cut.w += t * (ends[out].w - in.w);
    ends[out] = cut;
  }
  return ends;
}

/// A line on the sub-pixel grid.
struct Snapped {
  GridPoint a;
  GridPoint b;
  int bits;

  [[nodiscard]] bool is_x_major() const { return std::abs(b.y - a.y) <= std::abs(b.x - a.x); }
};

/// The pixels of width 1 in the order in which they are drawn, moved as a wide line is: of each the first of
/// its column.
std::vector<PixelPlace> by_diamonds(const Snapped& line, LineRule rule, int width) {
  const bool x_major = line.is_x_major();
  const std::int64_t aside = (std::int64_t{width} - 1) << line.bits >> 1;
  const GridLine moved{line.a.x - (x_major ? 0 : aside), line.a.y - (x_major ? aside : 0),
                       line.b.x - (x_major ? 0 : aside), line.b.y - (x_major ? aside : 0)};
  const auto [least, most] = std::minmax({moved.ax, moved.ay, moved.bx, moved.by});
  if (rule == LineRule::kBresenham && (least < -kMostForDiamonds || most > kMostForDiamonds)) {
    throw InputError("a line reaches " + std::to_string(std::max(-least, most) >> line.bits) +
                     " pixels; legal for a reference by the rule bresenham: " +
                     std::to_string(kMostForDiamonds >> line.bits));
  }
  const auto from = static_cast<double>(x_major ? moved.ax : moved.ay);
  const auto to = static_cast<double>(x_major ? moved.bx : moved.by);
  const auto minor = static_cast<double>(x_major ? moved.ay : moved.ax);
  const auto rise = static_cast<double>(x_major ? moved.by - moved.ay : moved.bx - moved.ax);
  const double one = std::ldexp(1.0, line.bits);
  const std::int64_t first = static_cast<std::int64_t>(std::floor(std::min(from, to) / one)) - 1;
  const std::int64_t last = static_cast<std::int64_t>(std::floor(std::max(from, to) / one)) + 1;
  std::vector<PixelPlace> pixels;
  for (std::int64_t column = first; column <= last; ++column) {
    const double middle = (static_cast<double>(column) + 0.5) * one;
    const double way = from == to ? 0 : std::clamp((middle - from) / (to - from), 0.0, 1.0);
    const auto near = static_cast<std::int64_t>(std::floor((minor + way * rise) / one));
    for (std::int64_t v = near - 2; v <= near + 2; ++v) {  // a diamond beyond them is not met
      const PixelPlace pixel = x_major ? PixelPlace{column, v} : PixelPlace{v, column};
      if (rule == LineRule::kBresenham ? leaves_vulkan_diamond(moved, pixel, line.bits)
                                       : leaves_direct3d_diamond(moved, pixel, line.bits)) {
        pixels.push_back(pixel);
      }
    }
  }
  if (from > to) {
    std::reverse(pixels.begin(), pixels.end());
  }
  return pixels;
}

/// The same of the loops; a move by half a pixel is no business of theirs.
std::vector<PixelPlace> by_loop(const Snapped& line, LineRule rule, int width, bool& x_major) {
  if (width % 2 == 0) {
    throw InputError("a line by the rule " + std::string(kLineRuleName[static_cast<std::size_t>(rule)]) +
                     " is " + std::to_string(width) + " pixels wide; legal for a reference: odd widths");
  }
  const PixelPlace from{line.a.x >> line.bits, line.a.y >> line.bits};
  const PixelPlace to{line.b.x >> line.bits, line.b.y >> line.bits};
  x_major = std::abs(to.y - from.y) <= std::abs(to.x - from.x);
  std::vector<PixelPlace> pixels =
      rule == LineRule::kMidpoint ? midpoint_line(from, to) : dda_line(from, to, kDdaFraction);
  for (PixelPlace& pixel : pixels) {
    (x_major ? pixel.y : pixel.x) -= (width - 1) / 2;
  }
  return pixels;
}

bool holds(const PixelRect& rect, const PixelPlace& p) {
  return p.x >= rect.first_x && p.x < rect.end_x && p.y >= rect.first_y && p.y < rect.end_y;
}

}  // namespace

std::vector<Fragment> ThinLines::draw_segment(const Corner& a, const Corner& b, double offset) {
  const Command& command = draw_.command;
  const int bits = draw_.options.subpixel_bits;
  const WindowVertex from = to_window(a, command);
  const WindowVertex to = to_window(b, command);
  const Snapped line{snap(from, bits), snap(to, bits), bits};
  const int width = thin_width(command.line_width);
  bool x_major = line.is_x_major();
  const bool is_loop = command.line_rule == LineRule::kMidpoint || command.line_rule == LineRule::kDda;
  const std::vector<PixelPlace> pixels = is_loop ? by_loop(line, command.line_rule, width, x_major)
                                                 : by_diamonds(line, command.line_rule, width);
  const double start = std::ldexp(static_cast<double>(x_major ? line.a.x : line.a.y), -bits);
  const double end = std::ldexp(static_cast<double>(x_major ? line.b.x : line.b.y), -bits);
  std::vector<Fragment> fragments;
  for (const PixelPlace& pixel : pixels) {
    if (!command.stipple.draws(stippled_++)) {
      continue;
    }
    const double middle = static_cast<double>(x_major ? pixel.x : pixel.y) + 0.5;
    const double way = std::clamp((middle - start) / (end - start), 0.0, 1.0);
    const double depth = offset_and_clamped(from.z + way * (to.z - from.z), offset, command);
    for (int k = 0; k < width; ++k) {
      const PixelPlace p{pixel.x + (x_major ? 0 : k), pixel.y + (x_major ? k : 0)};
      if (holds(draw_.window, p)) {
        fragments.push_back({p.x, p.y, depth, {}});
      }
    }
  }
  return fragments;
}

DrawnTriangle ThinLines::line(const std::array<Corner, 2>& ends, bool goes_on) {
  stippled_ = goes_on ? stippled_ : 0;
  DrawnTriangle drawn;
  const auto seen = clip_segment(ends, planes_of(draw_));
  if (!seen || !((*seen)[0].w > 0 && (*seen)[1].w > 0)) {
    return drawn;
  }
  const int bits = draw_.options.subpixel_bits;
  const GridPoint a = snap(to_window((*seen)[0], draw_.command), bits);
  const GridPoint b = snap(to_window((*seen)[1], draw_.command), bits);
  if (a.x == b.x && a.y == b.y) {
    drawn.fate = Fate::kDegenerate;
    return drawn;
  }
  drawn.fate = Fate::kDrawn;
  drawn.pieces.push_back(draw_segment((*seen)[0], (*seen)[1], 0));
  return drawn;
}

DrawnTriangle ThinLines::outline(const ClipTriangle& triangle) {
  stippled_ = 0;
  DrawnTriangle drawn;
  const Polygon polygon = clip(Polygon(triangle.begin(), triangle.end()), planes_of(draw_));
  const bool divisible = std::all_of(polygon.begin(), polygon.end(), [](const Corner& v) { return v.w > 0; });
  if (polygon.size() < 3 || !divisible) {
    return drawn;
  }
  // The largest part of the fan says which way the polygon faces, and how steep it is.
  const int bits = draw_.options.subpixel_bits;
  Int128 area = 0;
  WindowTriangle largest{};
  double largest_depth = 0;
  for (const Corner& v : polygon) {
    largest_depth = std::max(largest_depth, std::abs(to_window(v, draw_.command).z));
  }
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const WindowTriangle part{to_window(polygon[0], draw_.command), to_window(polygon[i], draw_.command),
                              to_window(polygon[i + 1], draw_.command)};
    const Int128 of_part = twice_area(snap(part[0], bits), snap(part[1], bits), snap(part[2], bits));
    if ((of_part < 0 ? -of_part : of_part) > (area < 0 ? -area : area)) {
      area = of_part;
      largest = part;
    }
  }
  if (area == 0) {
    drawn.fate = Fate::kDegenerate;
    return drawn;
  }
  const bool front = (area > 0) == draw_.command.has(Flag::kFrontPositiveArea);
  if (draw_.command.has(front ? Flag::kCullFront : Flag::kCullBack)) {
    drawn.fate = Fate::kCulled;
    return drawn;
  }
  const double offset =
      polygon_offset(depth_plane(on_grid(largest, bits)), largest_depth, draw_.command, draw_.storage);
  drawn.fate = Fate::kDrawn;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    drawn.pieces.push_back(draw_segment(polygon[i], polygon[(i + 1) % polygon.size()], offset));
  }
  return drawn;
}

}  // namespace halfspace::reference
