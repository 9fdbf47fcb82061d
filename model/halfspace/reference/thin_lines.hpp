/// Thin lines of a draw, as textbooks draw them: by Bresenham's loop, by the loop of the digital differential
/// analyser, and for the rules of diamonds by asking of every pixel about the line whether its diamond is
/// left (exact_line.hpp). Shares no formula with units/thin_line.hpp.
#pragma once

#include <array>
#include <cstdint>

#include "halfspace/reference/triangle_method.hpp"

namespace halfspace::reference {

/// Lines one after the other: the counter of the stipple goes from one to the next.
class ThinLines {
 public:
  /// `draw.command` draws lines by a rule that is_thin(), or the sides of triangles.
  explicit ThinLines(const DrawState& draw) : draw_(draw) {}

  /// `goes_on`: a strip, in which the line before ended here. Throws InputError for a line of the rule
  /// `bresenham` that is too long for the definition.
  DrawnTriangle line(const std::array<Corner, 2>& ends, bool goes_on);

  /// The sides of what clipping leaves of a triangle.
  DrawnTriangle outline(const ClipTriangle& triangle);

 private:
  /// Inside the clip volume.
  std::vector<Fragment> draw_segment(const Corner& a, const Corner& b, double offset);

  const DrawState& draw_;
  std::uint64_t stippled_ = 0;  ///< fragments so far
};

}  // namespace halfspace::reference
