/// The walk over the cells of a rectangle of a grid, in one of the orders, a cell a step.
///
/// Rows (RowWalk) and curves (CurveWalk) need no more than the next cell. The two led walks are told in each
/// step on which sides of the cell, in its row, nothing of the triangle lies: an edge that rejects the cell
/// rejects all cells on the side to which it falls. So a row's cells that no edge rejects are an interval,
/// each cell outside of it says where it lies, and no cell of it is left out, whatever its neighbours in the
/// row above are.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "halfspace/units/packets.hpp"
#include "halfspace/units/walk_order.hpp"

namespace halfspace {

/// What edges that reject a cell say of its row. Neither: no edge rejects the cell.
struct RowSides {
  bool none_left = false;   ///< nor any cell to the left
  bool none_right = false;  ///< nor any cell to the right
  [[nodiscard]] constexpr bool inside() const { return !none_left && !none_right; }
};

/// An order of rows from the top.
class RowWalk {
 public:
  /// `cells`: a cell or more, by column and row of the grid.
  constexpr RowWalk(WalkOrder order, const PixelRect& cells)
      : order_(order), cells_(cells), at_{cells.x_first, cells.y_first}, entry_(cells.x_first) {}

  [[nodiscard]] constexpr bool done() const { return at_.y > cells_.y_last; }
  [[nodiscard]] constexpr GridPlace at() const { return at_; }

  /// Whether this step only leads the walk: then the cell's own step comes later, if it has one.
  [[nodiscard]] constexpr bool passes(const RowSides& sides) const {
    return order_ == WalkOrder::kBacktracking && way_ == Way::kEntry && may_go_left(sides);
  }

  /// To the next cell.
  constexpr void advance(const RowSides& sides) {
    switch (order_) {
      case WalkOrder::kBoustrophedonic:
        turn_at_ends();
        break;
      case WalkOrder::kBacktracking:
        backtrack(sides);
        break;
      case WalkOrder::kZigzag:
        zigzag(sides);
        break;
      default:
        at_.x < cells_.x_last ? go_right(false) : go_down();
    }
  }

 private:
  enum class Way : std::uint8_t {
    kEntry,          ///< a row begins; in backtracking all the way to its left end
    kLeft,           ///< to the left, and the row is done
    kLeftThenRight,  ///< to the left, then from the entry to the right
    kRight,          ///< to the right, and the row is done
  };

  [[nodiscard]] constexpr bool may_go_left(const RowSides& sides) const {
    return !sides.none_left && at_.x > cells_.x_first;
  }
  [[nodiscard]] constexpr bool may_go_right(const RowSides& sides) const {
    return !sides.none_right && at_.x < cells_.x_last;
  }

  /// `search`: nothing of the row has been found yet, so the entry comes along.
  constexpr void go_left(bool search) {
    --at_.x;
    entry_ = search ? at_.x : entry_;
  }
  constexpr void go_right(bool search) {
    ++at_.x;
    entry_ = search ? at_.x : entry_;
  }
  constexpr void go_down() {
    at_ = {entry_, at_.y + 1};
    way_ = Way::kEntry;
  }

  constexpr void turn_at_ends() {
    const bool left = way_ == Way::kLeft;
    if (at_.x != (left ? cells_.x_first : cells_.x_last)) {
      left ? go_left(false) : go_right(false);
      return;
    }
    entry_ = at_.x;
    go_down();
    way_ = left ? Way::kEntry : Way::kLeft;
  }

  constexpr void backtrack(const RowSides& sides) {
    if (passes(sides)) {
      go_left(true);
      return;
    }
    way_ = Way::kRight;
    may_go_right(sides) ? go_right(sides.none_left) : go_down();
  }

  constexpr void zigzag(const RowSides& sides) {
    if (way_ == Way::kEntry) {
      way_ = sides.none_left ? Way::kRight : sides.none_right ? Way::kLeft : Way::kLeftThenRight;
    }
    if (way_ == Way::kRight) {
      may_go_right(sides) ? go_right(sides.none_left) : go_down();
    } else if (may_go_left(sides)) {
      go_left(sides.none_right);
    } else if (way_ == Way::kLeftThenRight && entry_ < cells_.x_last) {
      at_.x = entry_;
      go_right(false);
      way_ = Way::kRight;
    } else {
      go_down();
    }
  }

  WalkOrder order_;
  PixelRect cells_;
  GridPlace at_;
  int entry_;  ///< of the row: the next row begins below it
  Way way_ = Way::kEntry;
};

/// A curve through the least square of 2^n x 2^n cells, aligned to its size, that holds the rectangle. Cells
/// outside the rectangle are jumped over: the next quadrant of the curve that has a cell of it is found level
/// by level.
class CurveWalk {
 public:
  constexpr CurveWalk(bool hilbert, const PixelRect& cells)
      : hilbert_(hilbert),
        cells_(cells),
        levels_(std::bit_width(static_cast<unsigned>(cells.x_first ^ cells.x_last) |
                               static_cast<unsigned>(cells.y_first ^ cells.y_last))),
        at_{cells.x_first >> levels_, cells.y_first >> levels_} {
    descend(levels_);
  }

  [[nodiscard]] constexpr bool done() const { return done_; }
  [[nodiscard]] constexpr GridPlace at() const { return at_; }

  [[nodiscard]] static constexpr bool passes(const RowSides& /*sides*/) { return false; }

  constexpr void advance(const RowSides& /*sides*/) {
    for (int level = 0; level < levels_; ++level) {
      at_ = {at_.x >> 1, at_.y >> 1};  // the square around
      if (enter(level, position_[static_cast<std::size_t>(level)] + 1)) {
        descend(level);
        return;
      }
    }
    done_ = true;
  }

 private:
  /// From a square of 2^(level + 1) cells a side to the first of its quadrants, from this one on, that has a
  /// cell.
  constexpr bool enter(int level, int position) {
    const auto at = static_cast<std::size_t>(level);
    for (; position < 4; ++position) {
      const GridPlace quadrant = curve_quadrant(hilbert_, turn_[at + 1], position);
      const GridPlace next{at_.x * 2 + quadrant.x, at_.y * 2 + quadrant.y};
      if (next.x >= cells_.x_first >> level && next.x <= cells_.x_last >> level &&
          next.y >= cells_.y_first >> level && next.y <= cells_.y_last >> level) {
        turn_[at] = curve_turn(hilbert_, turn_[at + 1], position);
        position_[at] = position;
        at_ = next;
        return true;
      }
    }
    return false;
  }
  constexpr void descend(int level) {
    while (level > 0) {
      enter(--level, 0);
    }
  }

  static constexpr std::size_t kMostLevels = 16;

  bool hilbert_;
  PixelRect cells_;
  int levels_;
  GridPlace at_;
  bool done_ = false;
  std::array<CurveTurn, kMostLevels + 1> turn_{};  ///< in the square of 2^i cells a side around the cell
  std::array<int, kMostLevels> position_{};        ///< of the quadrant of 2^i cells a side
};

/// Calls walk(cells) with the walk over them.
template <class Walk>
constexpr void with_cell_walk(WalkOrder order, const PixelRect& cells, const Walk& walk) {
  if (order == WalkOrder::kMorton || order == WalkOrder::kHilbert) {
    walk(CurveWalk(order == WalkOrder::kHilbert, cells));
  } else {
    walk(RowWalk(order, cells));
  }
}

}  // namespace halfspace
