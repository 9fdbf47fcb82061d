#include "halfspace/reference/rasterizer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "halfspace/numerics/error.hpp"
#include "halfspace/reference/clip.hpp"
#include "halfspace/reference/depth_code.hpp"
#include "halfspace/reference/exact_triangle.hpp"
#include "halfspace/reference/window.hpp"

namespace halfspace::reference {
namespace {

/// Pixels first_x <= x < end_x, first_y <= y < end_y.
struct PixelRect {
  std::int64_t first_x = 0;
  std::int64_t first_y = 0;
  std::int64_t end_x = 0;
  std::int64_t end_y = 0;

  [[nodiscard]] bool contains(std::int64_t x, std::int64_t y) const {
    return x >= first_x && x < end_x && y >= first_y && y < end_y;
  }
};

PixelRect intersect(const PixelRect& a, const PixelRect& b) {
  return {std::max(a.first_x, b.first_x), std::max(a.first_y, b.first_y), std::min(a.end_x, b.end_x),
          std::min(a.end_y, b.end_y)};
}

PixelRect to_rect(const Scissor& s) {
  return {s.x, s.y, std::int64_t{s.x} + s.width, std::int64_t{s.y} + s.height};
}

/// The pixels of a line of `size` whose centres are between two ends; of a centre on an end, `low_is_in` says
/// whether the low end holds it, and then the high one does not.
std::pair<std::int64_t, std::int64_t> centres_between(double a, double b, std::int64_t size, bool low_is_in) {
  const double low = std::min(a, b);
  const double high = std::max(a, b);
  const auto is_in = [&](std::int64_t i) {
    const double centre = static_cast<double>(i) + 0.5;
    return low_is_in ? low <= centre && centre < high : low < centre && centre <= high;
  };
  std::int64_t first = 0;
  while (first < size && !is_in(first)) ++first;
  std::int64_t end = first;
  while (end < size && is_in(end)) ++end;
  return {first, end};
}

PixelRect viewport_rect(const Command& draw, const Target& target) {
  const glm::dvec4 v(draw.viewport);
  const auto [first_x, end_x] = centres_between(v.x, v.x + v.z, target.width, true);
  const auto [first_y, end_y] =
      centres_between(v.y, v.y + v.w, target.height, !draw.has(Flag::kBottomLeftRule));
  return {first_x, first_y, end_x, end_y};
}

/// Everything about a draw that its triangles share.
struct DrawContext {
  const Command& draw;
  const Options& options;
  Storage storage;
  PixelRect window;  ///< scissor, viewport and target
  bool tests;
  bool writes;
  Surface& surface;
};

void count_up(std::uint16_t& value) {
  if (value != std::numeric_limits<std::uint16_t>::max()) ++value;
}

bool is_late_z(const Command& draw) {
  if (draw.has(Flag::kEarlyTestsForced)) return false;
  return draw.has(Flag::kShaderDiscards) || draw.has(Flag::kShaderWritesDepth) ||
         draw.has(Flag::kShaderSideEffects) || draw.has(Flag::kAlphaToCoverage);
}

/// A rectangle of pixels that holds the triangle.
PixelRect bounding_box(const GridTriangle& t, int subpixel_bits) {
  // Right shift of a negative number rounds down (C++20).
  PixelRect box;
  box.first_x = std::min({t[0].x, t[1].x, t[2].x}) >> subpixel_bits;
  box.first_y = std::min({t[0].y, t[1].y, t[2].y}) >> subpixel_bits;
  box.end_x = (std::max({t[0].x, t[1].x, t[2].x}) >> subpixel_bits) + 1;
  box.end_y = (std::max({t[0].y, t[1].y, t[2].y}) >> subpixel_bits) + 1;
  return box;
}

double fragment_depth(const DepthPlane& plane, double offset, std::int64_t x, std::int64_t y,
                      const Command& draw) {
  const double depth = plane.at(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5) + offset;
  if (!draw.has(Flag::kDepthClamp)) return depth;  // encode_depth clamps to [0,1]
  const auto [low, high] = std::minmax({draw.depth_range.x, draw.depth_range.y});
  return std::clamp(depth, static_cast<double>(low), static_cast<double>(high));
}

void shade_fragment(const DrawContext& c, std::int64_t x, std::int64_t y, double depth) {
  Surface& s = c.surface;
  const std::size_t pixel = static_cast<std::size_t>(y) * s.width + static_cast<std::size_t>(x);
  ++s.counters.covered_fragments;
  count_up(s.fragments[pixel]);
  const double rounded = c.options.float32_depth ? static_cast<float>(depth) : depth;
  const std::uint32_t code = encode_depth(rounded, c.storage);
  if (c.tests && !depth_test(static_cast<std::uint32_t>(c.draw.depth_func), code, s.codes[pixel])) return;
  ++s.counters.depth_passed;
  count_up(s.survivors[pixel]);
  if (c.writes) s.codes[pixel] = code;
}

enum class Fate {
  kDegenerate,
  kCulled,
  kDrawn
};  // in rising order: a triangle has the highest of its pieces

/// One piece of a triangle, inside the clip volume; largest_depth is that of the whole triangle.
Fate draw_piece(const DrawContext& c, const WindowTriangle& t, double largest_depth) {
  const int bits = c.options.subpixel_bits;
  Counters& counters = c.surface.counters;
  const GridTriangle snapped = {snap(t[0], bits), snap(t[1], bits), snap(t[2], bits)};
  const Int128 area = twice_area(snapped[0], snapped[1], snapped[2]);
  if (area == 0) return Fate::kDegenerate;
  const bool front = (area > 0) == c.draw.has(Flag::kFrontPositiveArea);
  if (c.draw.has(front ? Flag::kCullFront : Flag::kCullBack)) return Fate::kCulled;

  const DepthPlane plane = depth_plane(t);
  const double offset = polygon_offset(depth_plane(on_grid(t, bits)), largest_depth, c.draw, c.storage);
  const TieRule rule = c.draw.has(Flag::kBottomLeftRule) ? TieRule::kBottomLeft : TieRule::kTopLeft;
  const PixelRect box = intersect(bounding_box(snapped, bits), c.window);
  // Aligned 2x2 blocks: an even corner at or before the box, which lies in the target and so is not negative.
  for (std::int64_t qy = box.first_y - box.first_y % 2; qy < box.end_y; qy += 2) {
    for (std::int64_t qx = box.first_x - box.first_x % 2; qx < box.end_x; qx += 2) {
      int covered = 0;
      for (std::int64_t y = qy; y < qy + 2; ++y) {
        for (std::int64_t x = qx; x < qx + 2; ++x) {
          if (!box.contains(x, y) || !covers(snapped, pixel_centre(x, y, bits), rule)) continue;
          ++covered;
          shade_fragment(c, x, y, fragment_depth(plane, offset, x, y, c.draw));
        }
      }
      if (covered == 0) continue;
      ++counters.quads;
      counters.helper_fragments += static_cast<std::uint64_t>(4 - covered);
    }
  }
  return Fate::kDrawn;
}

bool is_finite(const glm::vec4& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}

void draw_triangle(const DrawContext& c, const std::array<glm::vec4, 3>& vertices) {
  Counters& counters = c.surface.counters;
  ++counters.triangles;
  Polygon polygon;
  for (const glm::vec4& v : vertices) {
    if (!is_finite(v)) {
      ++counters.non_finite;
      return;
    }
    polygon.push_back({v.x, v.y, v.z, v.w});
  }

  const Command& d = c.draw;
  if (!d.has(Flag::kDepthClamp)) polygon = clip(polygon, depth_planes(d.has(Flag::kNdcZMinusOneToOne)));
  polygon = clip(polygon, guard_band_planes(c.options.guard_band, c.options.window_limit, d.viewport.x,
                                            d.viewport.y, d.viewport.z, d.viewport.w));
  const bool divisible =
      std::all_of(polygon.begin(), polygon.end(), [](const Homogeneous& v) { return v.w > 0; });
  if (polygon.size() < 3 || !divisible) {
    ++counters.clipped_away;
    return;
  }

  double largest_depth = 0;
  for (const Homogeneous& v : polygon) largest_depth = std::max(largest_depth, std::abs(to_window(v, d).z));

  // What is left is convex: a fan around its first vertex.
  Fate fate = Fate::kDegenerate;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    fate = std::max(
        fate,
        draw_piece(c, {to_window(polygon[0], d), to_window(polygon[i], d), to_window(polygon[i + 1], d)},
                   largest_depth));
  }
  if (fate == Fate::kDegenerate) ++counters.degenerate;
  if (fate == Fate::kCulled) ++counters.culled;
  if (fate == Fate::kDrawn) ++counters.drawn;
}

void draw(const Frame& frame, const Command& command, const Options& options, Surface& surface) {
  const Target& target = frame.targets[command.target];
  const PixelRect whole = {0, 0, target.width, target.height};
  const bool may_write = options.late_z == LateZ::kOpaque || !is_late_z(command);
  const DrawContext context = {
      command,
      options,
      static_cast<Storage>(target.depth_format),
      intersect(intersect(to_rect(command.scissor), viewport_rect(command, target)), whole),
      command.has(Flag::kDepthTest),
      command.has(Flag::kDepthWrite) && may_write,
      surface};
  for (std::uint32_t i = 0; i + 2 < command.index_count; i += 3) {
    std::array<glm::vec4, 3> vertices;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint64_t index = frame.indices[command.first_index + i + k];
      vertices[k] = frame.vertices[command.first_vertex + index];
    }
    draw_triangle(context, vertices);
  }
}

