// The orders of a walk over cells: against the curves' definitions, brute force over random half-planes, and
// walks written out by hand.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "../property/random.hpp"
#include "halfspace/units/cell_walk.hpp"

using namespace halfspace;
using namespace halfspace::testing;

namespace {

using Places = std::vector<std::pair<int, int>>;  ///< column, row

/// The walk of cells that nothing leads.
Places walk(WalkOrder order, const PixelRect& cells) {
  Places places;
  with_cell_walk(order, cells, [&](auto each) {
    for (; !each.done(); each.advance({})) {
      places.emplace_back(each.at().x, each.at().y);
    }
  });
  return places;
}

/// How far along Hilbert's curve through a square of `side` a cell is: the common routine of the textbooks,
/// which turns the cell's coordinates and not the curve.
int hilbert_distance(int side, int x, int y) {
  int distance = 0;
  for (int s = side / 2; s > 0; s /= 2) {
    const int rx = (x & s) != 0 ? 1 : 0;
    const int ry = (y & s) != 0 ? 1 : 0;
    distance += s * s * ((3 * rx) ^ ry);
    if (ry == 0) {
      if (rx == 1) {
        x = side - 1 - x;
        y = side - 1 - y;
      }
      std::swap(x, y);
    }
  }
  return distance;
}

int morton_distance(int x, int y) {
  int distance = 0;
  for (int bit = 0; bit < 12; ++bit) {
    distance |= (x >> bit & 1) << 2 * bit | (y >> bit & 1) << (2 * bit + 1);
  }
  return distance;
}

/// The side of the least aligned square of a power of two that holds the cells, by trying all.
int aligned_side(const PixelRect& c) {
  int side = 1;
  while (c.x_first / side != c.x_last / side || c.y_first / side != c.y_last / side) {
    side *= 2;
  }
  return side;
}

Places all_cells(const PixelRect& cells) {
  Places places;
  for (int y = cells.y_first; y <= cells.y_last; ++y) {
    for (int x = cells.x_first; x <= cells.x_last; ++x) {
      places.emplace_back(x, y);
    }
  }
  return places;
}

/// Cells that three random lines leave, and what they say of the others.
struct Lines {
  struct Line {
    int a, b, c;
  };
  std::vector<Line> lines;

  explicit Lines(Random& random) {
    for (int i = 0; i < 3; ++i) {
      const auto slope = [&] { return static_cast<int>(random.between(-6, 6)); };
      lines.push_back({slope(), slope(), static_cast<int>(random.between(-40, 60))});
    }
  }
  [[nodiscard]] bool has(int x, int y) const {
    return std::ranges::all_of(lines, [&](const Line& l) { return l.a * x + l.b * y + l.c >= 0; });
  }
  [[nodiscard]] RowSides sides(const GridPlace& at) const {
    RowSides found;
    for (const Line& l : lines) {
      const bool out = l.a * at.x + l.b * at.y + l.c < 0;
      found.none_left |= out && l.a >= 0;
      found.none_right |= out && l.a <= 0;
    }
    return found;
  }
};

struct Led {
  Places decided;
  Places passed;
};

Led led_walk(WalkOrder order, const PixelRect& cells, const auto& sides) {
  Led led;
  for (RowWalk each(order, cells); !each.done();) {
    const RowSides found = sides(each.at());
    (each.passes(found) ? led.passed : led.decided).emplace_back(each.at().x, each.at().y);
    each.advance(found);
  }
  return led;
}

/// What a picture of rows says of its cells: '#' is a cell of the triangle.
auto sides_of(const std::vector<std::string>& picture) {
  return [picture](const GridPlace& at) {
    const std::string& row = picture.at(static_cast<std::size_t>(at.y));
    const auto x = static_cast<std::size_t>(at.x);
    const bool inside = row.at(x) == '#';
    return RowSides{.none_left = !inside && row.rfind('#', x) == std::string::npos,
                    .none_right = !inside && row.find('#', x) == std::string::npos};
  };
}

}  // namespace

TEST_CASE("cell walk: curves go through the cells of any rectangle by the distance along the curve") {
  for (const PixelRect& cells :
       {PixelRect{0, 0, 15, 15}, PixelRect{0, 0, 0, 0}, PixelRect{7, 7, 8, 8}, PixelRect{3, 0, 3, 40},
        PixelRect{31, 5, 33, 6}, PixelRect{100, 200, 140, 203}}) {
    CAPTURE(cells.x_first, cells.y_first, cells.x_last, cells.y_last);
    const int side = aligned_side(cells);
    Places sorted = all_cells(cells);
    std::ranges::sort(sorted, {}, [](const auto& c) { return morton_distance(c.first, c.second); });
    CHECK(walk(WalkOrder::kMorton, cells) == sorted);
    std::ranges::sort(sorted, {},
                      [&](const auto& c) { return hilbert_distance(side, c.first % side, c.second % side); });
    CHECK(walk(WalkOrder::kHilbert, cells) == sorted);
  }
}

