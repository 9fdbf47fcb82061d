#include "halfspace/reference/homogeneous.hpp"

#include <algorithm>
#include <cmath>

#include "halfspace/reference/window.hpp"

namespace halfspace::reference {
namespace {

/// A x + B y + C at the window position (x, y).
struct LinearFunction {
  double a = 0;
  double b = 0;
  double c = 0;

  [[nodiscard]] double at(double x, double y) const { return a * x + b * y + c; }
};

/// `weight[0]` times the first, and so on.
LinearFunction weighted_sum(const std::array<LinearFunction, 3>& f, const std::array<double, 3>& weight) {
  LinearFunction sum;
  for (std::size_t i = 0; i < 3; ++i) {
    sum.a += weight[i] * f[i].a;
    sum.b += weight[i] * f[i].b;
    sum.c += weight[i] * f[i].c;
  }
  return sum;
}

/// A position in the window, times w.
struct WindowPoint {
  double x;
  double y;
  double w;
};

WindowPoint homogeneous_window(const Corner& v, const Command& draw) {
  const double half_width = static_cast<double>(draw.viewport.z) / 2;
  const double half_height = static_cast<double>(draw.viewport.w) / 2;
  return {v.x * half_width + v.w * (draw.viewport.x + half_width),
          v.y * half_height + v.w * (draw.viewport.y + half_height), v.w};
}

/// The edge function of j and k: their cross product, a row of the adjugate of the matrix of the vertices. If
/// j and k are swapped, exactly the negative.
LinearFunction edge_function(const WindowPoint& j, const WindowPoint& k) {
  return {j.y * k.w - j.w * k.y, j.w * k.x - j.x * k.w, j.x * k.y - j.y * k.x};
}

/// An edge of the triangle has ties; a plane of the clip volume, which cuts no surface in two, has none.
struct Boundary {
  LinearFunction function;
  bool owns_ties;

