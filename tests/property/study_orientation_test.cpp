// The orientation grids of Kettner, Mehlhorn, Pion, Schirra and Yap 2008: formulas for the exact signs, the
// kinds of failure that the paper shows, and none of them in the pipeline.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <utility>

#include "halfspace/study/orientation/grid.hpp"
#include "halfspace/study/orientation/pipeline_orientation.hpp"
#include "random.hpp"

namespace halfspace::study {
namespace {

int sign(double value) { return (value > 0) - (value < 0); }

constexpr std::array kPivots{Pivot::kP, Pivot::kQ, Pivot::kR};

}  // namespace

TEST_CASE("orientation: exact and rounded agree where nothing is rounded", "[property]") {
  CHECK(exact_orientation({{{0, 0}, {1, 0}, {0, 1}}}) == 1);
  CHECK(exact_orientation({{{0, 0}, {0, 1}, {1, 0}}}) == -1);
  CHECK(exact_orientation({{{-3, -7}, {0, 0}, {6, 14}}}) == 0);
  testing::Random random(testing::seed());
  for (int n = 0; n < 10'000; ++n) {
    Triple points;
    for (Point& p : points) {
      p = {static_cast<double>(random.between(-8, 8)), static_cast<double>(random.between(-8, 8))};
    }
    const auto& [p, q, r] = points;
    const int expected = sign((q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x));
    REQUIRE(exact_orientation(points) == expected);
    for (const Pivot pivot : kPivots) {
      REQUIRE(rounded_orientation<double>(points, pivot) == expected);
      REQUIRE(rounded_orientation<float>(points, pivot) == expected);
    }
  }
}

TEST_CASE("orientation: the exact sign is that of y - x where q and r are on the diagonal", "[property]") {
  for (const Setting& setting : {settings()[0], settings()[2]}) {
    for (const Grid& grid : {double_grid(setting), float_grid(setting)}) {
      REQUIRE(grid.points[1].x == grid.points[1].y);
      REQUIRE(grid.points[2].x == grid.points[2].y);
      const Values exact = over(grid, exact_orientation);
      for (int y = 0; y < kGridSide; ++y) {
        for (int x = 0; x < kGridSide; ++x) {
          REQUIRE(exact[static_cast<std::size_t>(y * kGridSide + x)] == sign(y - x));
        }
      }
    }
  }
}

TEST_CASE("orientation: double fails as in figure 2 of the paper, by another amount from each pivot",
          "[property]") {
  for (const Setting& setting : settings()) {
    CAPTURE(setting.name);
    const Grid grid = double_grid(setting);
    const Values exact = over(grid, exact_orientation);
    std::map<int, int> amounts;
    for (const Pivot pivot : kPivots) {
      const Values signs = over(grid, [&](const Triple& t) { return rounded_orientation<double>(t, pivot); });
      ++amounts[errors(exact, signs).all()];
    }
    CHECK(amounts.size() == 3);
    const Values seen_from_p =
        over(grid, [](const Triple& t) { return rounded_orientation<double>(t, Pivot::kP); });
    CHECK(errors(exact, seen_from_p).false_zero > 0);
    CHECK(errors(exact, seen_from_p).opposite > 0);
    const Values owners = over(grid, rounded_owners<double>);
    CHECK(std::count(owners.begin(), owners.end(), 0) > 0);
    CHECK(std::count(owners.begin(), owners.end(), 2) > 0);
  }
}

TEST_CASE("orientation: the pipeline snaps to the nearest place and errs nowhere", "[property]") {
  for (const Setting& setting : settings()) {
    CAPTURE(setting.name);
    const Grid grid = float_grid(setting);
    const std::vector<Snapped> all = snapped(grid);
    REQUIRE(all.size() == std::size_t{kGridSide} * kGridSide);
    std::map<std::pair<std::int64_t, std::int64_t>, SnappedTriple> places;
    for (int y = 0; y < kGridSide; ++y) {
      for (int x = 0; x < kGridSide; ++x) {
        const Snapped& each = all[static_cast<std::size_t>(y * kGridSide + x)];
        const Triple points = grid.at(x, y);
        Triple on_grid;
        for (std::size_t i = 0; i < 3; ++i) {
          const double scale = kPixels * std::ldexp(1.0, kSubPixelBits);
          on_grid[i] = {std::nearbyint(points[i].x * scale), std::nearbyint(points[i].y * scale)};
          REQUIRE(static_cast<double>(each.points[i].x) == on_grid[i].x);
          REQUIRE(static_cast<double>(each.points[i].y) == on_grid[i].y);
        }
        REQUIRE(each.orientation == exact_orientation(on_grid));
        places[{each.points[0].x, each.points[0].y}] = each.points;
      }
    }
    CHECK(places.size() == 25);  // 256 steps of 2^-24 are 4 sub-pixels
    for (const auto& [place, points] : places) {
      CHECK(covered(points) == 1);
    }
  }
}

}  // namespace halfspace::study
