/// What a draw draws, and by which rule a line becomes pixels: docs/guides/lines.md.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace halfspace {

/// What the indices of a draw name.
enum class Primitive : std::uint32_t {
  kTriangles,  ///< three an element
  kLines,      ///< two an element, the start and the end
  kPoints,     ///< one an element
  kLineStrip,  ///< as kLines; the stipple goes on where a line starts with the index that the one before
               ///< ended
};
inline constexpr std::array<const char*, 4> kPrimitiveName{"triangles", "lines", "points", "line_strip"};

/// Indices of a primitive.
constexpr std::uint32_t indices_each(Primitive primitive) {
  return primitive == Primitive::kTriangles ? 3 : primitive == Primitive::kPoints ? 1 : 2;
}

/// How a triangle is drawn.
enum class PolygonMode : std::uint32_t { kFill, kLine, kPoint };
inline constexpr std::array<const char*, 3> kPolygonModeName{"fill", "line", "point"};

enum class LineRule : std::uint32_t {
  kRectangular,  ///< the rectangle about the line, whose ends are square: Vulkan's rectangular lines
  kBresenham,    ///< the diamonds that a line leaves, ends moved by (-e, -e^2): Vulkan's and OpenGL's rule
  kDiamondExit,  ///< the diamonds that a line leaves, with Direct3D's edges and corners
  kMidpoint,     ///< from the pixel of the start to that of the end, the nearest pixel of each column
  kDda,          ///< the same with a slope of kDdaFraction bits that is added up
};
inline constexpr std::array<const char*, 5> kLineRuleName{"rectangular", "bresenham", "diamond_exit",
                                                          "midpoint", "dda"};

/// Fraction bits of a slope of LineRule::kDda.
inline constexpr int kDdaFraction = 16;

inline constexpr int kMaxLineWidth = 64;    ///< pixels
inline constexpr int kMaxPointSize = 2048;  ///< pixels
inline constexpr int kMaxStippleFactor = 256;

/// Whether a line is at most one fragment in each column, or row, times its width.
constexpr bool is_thin(LineRule rule) { return rule != LineRule::kRectangular; }

/// Thin lines are a whole number of fragments wide, at least one.
inline int thin_width(float width) { return std::max(static_cast<int>(std::lround(width)), 1); }

/// Which fragments of a line are drawn: bit (counter / factor) % 16 of the pattern says it.
struct LineStipple {
  std::uint16_t factor = 1;
  std::uint16_t pattern = 0xFFFF;

  [[nodiscard]] constexpr bool draws_all() const { return pattern == 0xFFFF; }
  [[nodiscard]] constexpr bool draws(std::uint64_t counter) const {
    return (pattern >> (counter / factor % 16) & 1) != 0;
  }
};

}  // namespace halfspace