  [[nodiscard]] bool has_inside(double x, double y) const {
    const double e = function.at(x, y);
    return owns_ties ? e >= 0 : e > 0;
  }
};

/// Whether no pixel of the rectangle is inside. Linear functions have their largest value in a corner, and so
/// have their rounded values, because rounding keeps the order.
bool is_outside(const Boundary& boundary, const PixelRect& rect) {
  for (const std::int64_t y : {rect.first_y, rect.end_y - 1}) {
    for (const std::int64_t x : {rect.first_x, rect.end_x - 1}) {
      if (boundary.has_inside(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5)) return false;
    }
  }
  return true;
}

/// Halves the rectangle until it is outside of a boundary or a pixel, which is then inside of all. There is
/// no bounding box: without the division it is not known.
void descend(const std::vector<Boundary>& boundaries, const PixelRect& rect,
             std::vector<Fragment>& fragments) {
  if (rect.first_x >= rect.end_x || rect.first_y >= rect.end_y) return;
  for (const Boundary& boundary : boundaries) {
    if (is_outside(boundary, rect)) return;
  }
  const std::int64_t width = rect.end_x - rect.first_x;
  const std::int64_t height = rect.end_y - rect.first_y;
  if (width == 1 && height == 1) {
    fragments.push_back({rect.first_x, rect.first_y, 0, {}});
    return;
  }
  PixelRect one = rect;
  PixelRect other = rect;
  if (width >= height) {
    one.end_x = other.first_x = rect.first_x + width / 2;
  } else {
    one.end_y = other.first_y = rect.first_y + height / 2;
  }
  descend(boundaries, one, fragments);
  descend(boundaries, other, fragments);
}

/// The signed distances of the vertices from a plane of the clip volume.
std::array<double, 3> distances(const ClipTriangle& t, const Homogeneous& plane) {
  std::array<double, 3> d;
  for (std::size_t i = 0; i < 3; ++i) {
    d[i] = plane.x * t[i].x + plane.y * t[i].y + plane.z * t[i].z + plane.w * t[i].w;
  }
  return d;
}

bool all_outside(const std::array<double, 3>& d) { return d[0] < 0 && d[1] < 0 && d[2] < 0; }
bool one_outside(const std::array<double, 3>& d) { return d[0] < 0 || d[1] < 0 || d[2] < 0; }

/// What a sample must be inside of. `edge`: positive inside; E_i is the determinant times the weight of
/// vertex i over w, so where none is negative w is positive.
std::vector<Boundary> boundaries_of(const ClipTriangle& triangle, const std::array<LinearFunction, 3>& edge,
                                    const std::vector<Homogeneous>& depth_limits, TieRule rule) {
  const auto boundary = [&](const LinearFunction& e) { return Boundary{e, owns_samples(e.a, e.b, rule)}; };
  std::vector<Boundary> boundaries = {boundary(edge[0]), boundary(edge[1]), boundary(edge[2])};
  // The near plane is a fourth edge function, and the far plane a fifth: a distance over w is linear too.
  for (const Homogeneous& plane : depth_limits) {
    const std::array<double, 3> distance = distances(triangle, plane);
    if (one_outside(distance)) boundaries.push_back({weighted_sum(edge, distance), true});
  }
  return boundaries;
}

/// Depth in the window. z / w is linear there: the sum of z_i E_i / determinant.
DepthPlane window_depth(const LinearFunction& z, double determinant, const Command& draw) {
  const double range = to_depth(1, draw) - to_depth(0, draw);
  return {.x0 = 0,
          .y0 = 0,
          .z = to_depth(z.c / determinant, draw),
          .dzdx = range * z.a / determinant,
          .dzdy = range * z.b / determinant};
}

}  // namespace

DrawnTriangle draw_homogeneously(const ClipTriangle& triangle, const DrawState& draw) {
  const Command& d = draw.command;
  std::vector<Homogeneous> depth_limits;
  if (!d.has(Flag::kDepthClamp)) depth_limits = depth_planes(d.has(Flag::kNdcZMinusOneToOne));
  std::vector<Homogeneous> volume = {{1, 0, 0, 1}, {-1, 0, 0, 1}, {0, 1, 0, 1}, {0, -1, 0, 1}};
  volume.insert(volume.end(), depth_limits.begin(), depth_limits.end());
  for (const Homogeneous& plane : volume) {
    if (all_outside(distances(triangle, plane))) return {Fate::kClippedAway, {}};
  }

  std::array<WindowPoint, 3> v;
  for (std::size_t i = 0; i < 3; ++i) v[i] = homogeneous_window(triangle[i], d);
  std::array<LinearFunction, 3> edge;  // edge[i] is opposite to vertex i
  for (std::size_t i = 0; i < 3; ++i) edge[i] = edge_function(v[(i + 1) % 3], v[(i + 2) % 3]);
  double determinant = edge[0].a * v[0].x + edge[0].b * v[0].y + edge[0].c * v[0].w;
  // The sign of the determinant is that of the area wherever the triangle is in front of the eye.
  if (determinant == 0) return {Fate::kDegenerate, {}};
  const bool front = (determinant > 0) == d.has(Flag::kFrontPositiveArea);
  if (d.has(front ? Flag::kCullFront : Flag::kCullBack)) return {Fate::kCulled, {}};
  if (determinant < 0) {
    determinant = -determinant;
    for (LinearFunction& e : edge) e = {-e.a, -e.b, -e.c};
  }

  const std::vector<Boundary> boundaries = boundaries_of(triangle, edge, depth_limits, draw.rule);
  DrawnTriangle drawn{Fate::kDrawn, {{}}};
  std::vector<Fragment>& fragments = drawn.pieces[0];
  descend(boundaries, draw.window, fragments);

  const LinearFunction z = weighted_sum(edge, {triangle[0].z, triangle[1].z, triangle[2].z});
  const DepthPlane plane = window_depth(z, determinant, d);
  double largest_depth = 0;
  for (Fragment& f : fragments) {
    f.depth = plane.at(static_cast<double>(f.x) + 0.5, static_cast<double>(f.y) + 0.5);
    largest_depth = std::max(largest_depth, std::abs(f.depth));
  }
  const double offset = polygon_offset(plane, largest_depth, d, draw.storage);
  for (Fragment& f : fragments) f.depth = offset_and_clamped(f.depth, offset, d);
  return drawn;
}

}  // namespace halfspace::reference
