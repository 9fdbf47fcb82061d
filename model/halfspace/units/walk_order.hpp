/// The orders in which squares of a grid are visited, and the curves among them.
///
/// J. Pineda, "A Parallel Algorithm for Polygon Rasterization", SIGGRAPH 1988, has the walks that a triangle
/// leads; G. M. Morton, "A Computer Oriented Geodetic Data Base", 1966, and D. Hilbert, "Über die stetige
/// Abbildung einer Linie auf ein Flächenstück", 1891, the curves.
#pragma once

#include <cstdint>

namespace halfspace {

/// The order of block_walker's steps.
enum class WalkOrder : std::uint8_t {
  kRaster,           ///< rows from the top, each from the left
  kBoustrophedonic,  ///< rows from the top, every other from the right
  kBacktracking,  ///< rows from the top: in each to the left until outside, then to the right until outside
  kZigzag,        ///< rows from the top: in each from the entry to the left, then from the entry to the right
  kMorton,        ///< Morton's curve
  kHilbert,       ///< Hilbert's curve
};

/// Whether the triangle leads the walk.
constexpr bool is_led(WalkOrder order) {
  return order == WalkOrder::kBacktracking || order == WalkOrder::kZigzag;
}

/// The order of tile_walker's jobs.
enum class TileOrder : std::uint8_t { kRaster, kBoustrophedonic, kMorton, kHilbert };

/// The order within a square whose squares are walked in this order; the led walks have none.
constexpr TileOrder order_in_square(WalkOrder order) {
  switch (order) {
    case WalkOrder::kBoustrophedonic:
      return TileOrder::kBoustrophedonic;
    case WalkOrder::kMorton:
      return TileOrder::kMorton;
    case WalkOrder::kHilbert:
      return TileOrder::kHilbert;
    default:
      return TileOrder::kRaster;
  }
}

/// A square of a grid, by column and row.
struct GridPlace {
  int x = 0;
  int y = 0;
  constexpr bool operator==(const GridPlace&) const = default;
};

/// How a curve lies in a square: Hilbert's has four ways, of which Morton's has the first.
struct CurveTurn {
  bool turned = false;   ///< by 180 degrees
  bool swapped = false;  ///< x and y
};

/// The quadrant of a square in which a curve is, 0 to 3 along the curve: column and row, 0 or 1 each.
constexpr GridPlace curve_quadrant(bool hilbert, CurveTurn turn, int position) {
  if (!hilbert) {
    return {position & 1, position >> 1};
  }
  // (0, 0), (0, 1), (1, 1), (1, 0): the Gray code
  const int half = turn.turned ? 1 : 0;
  const int x = (position >> 1) ^ half;
  const int y = ((position >> 1) ^ (position & 1)) ^ half;
  return turn.swapped ? GridPlace{y, x} : GridPlace{x, y};
}

/// How the curve lies in that quadrant.
constexpr CurveTurn curve_turn(bool hilbert, CurveTurn turn, int position) {
  return {.turned = turn.turned != (hilbert && position == 3),
          .swapped = turn.swapped != (hilbert && (position == 0 || position == 3))};
}

/// Place `n` of a square of `side` x `side`, a power of two.
constexpr GridPlace place_in_order(TileOrder order, int side, int n) {
  const int row = n / side;
  switch (order) {
    case TileOrder::kRaster:
      return {n % side, row};
    case TileOrder::kBoustrophedonic:
      return {row % 2 == 0 ? n % side : side - 1 - n % side, row};
    case TileOrder::kMorton:
    case TileOrder::kHilbert:
      break;
  }
  const bool hilbert = order == TileOrder::kHilbert;
  GridPlace place;
  CurveTurn turn;
  for (int quarter = side * side / 4; quarter != 0; quarter /= 4) {
    const int position = n / quarter % 4;
    const GridPlace quadrant = curve_quadrant(hilbert, turn, position);
    place = {place.x * 2 + quadrant.x, place.y * 2 + quadrant.y};
    turn = curve_turn(hilbert, turn, position);
  }
  return place;
}

/// Calls visit(tile) for each bit y * side + x of `tiles`, in this order.
template <class Visit>
constexpr void for_each_in_order(TileOrder order, int side, std::uint64_t tiles, const Visit& visit) {
  for (int n = 0; n < side * side && tiles != 0; ++n) {
    const GridPlace place = place_in_order(order, side, n);
    const int tile = place.y * side + place.x;
    if ((tiles >> tile & 1) != 0) {
      tiles &= ~(std::uint64_t{1} << tile);
      visit(tile);
    }
  }
}

}  // namespace halfspace
