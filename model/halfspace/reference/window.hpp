/// Clip space to window coordinates and to the sub-pixel grid, and the depth plane of a triangle; double
/// precision.
#pragma once

#include <array>

#include "halfspace/reference/clip.hpp"
#include "halfspace/reference/depth_code.hpp"
#include "halfspace/reference/exact_triangle.hpp"
#include "halfspace/scene/frame.hpp"

namespace halfspace::reference {

/// A vertex in window coordinates: pixels, y down, depth in the units of the depth range.
struct WindowVertex {
  double x = 0;
  double y = 0;
  double z = 0;
};

using WindowTriangle = std::array<WindowVertex, 3>;

/// The perspective division, the viewport and the depth range of `draw`. v.w must be positive.
[[nodiscard]] WindowVertex to_window(const Homogeneous& v, const Command& draw);

/// The nearest point of the grid of 1/2^subpixel_bits pixel, ties to even.
[[nodiscard]] GridPoint snap(const WindowVertex& v, int subpixel_bits);

/// The triangle with its corners moved to that grid.
[[nodiscard]] WindowTriangle on_grid(const WindowTriangle& t, int subpixel_bits);

/// Depth at a position, of z / w there and the depth range of `draw`.
[[nodiscard]] double to_depth(double ndc_z, const Command& draw);

/// Depth as a linear function of the window position: z + dzdx * (x - x0) + dzdy * (y - y0).
struct DepthPlane {
  double x0 = 0;
  double y0 = 0;
  double z = 0;
  double dzdx = 0;
  double dzdy = 0;

  [[nodiscard]] double at(double x, double y) const { return z + dzdx * (x - x0) + dzdy * (y - y0); }
};

/// The plane through the three vertices as they were before snapping. Where these lie on one line (they can,
/// when only the snapping made an area), the plane is level, at the depth of the first vertex.
[[nodiscard]] DepthPlane depth_plane(const WindowTriangle& t);

/// The polygon offset of `draw` (Vulkan 1.3, "Depth Bias"; OpenGL 4.6, 14.6.5): m * factor + r * units,
/// clamped, where m is the larger slope of `plane` and r the smallest step of depth that the format resolves.
/// For float32 that depends on the largest magnitude of depth in the whole primitive, not in a piece that
/// clipping left.
[[nodiscard]] double polygon_offset(const DepthPlane& plane, double largest_depth, const Command& draw,
                                    Storage storage);

/// What depth state makes of the depth of a fragment: the polygon offset, and with depth clamp the depth
/// range. Without, [0,1], or all that a float32 holds where the depth range leaves [0,1].
[[nodiscard]] double offset_and_clamped(double depth, double offset, const Command& draw);

}  // namespace halfspace::reference
