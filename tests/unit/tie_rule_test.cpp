// The tie rules, and what the normal-sign rule means under other conventions.
#include <array>
#include <catch2/catch.hpp>
#include <cstdint>
#include <vector>

#include "halfspace/reference/exact_triangle.hpp"
#include "halfspace/reference/rational_coverage.hpp"

namespace halfspace::testing {
namespace {

using reference::GridPoint;
using reference::GridTriangle;
using reference::TieRule;

/// A square of 4 x 4 pixels whose four edges run through pixel centres, as two triangles.
constexpr std::array<GridTriangle, 2> kSquare = {
    {{{{128, 128}, {1152, 128}, {1152, 1152}}}, {{{128, 128}, {1152, 1152}, {128, 1152}}}}};

/// The samples of a row or column of the square's middle that the rule gives it: the first of five, the last.
struct Ends {
  bool first;
  bool last;
  bool operator==(const Ends&) const = default;
};

template <class Covers>
Ends ends(bool column, const Covers& covers) {
  const auto covered = [&](std::int64_t i) {
    // Off the diagonal, on which both triangles have a say.
    const GridPoint sample = column ? reference::pixel_centre(2, i, 8) : reference::pixel_centre(i, 2, 8);
    return covers(kSquare[0], sample) != covers(kSquare[1], sample);
  };
  for (const std::int64_t i : {1, 2, 3}) CHECK(covered(i));
  return {covered(0), covered(4)};
}

/// The rule of the sign of the normal on a triangle as it comes: not turned, and with y up if wished.
bool covers_by_sign_unturned(const GridTriangle& t, const GridPoint& sample, bool y_up) {
  const std::int64_t up = y_up ? -1 : 1;
  const auto area = reference::twice_area(t[0], t[1], t[2]) * up;
  for (std::size_t i = 0; i < 3; ++i) {
    const GridPoint& from = t[i];
    const GridPoint& to = t[(i + 1) % 3];
    const std::int64_t a = up * (from.y - to.y);
    const std::int64_t b = to.x - from.x;
    const auto e = reference::twice_area(from, to, sample) * up;
    if (e == 0 ? !(a > 0 || (a == 0 && b > 0)) : (e > 0) != (area > 0)) return false;
  }
  return area != 0;
}

GridTriangle turned(const GridTriangle& t) { return {t[0], t[2], t[1]}; }

}  // namespace

TEST_CASE("tie rule: each names the edges that own their samples") {
  for (const auto& [rule, name] : reference::kTieRules) {
    CAPTURE(name);
    const bool left = name.find("right") == std::string_view::npos;
    const bool top = name.find("bottom") == std::string_view::npos;
    const auto exactly = [rule = rule](const GridTriangle& t, const GridPoint& sample) {
      return reference::covers(t, sample, rule);
    };
    const auto rationally = [rule = rule](const GridTriangle& t, const GridPoint& sample) {
      const reference::RationalTriangle r = {reference::rational_point(t[0], 8),
                                             reference::rational_point(t[1], 8),
                                             reference::rational_point(t[2], 8)};
      return reference::rational_covers(r, reference::rational_point(sample, 8), rule);
    };
    CHECK(ends(false, exactly) == Ends{left, !left});
    CHECK(ends(true, exactly) == Ends{top, !top});
    CHECK(ends(false, rationally) == Ends{left, !left});
    CHECK(ends(true, rationally) == Ends{top, !top});
  }
}

TEST_CASE("tie rule: the sign of the normal is top-left where triangles are turned and y is down") {
  for (std::int64_t a = -1; a <= 1; ++a) {
    for (std::int64_t b = -1; b <= 1; ++b) {
      if (a == 0 && b == 0) continue;
      CHECK(reference::owns_samples(a, b, TieRule::kNormalSign) ==
            reference::owns_samples(a, b, TieRule::kTopLeft));
    }
  }
}

TEST_CASE("tie rule: the sign of the normal under other conventions depends on winding and axis") {
  for (const bool y_up : {false, true}) {
    for (const bool clockwise : {false, true}) {
      CAPTURE(y_up, clockwise);
      const auto covers = [&](const GridTriangle& t, const GridPoint& sample) {
        return covers_by_sign_unturned(clockwise ? t : turned(t), sample, y_up);
      };
      // A triangle that comes with positive area, clockwise on the screen with y down, counter-clockwise with
      // y up, has A > 0 on its left edges; the other has it on its right edges. B > 0 is a top edge of the
      // first with y down and a bottom edge with y up.
      const bool left = clockwise != y_up;
      const bool top = clockwise;
      CHECK(ends(false, covers) == Ends{left, !left});
      CHECK(ends(true, covers) == Ends{top, !top});
    }
  }
}

}  // namespace halfspace::testing
