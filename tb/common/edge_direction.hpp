/// The directions of an edge, by the signs of a and b: bins of the walkers' coverage.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace halfspace::tb {

inline constexpr std::size_t kDirections = 9;
/// a and b are 0: no edge of a triangle.
inline constexpr std::size_t kNoDirection = 4;
/// A left edge along a column. It goes through the leftmost sample column of the bounds or passes it on the
/// left, and owns what it goes through: no tile of the bounds is outside it.
inline constexpr std::size_t kLeftEdge = 7;

inline std::size_t edge_direction(std::int32_t a, std::int32_t b) {
  const auto sign = [](std::int32_t step) -> std::size_t { return step < 0 ? 0 : step == 0 ? 1 : 2; };
  return 3 * sign(a) + sign(b);
}

inline std::string direction_name(std::size_t direction) {
  static constexpr std::array<const char*, 3> kSigns = {"-", "0", "+"};
  return fmt::format("({}, {})", kSigns[direction / 3], kSigns[direction % 3]);
}

}  // namespace halfspace::tb
