/// The pixels of a thin line, as an area: between two edges that are parallel to the line, and in some of its
/// columns (rows where the line is y-major). No unit has to walk a line pixel by pixel: what the rules of
/// lines say of a column is a comparison of a linear function with 0, as an edge of a triangle is.
///
/// Rules: Vulkan 1.3, "Bresenham Line Segment Rasterization" and "Line Stipple"; Direct3D 11.3 functional
/// specification, "Line Rasterization"; J. E. Bresenham, "Algorithm for computer control of a digital
/// plotter", IBM Systems Journal 4(1), 1965. Why an area says the same: docs/units/line_setup.md.
#pragma once

#include <array>
#include <cstdint>

#include "halfspace/numerics/line_rule.hpp"
#include "halfspace/units/packets.hpp"

namespace halfspace {

/// A point on the sub-pixel grid, y down.
struct LinePoint {
  std::int32_t x = 0;
  std::int32_t y = 0;
  friend bool operator==(const LinePoint&, const LinePoint&) = default;
};

/// Fragments are those of the columns first to last in which both edges are >= 0 at the pixel's centre: in
/// each column as many as the line is wide.
struct ThinLine {
  bool x_major = true;  ///< else columns are rows
  bool forward = true;  ///< it is drawn from `first` to `last`, else from `last` to `first`
  std::int32_t first = 0;
  std::int32_t last = -1;
  std::int32_t minor_first = 0;  ///< pixels of columns at the ends of the line: those of all are between
  std::int32_t minor_last = -1;
  std::array<Edge, 2> edge{};  ///< c at the centre of pixel (0, 0), ties folded in

  [[nodiscard]] bool empty() const { return last < first; }
  [[nodiscard]] std::int64_t length() const { return empty() ? 0 : std::int64_t{last} - first + 1; }
};

/// The line from `a` to `b` by a rule that is_thin(), `width` fragments (1 to kMaxLineWidth) in each column.
/// Both ends must be inside the guard band (16 + sub_pixel_bits signed bits). The pixel of the end is left
/// out by every rule, so the lines of a strip have no pixel twice; a line without length has none.
ThinLine thin_line(const LinePoint& a, const LinePoint& b, LineRule rule, int width, int sub_pixel_bits);

}  // namespace halfspace
