#include "halfspace/units/line_rectangle.hpp"

#include <cmath>

namespace halfspace {
namespace {

__extension__ using Square = unsigned __int128;

std::int64_t square_of_length(const LinePoint& a, const LinePoint& b) {
  const std::int64_t dx = std::int64_t{b.x} - a.x;
  const std::int64_t dy = std::int64_t{b.y} - a.y;
  return dx * dx + dy * dy;
}

/// The largest integer whose square is not above `square`, by binary digits.
std::uint64_t whole_root(Square square) {
  std::uint64_t root = 0;
  for (int bit = 31; bit >= 0; --bit) {
    const std::uint64_t tried = root | std::uint64_t{1} << bit;
    root = Square{tried} * tried <= square ? tried : root;
  }
  return root;
}

}  // namespace

std::int64_t divide_by_root(std::int64_t value, std::int64_t square) {
  const auto magnitude = static_cast<std::uint64_t>(value < 0 ? -value : value);
  // floor(2 |value| / sqrt(square)) is the root of the quotient of the squares, cut
  const std::uint64_t twice =
      whole_root(Square{2 * magnitude} * (2 * magnitude) / static_cast<std::uint64_t>(square));
  const auto rounded = static_cast<std::int64_t>((twice + 1) / 2);
  return value < 0 ? -rounded : rounded;
}

LinePoint rectangle_offset(const LinePoint& a, const LinePoint& b, std::int64_t width) {
  const std::int64_t square = 4 * square_of_length(a, b);  // of twice the length, for half the width
  return {static_cast<std::int32_t>(divide_by_root(width * (std::int64_t{a.y} - b.y), square)),
          static_cast<std::int32_t>(divide_by_root(width * (std::int64_t{b.x} - a.x), square))};
}

LinePoint along_line(const LinePoint& a, const LinePoint& b, std::int64_t distance) {
  const std::int64_t square = square_of_length(a, b);
  if (Square{static_cast<std::uint64_t>(distance)} * static_cast<std::uint64_t>(distance) >=
      static_cast<std::uint64_t>(square)) {
    return b;
  }
  return {static_cast<std::int32_t>(a.x + divide_by_root(distance * (std::int64_t{b.x} - a.x), square)),
          static_cast<std::int32_t>(a.y + divide_by_root(distance * (std::int64_t{b.y} - a.y), square))};
}

std::int64_t pixels_long(const LinePoint& a, const LinePoint& b, int sub_pixel_bits) {
  const auto square = static_cast<std::uint64_t>(square_of_length(a, b));
  const std::uint64_t root = whole_root(square);
  const std::uint64_t up = root * root == square ? root : root + 1;
  return static_cast<std::int64_t>((up + (std::uint64_t{1} << sub_pixel_bits) - 1) >> sub_pixel_bits);
}

}  // namespace halfspace