void clear(const Frame& frame, const Command& command, Surface& surface) {
  if (!command.has(Flag::kClearDepth)) return;
  const Target& target = frame.targets[command.target];
  const std::uint32_t code = encode_depth(command.clear_depth, static_cast<Storage>(target.depth_format));
  const PixelRect rect = intersect(to_rect(command.scissor), {0, 0, target.width, target.height});
  for (std::int64_t y = rect.first_y; y < rect.end_y; ++y) {
    for (std::int64_t x = rect.first_x; x < rect.end_x; ++x) {
      surface.codes[static_cast<std::size_t>(y) * surface.width + static_cast<std::size_t>(x)] = code;
    }
  }
}

void require(bool condition, const std::string& message) {
  if (!condition) throw InputError(message);
}

/// What the rest of this file relies on.
void check(const Frame& frame, const Options& options) {
  require(options.subpixel_bits >= 4 && options.subpixel_bits <= 8,
          "subpixel_bits: " + std::to_string(options.subpixel_bits) + " is not in 4 to 8");
  std::map<std::uint32_t, Target> first;
  for (const Target& t : frame.targets) {
    if (t.depth_surface == kNoSurface) continue;
    const Target& other = first.try_emplace(t.depth_surface, t).first->second;
    const std::string surface = "depth surface " + std::to_string(t.depth_surface);
    require(t.depth_format != DepthFormat{}, surface + ": a target has it without a depth format");
    require(t.width == other.width && t.height == other.height && t.depth_format == other.depth_format,
            surface + ": its targets differ in size or format");
  }
  for (std::size_t i = 0; i < frame.commands.size(); ++i) {
    const Command& c = frame.commands[i];
    const std::string where = "command " + std::to_string(i);
    require(c.target < frame.targets.size(),
            where + ": target " + std::to_string(c.target) + " does not exist");
    if (c.kind != CommandKind::kDraw) continue;
    require(is_finite(c.viewport), where + ": viewport is not finite");
    require(std::uint64_t{c.first_index} + c.index_count <= frame.indices.size(),
            where + ": indices end early");
    for (std::uint32_t k = 0; k < c.index_count; ++k) {
      require(std::uint64_t{c.first_vertex} + frame.indices[c.first_index + k] < frame.vertices.size(),
              where + ": an index has no vertex");
    }
  }
}