TEST_CASE("cell walk: every rectangle in a square of 8 x 8 cells, each cell once") {
  for (int place = 0; place < 8 * 8 * 8 * 8; ++place) {
    const PixelRect cells{place & 7, place >> 3 & 7, place >> 6 & 7, place >> 9};
    if (cells.empty()) {
      continue;
    }
    const Places all = all_cells(cells);
    for (const WalkOrder order :
         {WalkOrder::kRaster, WalkOrder::kBoustrophedonic, WalkOrder::kMorton, WalkOrder::kHilbert}) {
      Places walked = walk(order, cells);
      REQUIRE((order != WalkOrder::kRaster || walked == all));
      std::ranges::sort(walked, {}, [](const auto& c) { return std::pair(c.second, c.first); });
      REQUIRE(walked == all);
    }
  }
}

TEST_CASE("cell walk: one step to a neighbour along Hilbert's curve and back and forth") {
  const auto largest_step = [](const Places& places) {
    int most = 0;
    for (std::size_t i = 1; i < places.size(); ++i) {
      most = std::max(most, std::abs(places[i].first - places[i - 1].first) +
                                std::abs(places[i].second - places[i - 1].second));
    }
    return most;
  };
  CHECK(largest_step(walk(WalkOrder::kHilbert, {32, 64, 63, 95})) == 1);
  CHECK(largest_step(walk(WalkOrder::kBoustrophedonic, {3, 5, 20, 9})) == 1);
  CHECK(largest_step(walk(WalkOrder::kMorton, {0, 0, 31, 31})) == 31 + 1);  // from (31, 15) to (0, 16)
}

TEST_CASE("cell walk: the places of a square are those of the walk through it") {
  for (const auto& [order, cells] : {std::pair(TileOrder::kRaster, WalkOrder::kRaster),
                                     std::pair(TileOrder::kBoustrophedonic, WalkOrder::kBoustrophedonic),
                                     std::pair(TileOrder::kMorton, WalkOrder::kMorton),
                                     std::pair(TileOrder::kHilbert, WalkOrder::kHilbert)}) {
    for (const int side : {2, 4, 8}) {
      Places places;
      for (int n = 0; n < side * side; ++n) {
        places.emplace_back(place_in_order(order, side, n).x, place_in_order(order, side, n).y);
      }
      CHECK(places == walk(cells, {0, 0, side - 1, side - 1}));
      CHECK(order_in_square(cells) == order);
    }
  }
}

TEST_CASE("cell walk: led walks decide every cell that three lines leave, none twice", "[property]") {
  Random random(seed());
  for (std::uint64_t n = samples(1'000'000) / 50; n > 0; --n) {
    const Lines lines(random);
    const int x = static_cast<int>(random.between(0, 20));
    const int y = static_cast<int>(random.between(0, 20));
    const PixelRect cells{x, y, static_cast<int>(random.between(x, 20)),
                          static_cast<int>(random.between(y, 20))};
    for (const WalkOrder order : {WalkOrder::kBacktracking, WalkOrder::kZigzag}) {
      const Led led = led_walk(order, cells, [&](const GridPlace& at) { return lines.sides(at); });
      std::map<std::pair<int, int>, int> decided;
      for (const auto& each : led.decided) {
        REQUIRE(++decided[each] == 1);
      }
      for (const auto& each : all_cells(cells)) {
        REQUIRE((!lines.has(each.first, each.second) || decided.contains(each)));
      }
      // no cell is passed twice, and one that has no row is left at once
      REQUIRE(led.passed.size() <= all_cells(cells).size());
    }
  }
}

TEST_CASE("cell walk: backtracking goes left without a decision, then right to the first cell outside") {
  const std::vector<std::string> picture{"...#..", "..###.", "######", ".##...", "......", "....##"};
  const Led led = led_walk(WalkOrder::kBacktracking, {0, 0, 5, 5}, sides_of(picture));
  CHECK(led.decided == Places{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0},          // from the left of the bounds
                              {1, 1}, {2, 1}, {3, 1}, {4, 1}, {5, 1},          // below (3, 0)
                              {0, 2}, {1, 2}, {2, 2}, {3, 2}, {4, 2}, {5, 2},  // below (2, 1)
                              {0, 3}, {1, 3}, {2, 3}, {3, 3},                  // below (0, 2): outside
                              {1, 4},                                          // nothing on either side
                              {1, 5}, {2, 5}, {3, 5}, {4, 5}, {5, 5}});
  CHECK(led.passed == Places{{3, 1}, {2, 1}, {2, 2}, {1, 2}});
}

TEST_CASE("cell walk: zigzag goes left from the entry, then right from beside it") {
  const std::vector<std::string> picture{"...#..", "..###.", "######", ".##...", "......", "....##"};
  const Led led = led_walk(WalkOrder::kZigzag, {0, 0, 5, 5}, sides_of(picture));
  CHECK(led.decided == Places{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0},          // a search to the right
                              {3, 1}, {2, 1}, {1, 1}, {4, 1}, {5, 1},          // both ways from (3, 1)
                              {3, 2}, {2, 2}, {1, 2}, {0, 2}, {4, 2}, {5, 2},  // to both ends of the bounds
                              {3, 3}, {2, 3}, {1, 3}, {0, 3},                  // a search to the left
                              {2, 4},                                          // nothing on either side
                              {2, 5}, {3, 5}, {4, 5}, {5, 5}});
  CHECK(led.passed.empty());
}
