#include "halfspace/reference/clipped_triangle.hpp"

#include <algorithm>
#include <cmath>

namespace halfspace::reference {
namespace {

/// Draws one piece of a triangle, inside the clip volume; largest_depth is that of the whole triangle.
Fate draw_piece(const std::array<Corner, 3>& corners, const DrawState& draw, double largest_depth,
                CoverageMethod cover, DrawnTriangle& drawn) {
  const int bits = draw.options.subpixel_bits;
  Piece piece;
  WindowTriangle window;
  for (std::size_t i = 0; i < 3; ++i) {
    window[i] = to_window(corners[i], draw.command);
    piece.grid[i] = snap(window[i], bits);
    piece.depth[i] = window[i].z;
    piece.color[i] = corners[i].color;
  }
  const Int128 area = twice_area(piece.grid[0], piece.grid[1], piece.grid[2]);
  const bool by_touch = draw.options.pixels == Pixels::kTouched;
  if (area == 0 && !by_touch) return Fate::kDegenerate;
  // A triangle without area faces back, and has the depth of its first vertex.
  const bool front = area != 0 && (area > 0) == draw.command.has(Flag::kFrontPositiveArea);
  if (area == 0) {
    for (std::size_t i = 1; i < 3; ++i) window[i].z = piece.depth[i] = window[0].z;
  }
  if (draw.command.has(front ? Flag::kCullFront : Flag::kCullBack)) return Fate::kCulled;

  piece.subpixel_bits = bits;
  piece.rule = draw.rule;
  piece.pixels = draw.options.pixels;
  piece.uncertainty = draw.options.uncertainty;
  PixelRect box = bounding_box(piece.grid, bits);
  if (by_touch) box = {box.first_x - 1, box.first_y - 1, box.end_x + 1, box.end_y + 1};
  piece.bounds = intersect(box, draw.window);
  piece.plane = depth_plane(window);
  std::vector<Fragment> fragments;
  cover(piece, fragments);
  const double offset =
      polygon_offset(depth_plane(on_grid(window, bits)), largest_depth, draw.command, draw.storage);
  const auto [least, most] = std::minmax({piece.depth[0], piece.depth[1], piece.depth[2]});
  for (Fragment& f : fragments) {
    if (by_touch) f.depth = std::clamp(f.depth, least, most);  // the centre may be outside
    f.depth = offset_and_clamped(f.depth, offset, draw.command);
  }
  drawn.pieces.push_back(std::move(fragments));
  return Fate::kDrawn;
}

}  // namespace

PixelRect bounding_box(const GridTriangle& t, int subpixel_bits) {
  // Right shift of a negative number rounds down (C++20).
  PixelRect box;
  box.first_x = std::min({t[0].x, t[1].x, t[2].x}) >> subpixel_bits;
  box.first_y = std::min({t[0].y, t[1].y, t[2].y}) >> subpixel_bits;
  box.end_x = (std::max({t[0].x, t[1].x, t[2].x}) >> subpixel_bits) + 1;
  box.end_y = (std::max({t[0].y, t[1].y, t[2].y}) >> subpixel_bits) + 1;
  return box;
}

std::vector<Homogeneous> guard_band(const DrawState& draw) {
  const Command& d = draw.command;
  std::vector<Homogeneous> planes;
  if (!d.has(Flag::kDepthClamp)) planes = depth_planes(d.has(Flag::kNdcZMinusOneToOne));
  for (const Homogeneous& plane : guard_band_planes(draw.options.guard_band, draw.options.window_limit,
                                                    d.viewport.x, d.viewport.y, d.viewport.z, d.viewport.w)) {
    planes.push_back(plane);
  }
  return planes;
}

DrawnTriangle draw_clipped(const ClipTriangle& triangle, const DrawState& draw,
                           const std::vector<Homogeneous>& planes, CoverageMethod cover) {
  DrawnTriangle drawn;
  const Polygon polygon = clip(Polygon(triangle.begin(), triangle.end()), planes);
  const bool divisible = std::all_of(polygon.begin(), polygon.end(), [](const Corner& v) { return v.w > 0; });
  if (polygon.size() < 3 || !divisible) return drawn;

  double largest_depth = 0;
  for (const Corner& v : polygon) {
    largest_depth = std::max(largest_depth, std::abs(to_window(v, draw.command).z));
  }
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    drawn.fate = std::max(
        drawn.fate, draw_piece({polygon[0], polygon[i], polygon[i + 1]}, draw, largest_depth, cover, drawn));
  }
  return drawn;
}

}  // namespace halfspace::reference