Surface make_surface(const Target& target) {
  Surface s;
  s.index = target.depth_surface;
  s.width = target.width;
  s.height = target.height;
  const std::size_t pixels = static_cast<std::size_t>(s.width) * s.height;
  s.codes.assign(pixels, encode_depth(1.0, static_cast<Storage>(target.depth_format)));
  s.fragments.assign(pixels, 0);
  s.survivors.assign(pixels, 0);
  return s;
}

}  // namespace

std::vector<Surface> rasterize(const Frame& frame, const Options& options) {
  check(frame, options);
  std::map<std::uint32_t, Surface> surfaces;
  std::map<std::uint32_t, Storage> storage;
  for (const Target& target : frame.targets) {
    if (target.depth_surface == kNoSurface) continue;
    surfaces.try_emplace(target.depth_surface, make_surface(target));
    storage.try_emplace(target.depth_surface, static_cast<Storage>(target.depth_format));
  }
  for (const Command& command : frame.commands) {
    const std::uint32_t index = frame.targets[command.target].depth_surface;
    if (index == kNoSurface) continue;
    if (command.kind == CommandKind::kClear) clear(frame, command, surfaces.at(index));
    if (command.kind == CommandKind::kDraw) draw(frame, command, options, surfaces.at(index));
  }
  std::vector<Surface> result;
  for (auto& [index, surface] : surfaces) {
    for (const std::uint32_t code : surface.codes) {
      surface.depth.push_back(decode_depth(code, storage.at(index)));
    }
    result.push_back(std::move(surface));
  }
  return result;
}

}  // namespace halfspace::reference
