// The part of the front end that draws lines and points: docs/guides/lines.md.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>

#include "halfspace/scene/depth_plane_rows.hpp"
#include "halfspace/scene/front_end.hpp"
#include "halfspace/units/line_rectangle.hpp"
#include "halfspace/units/setup.hpp"

namespace halfspace {
namespace {

/// A number of sub-pixels, at least one.
std::int64_t to_grid(float pixels, double sub_pixels) {
  return std::max(std::lrint(pixels * sub_pixels), 1L);
}

std::int32_t first_not_below(std::int64_t value, int shift) {
  return static_cast<std::int32_t>((value + (std::int64_t{1} << shift) - 1) >> shift);
}

std::int32_t first_above(std::int64_t value, int shift) {
  return static_cast<std::int32_t>((value >> shift) + 1);
}

/// The pixels along an axis whose centres lie between the sides of a point, of which it owns the lower or the
/// upper one. `centre` and `size` in sub-pixels.
PixelRun pixels_of_point(std::int64_t centre, std::int64_t size, bool owns_upper, int sub_pixel_bits) {
  // centre of pixel p, in halves of a sub-pixel: p 2^(bits + 1) + 2^bits
  const std::int64_t low = 2 * centre - size - (std::int64_t{1} << sub_pixel_bits);
  const std::int64_t high = low + 2 * size;
  const int shift = sub_pixel_bits + 1;
  return owns_upper ? PixelRun{first_above(low, shift), first_above(high, shift) - 1}
                    : PixelRun{first_not_below(low, shift), first_not_below(high, shift) - 1};
}

ScreenVertex corner(const LinePoint& p, const LinePoint& side, int sign) {
  return {.x = p.x + sign * side.x, .y = p.y + sign * side.y};
}

void turn(std::array<ScreenVertex, 3>& v, bool positive_area) {
  if ((twice_signed_area(v) > 0) != positive_area) {
    std::swap(v[1], v[2]);
  }
}

/// The columns of the line (rows where it is y-major) inside a rectangle.
PixelRun columns_of(const ThinLine& line, const PixelRect& rect) {
  return {std::max(line.first, line.x_major ? rect.x_first : rect.y_first),
          std::min(line.last, line.x_major ? rect.x_last : rect.y_last)};
}

/// `within`, with these columns alone.
PixelRect columns_within(const ThinLine& line, const PixelRect& within, PixelRun columns) {
  PixelRect rect = within;
  (line.x_major ? rect.x_first : rect.y_first) = columns.first;
  (line.x_major ? rect.x_last : rect.y_last) = columns.last;
  return rect;
}

/// Whether the centre of the column lies before the start of the line, as it is drawn.
bool starts_before(const ThinLine& thin, const ScreenTriangle& line, std::int32_t column,
                   int sub_pixel_bits) {
  const std::int32_t centre = (column << sub_pixel_bits) + (1 << (sub_pixel_bits - 1));
  const std::int32_t start = thin.x_major ? line.v[0].x : line.v[0].y;
  return thin.forward ? centre < start : centre > start;
}

/// Calls draw(first, end) for each run of numbers from `first` up to `end` at which the stipple draws.
template <class Draw>
void for_each_dash(const LineStipple& stipple, std::uint64_t counter, std::int64_t first, std::int64_t end,
                   const Draw& draw) {
  if (stipple.draws_all()) {
    if (first < end) {
      draw(first, end);
    }
    return;
  }
  for (std::int64_t at = first; at < end;) {
    const bool is_drawn = stipple.draws(counter + static_cast<std::uint64_t>(at));
    std::int64_t after = at + 1;
    while (after < end && stipple.draws(counter + static_cast<std::uint64_t>(after)) == is_drawn) {
      ++after;
    }
    if (is_drawn) {
      draw(at, after);
    }
    at = after;
  }
}

}  // namespace

LinePoint FrontEnd::snap(const Window& v) const {
  return {static_cast<std::int32_t>(std::lrint(v.x * sub_pixels_)),
          static_cast<std::int32_t>(std::lrint(v.y * sub_pixels_))};
}

bool FrontEnd::clip_line(std::uint32_t index, Segment& segment, FrontEndCounters& counters) const {
  Clip a;
  Clip b;
  if (!read(2 * index, a, counters) || !read(2 * index + 1, b, counters)) {
    return false;
  }
  bool is_cut = false;
  for (std::size_t p = 0; p < plane_count_; ++p) {
    const double of_a = glm::dot(planes_[p], a);
    const double of_b = glm::dot(planes_[p], b);
    if (of_a < 0 && of_b < 0) {
      ++counters.clipped_away;
      return false;
    }
    if (of_a < 0 || of_b < 0) {
      (of_a < 0 ? a : b) = cut(a, of_a, b, of_b);
      is_cut = true;
    }
  }
  counters.clipped += is_cut ? 1 : 0;
  if (!(a.w > 0 && b.w > 0)) {
    ++counters.degenerate;
    return false;
  }
  segment = {.a = to_window(a), .b = to_window(b)};
  for (Window* const end : {&segment.a, &segment.b}) {
    end->x = std::clamp(end->x, -guard_band_, guard_band_);
    end->y = std::clamp(end->y, -guard_band_, guard_band_);
  }
  return true;
}

std::uint64_t FrontEnd::fragments_long(const Segment& segment) const {
  const LinePoint a = snap(segment.a);
  const LinePoint b = snap(segment.b);
  return static_cast<std::uint64_t>(
      is_thin(draw_.line_rule)
          ? thin_line(a, b, draw_.line_rule, thin_width(draw_.line_width), sub_pixel_bits_).length()
          : pixels_long(a, b, sub_pixel_bits_));
}

/// A line of a strip needs the lengths of those before it.
void FrontEnd::count_stipple() {
  if (draw_.primitive != Primitive::kLineStrip || draw_.stipple.draws_all()) {
    return;
  }
  const std::uint32_t* const indices = frame_.indices.data() + draw_.first_index;
  FrontEndCounters not_kept;
  std::uint64_t counter = 0;
  for (std::uint32_t i = 0; i < draw_.primitive_count(); ++i) {
    const bool goes_on = i != 0 && indices[2 * i] == indices[2 * i - 1];
    counter = goes_on ? counter : 0;
    stippled_.push_back(counter);
    Segment segment;
    if (clip_line(i, segment, not_kept)) {
      counter += fragments_long(segment);
    }
  }
}

void FrontEnd::process_line(std::uint32_t index, std::vector<ScreenTriangle>& out,
                            FrontEndCounters& counters) const {
  Segment segment;
  if (!clip_line(index, segment, counters)) {
    return;
  }
  Outline outline{.index = index, .stippled = stippled_.empty() ? 0 : stippled_[index]};
  emit_line(segment, outline, out, counters);
}

void FrontEnd::process_point(std::uint32_t index, std::vector<ScreenTriangle>& out,
                             FrontEndCounters& counters) const {
  Clip v;
  if (!read(index, v, counters)) {
    return;
  }
  const bool in_volume = std::abs(v.x) <= v.w && std::abs(v.y) <= v.w;
  const bool in_planes =
      std::all_of(planes_.begin(), planes_.begin() + static_cast<std::ptrdiff_t>(plane_count_),
                  [&](const Clip& plane) { return glm::dot(plane, v) >= 0; });
  if (!in_volume || !in_planes) {
    ++counters.clipped_away;
    return;
  }
  if (!(v.w > 0)) {
    ++counters.degenerate;
    return;
  }
  emit_point(to_window(v), {.index = index}, out, counters);
}

void FrontEnd::emit_outline(const Polygon<Window>& polygon, double offset_unit, std::uint32_t index,
                            std::vector<ScreenTriangle>& out, FrontEndCounters& counters) const {
  // The largest of the fan stands for all: it says which way the polygon faces, and how steep it is.
  ScreenTriangle face{.v = {}, .triangle = index};
  std::array<double, 3> z{};
  std::int64_t area = 0;
  for (std::size_t i = 1; i + 1 < polygon.size; ++i) {
    ScreenTriangle part = face;
    const std::array<const Window*, 3> corners{&polygon.v[0], &polygon.v[i], &polygon.v[i + 1]};
    for (std::size_t k = 0; k < 3; ++k) {
      part.v[k] = corner(snap(*corners[k]), {}, 1);
    }
    const std::int64_t area_of_part = twice_signed_area(part.v);
    if (i == 1 || std::abs(area_of_part) > std::abs(area)) {
      face = part;
      area = area_of_part;
      z = {corners[0]->z, corners[1]->z, corners[2]->z};
    }
  }
  const bool is_front = (area > 0) == draw_.has(Flag::kFrontPositiveArea);
  if (area == 0 || draw_.has(is_front ? Flag::kCullFront : Flag::kCullBack)) {
    out.push_back(face);  // setup drops and counts it
    ++counters.emitted;
    return;
  }
  Outline outline{.index = index,
                  .offset = polygon_offset_ ? offset_of(face, z, offset_unit) : 0,
                  .positive_area = area > 0};
  for (std::size_t i = 0; i < polygon.size; ++i) {
    if (draw_.polygon_mode == PolygonMode::kPoint) {
      emit_point(polygon.v[i], outline, out, counters);
    } else {
      emit_line({.a = polygon.v[i], .b = polygon.v[(i + 1) % polygon.size]}, outline, out, counters);
    }
  }
}

void FrontEnd::emit_line(const Segment& segment, Outline& outline, std::vector<ScreenTriangle>& out,
                         FrontEndCounters& counters) const {
  Segment line = segment;
  if (!depth_clamp_) {
    line.a.z = std::clamp(line.a.z, z_least_, z_most_);
    line.b.z = std::clamp(line.b.z, z_least_, z_most_);
  }
  if (is_thin(draw_.line_rule)) {
    emit_thin(line, outline, out, counters);
  } else {
    emit_rectangles(line, outline, out, counters);
  }
  if (!draw_.stipple.draws_all()) {
    outline.stippled += fragments_long(line);
  }
}

void FrontEnd::emit_rectangles(const Segment& segment, const Outline& outline,
                               std::vector<ScreenTriangle>& out, FrontEndCounters& counters) const {
  const LinePoint a = snap(segment.a);
  const LinePoint b = snap(segment.b);
  const std::array<double, 2> z{segment.a.z, segment.b.z};
  if (a == b) {
    return emit_rectangle({a, b}, z, {}, outline, out, counters);  // setup drops and counts it
  }
  const LinePoint side = rectangle_offset(a, b, to_grid(draw_.line_width, sub_pixels_));
  if (draw_.stipple.draws_all()) {
    return emit_rectangle({a, b}, z, side, outline, out, counters);
  }
  const double length = std::hypot(static_cast<double>(b.x - a.x), static_cast<double>(b.y - a.y));
  for_each_dash(draw_.stipple, outline.stippled, 0, pixels_long(a, b, sub_pixel_bits_),
                [&](std::int64_t first, std::int64_t end) {
                  std::array<LinePoint, 2> ends;
                  std::array<double, 2> depths{};
                  for (std::size_t i = 0; i < 2; ++i) {
                    const std::int64_t distance = (i == 0 ? first : end) << sub_pixel_bits_;
                    const double t = std::min(static_cast<double>(distance) / length, 1.0);
                    ends[i] = along_line(a, b, distance);
                    depths[i] = t == 1 ? z[1] : z[0] + t * (z[1] - z[0]);
                  }
                  emit_rectangle(ends, depths, side, outline, out, counters);
                });
}

void FrontEnd::emit_rectangle(const std::array<LinePoint, 2>& ends, const std::array<double, 2>& z,
                              const LinePoint& side, const Outline& outline, std::vector<ScreenTriangle>& out,
                              FrontEndCounters& counters) const {
  // Two triangles that share a diagonal. Turned about the middle each is the other, so both face alike.
  const ScreenVertex start = corner(ends[0], side, 1);
  const ScreenVertex end = corner(ends[1], side, -1);
  const auto emit_half = [&](const ScreenVertex& third, double third_z) {
    ScreenTriangle half{.v = {start, end, third}, .triangle = outline.index};
    std::array<double, 3> depths{z[0], z[1], third_z};
    if ((twice_signed_area(half.v) > 0) != outline.positive_area) {
      std::swap(half.v[1], half.v[2]);
      std::swap(depths[1], depths[2]);
    }
    emit_snapped(half, depths, outline.offset, out, counters);
  };
  emit_half(corner(ends[1], side, 1), z[1]);
  emit_half(corner(ends[0], side, -1), z[0]);
}

void FrontEnd::emit_thin(const Segment& segment, const Outline& outline, std::vector<ScreenTriangle>& out,
                         FrontEndCounters& counters) const {
  const LinePoint a = snap(segment.a);
  const LinePoint b = snap(segment.b);
  const ScreenTriangle whole{.v = {corner(a, {}, 1), corner(b, {}, 1), corner(a, {}, 1)},
                             .triangle = outline.index,
                             .shape = ScreenShape::kThinLine};
  const std::array<double, 2> z{segment.a.z, segment.b.z};
  if (draw_.stipple.draws_all()) {
    return emit_thin_part(whole, z, outline.offset, out, counters);
  }
  const ThinLine line = thin_line(a, b, draw_.line_rule, thin_width(draw_.line_width), sub_pixel_bits_);
  const PixelRun seen{std::max(line.first, 0),
                      std::min(line.last, line.x_major ? screen_.x_last : screen_.y_last)};
  const auto number = [&](std::int32_t column) {
    return line.forward ? column - line.first : line.last - column;
  };
  const std::int64_t first = seen.empty() ? 0 : std::min(number(seen.first), number(seen.last));
  const std::int64_t end =
      seen.empty() ? 0 : std::max(number(seen.first), number(seen.last)) + std::int64_t{1};
  for_each_dash(draw_.stipple, outline.stippled, first, end, [&](std::int64_t from, std::int64_t behind) {
    const auto column = [&](std::int64_t fragment) {
      return static_cast<std::int32_t>(line.forward ? line.first + fragment : line.last - fragment);
    };
    const auto [least, most] = std::minmax({column(from), column(behind - 1)});
    ScreenTriangle dash = whole;
    (line.x_major ? dash.within.x_first : dash.within.y_first) = least;
    (line.x_major ? dash.within.x_last : dash.within.y_last) = most;
    emit_thin_part(dash, z, outline.offset, out, counters);
  });
}

void FrontEnd::emit_thin_part(ScreenTriangle line, std::array<double, 2> z, double offset,
                              std::vector<ScreenTriangle>& out, FrontEndCounters& counters) const {
  if (format_ == DepthFormat::kNone) {
    out.push_back(line);
    ++counters.emitted;
    return;
  }
  const bool has_far = is_far(offset) || is_far(z[0]) || is_far(z[1]);
  const auto float_of = [](double depth) { return static_cast<double>(static_cast<float>(depth)); };
  const bool has_tiny = format_ == DepthFormat::kFloat32 && !has_far &&
                        may_be_tiny({float_of(z[0]), float_of(z[1]), float_of(z[0])}, limits_);
  line.offset = has_far ? 0 : vertex_depth_code(format_, offset);
  const ThinLine thin = thin_line({line.v[0].x, line.v[0].y}, {line.v[1].x, line.v[1].y}, draw_.line_rule,
                                  thin_width(draw_.line_width), sub_pixel_bits_);
  const auto give = [&](const PixelRect& within, const std::array<double, 2>& depths) {
    ScreenTriangle piece = line;
    piece.within = within;
    piece.v[0].z = piece.v[2].z = vertex_depth_code(format_, depths[0]);
    piece.v[1].z = vertex_depth_code(format_, depths[1]);
    out.push_back(piece);
    ++counters.emitted;
  };
  const auto give_column = [&](std::int32_t column) {
    const double start = thin.x_major ? line.v[0].x : line.v[0].y;
    const double end = thin.x_major ? line.v[1].x : line.v[1].y;
    const double way = std::clamp(((column + 0.5) * sub_pixels_ - start) / (end - start), 0.0, 1.0);
    const double depth = z[0] + way * (z[1] - z[0]);
    const double kept = has_far ? std::clamp(depth + offset, limits_.least, limits_.most) : depth;
    give(columns_within(thin, line.within, {column, column}), {kept, kept});
  };
  const PixelRun seen = columns_of(thin, intersect(line.within, screen_));
  if (has_far || has_tiny) {
    // The packet of a line cannot hold such depths everywhere: each column is a piece, as deep as the line
    // there.
    ++(has_far ? counters.far_depth : counters.tiny_depth);
    for (std::int32_t column = seen.first; column <= seen.last; ++column) {
      give_column(column);
    }
    return;
  }
  // The first fragment's centre may lie before the start, where depth would leave that of the ends.
  const std::int32_t first = thin.forward ? thin.first : thin.last;
  if (z[0] == z[1] || !starts_before(thin, line, first, sub_pixel_bits_) || seen.empty() ||
      first < seen.first || first > seen.last) {
    return give(line.within, z);
  }
  give_column(first);
  const PixelRun rest = thin.forward ? PixelRun{first + 1, seen.last} : PixelRun{seen.first, first - 1};
  if (!rest.empty()) {
    give(columns_within(thin, line.within, rest), z);
  }
}

void FrontEnd::emit_point(const Window& centre, const Outline& outline, std::vector<ScreenTriangle>& out,
                          FrontEndCounters& counters) const {
  const LinePoint at = snap(centre);
  const std::int64_t size = to_grid(draw_.point_size, sub_pixels_);
  const PixelRun columns = pixels_of_point(at.x, size, owns_right(rule_), sub_pixel_bits_);
  const PixelRun rows = pixels_of_point(at.y, size, owns_bottom(rule_), sub_pixel_bits_);
  const PixelRect square{
      .x_first = columns.first, .y_first = rows.first, .x_last = columns.last, .y_last = rows.last};
  const PixelRect seen = intersect(square, screen_);
  // The square's pixels are cut out of a triangle around them. Where there are none, one without a centre
  // stands for it, or one outside, which setup drops and counts.
  ScreenTriangle point{.v = {}, .triangle = outline.index, .within = seen};
  std::array<ScreenVertex, 3>& v = point.v;
  v = {ScreenVertex{.x = 0, .y = 0}, ScreenVertex{.x = 1, .y = 0}, ScreenVertex{.x = 0, .y = 1}};
  if (!square.empty()) {
    const PixelRect around = seen.empty() ? PixelRect{.x_last = 0, .y_last = 0} : seen;
    const std::int32_t left = around.x_first << sub_pixel_bits_;
    const std::int32_t top = around.y_first << sub_pixel_bits_;
    v[0] = {.x = left, .y = top};
    v[1] = {.x = left + ((around.x_last - around.x_first + 1) << (sub_pixel_bits_ + 1)), .y = top};
    v[2] = {.x = left, .y = top + ((around.y_last - around.y_first + 1) << (sub_pixel_bits_ + 1))};
  }
  turn(v, outline.positive_area);
  double z = depth_clamp_ ? centre.z : std::clamp(centre.z, z_least_, z_most_);
  double offset = outline.offset;
  if (is_far(z) || is_far(offset)) {
    z = std::clamp(z + offset, limits_.least, limits_.most);
    offset = 0;
  }
  emit_snapped(point, {z, z, z}, offset, out, counters);
}

}  // namespace halfspace
