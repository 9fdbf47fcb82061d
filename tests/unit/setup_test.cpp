// setup: edge equations, bounds and culling follow their formulas.
#include "halfspace/units/setup.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>

#include "../triangles.hpp"

using namespace halfspace;
using namespace halfspace::testing;

namespace {

/// Vertex on the centre of pixel (x, y).
ScreenVertex at_centre(int x, int y, std::uint32_t z = 0) { return {x * 256 + 128, y * 256 + 128, z}; }

/// E at the centre of pixel (x, y), fill rule included.
std::int64_t value(const Edge& e, int x, int y) {
  return e.c + ((std::int64_t{e.a} * x + std::int64_t{e.b} * y) << 8);
}

bool same(const SetupTriangle& l, const SetupTriangle& r) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (l.edge[i].a != r.edge[i].a || l.edge[i].b != r.edge[i].b || l.edge[i].c != r.edge[i].c) {
      return false;
    }
  }
  return l.bounds.x_first == r.bounds.x_first && l.bounds.x_last == r.bounds.x_last &&
         l.bounds.y_first == r.bounds.y_first && l.bounds.y_last == r.bounds.y_last &&
         l.depth.z == r.depth.z && l.depth.reciprocal == r.depth.reciprocal && l.depth.area2 == r.depth.area2;
}

}  // namespace

TEST_CASE("setup: each edge is 0 on its own vertices and twice the area on the opposite one") {
  const ScreenTriangle t{{at_centre(3, 2), at_centre(40, 11), at_centre(9, 30)}, 7};
  SetupTriangle out;
  REQUIRE(setup(t, open_state(64), out) == SetupVerdict::kDrawn);
  const std::int64_t area2 = std::int64_t{37 * 256} * (28 * 256) - std::int64_t{6 * 256} * (9 * 256);
  CHECK(out.depth.area2 == area2);
  CHECK(out.triangle == 7);
  const int x[] = {3, 40, 9};  // the first vertex is the topmost already
  const int y[] = {2, 11, 30};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(value(out.edge[i], x[k], y[k]) + out.depth.bias[i] == (i == k ? area2 : 0));
    }
  }
}

TEST_CASE("setup: of a square the sides own their samples that the rule names") {
  // a square of two triangles on pixel centres; its sides are exactly one of each kind
  const ScreenTriangle upper{{at_centre(0, 0), at_centre(8, 0), at_centre(0, 8)}, 0};
  const ScreenTriangle lower{{at_centre(8, 0), at_centre(8, 8), at_centre(0, 8)}, 0};
  for (const FillRule rule : kFillRules) {
    SetupState state = open_state(64);
    state.fill_rule = rule;
    int covered[10][10] = {};
    for (const ScreenTriangle& t : {upper, lower}) {
      SetupTriangle out;
      REQUIRE(setup(t, state, out) == SetupVerdict::kDrawn);
      for (int y = 0; y < 10; ++y) {
        for (int x = 0; x < 10; ++x) {
          covered[y][x] +=
              value(out.edge[0], x, y) >= 0 && value(out.edge[1], x, y) >= 0 && value(out.edge[2], x, y) >= 0;
        }
      }
    }
    for (int y = 0; y < 10; ++y) {
      for (int x = 0; x < 10; ++x) {
        const bool bottom = rule == FillRule::kBottomLeft || rule == FillRule::kBottomRight;
        const bool right = rule == FillRule::kTopRight || rule == FillRule::kBottomRight;
        const bool row = bottom ? y > 0 && y <= 8 : y < 8;
        const bool column = right ? x > 0 && x <= 8 : x < 8;
        CHECK(covered[y][x] == (row && column ? 1 : 0));
      }
    }
  }
}

TEST_CASE("setup: bounds are the pixels whose centres the box holds, cut by the scissor") {
  SetupState state = open_state(64);
  SetupTriangle out;
  SECTION("a centre exactly on the box counts") {
    REQUIRE(setup({{at_centre(2, 3), at_centre(9, 3), at_centre(2, 12)}, 0}, state, out) ==
            SetupVerdict::kDrawn);
    CHECK((out.bounds.x_first == 2 && out.bounds.x_last == 9 && out.bounds.y_first == 3 &&
           out.bounds.y_last == 12));
  }
  SECTION("one sub-pixel less and it does not") {
    const ScreenTriangle t{
        {ScreenVertex{2 * 256 + 129, 3 * 256 + 129, 0}, ScreenVertex{9 * 256 + 127, 3 * 256 + 129, 0},
         ScreenVertex{2 * 256 + 129, 12 * 256 + 127, 0}},
        0};
    REQUIRE(setup(t, state, out) == SetupVerdict::kDrawn);
    CHECK((out.bounds.x_first == 3 && out.bounds.x_last == 8 && out.bounds.y_first == 4 &&
           out.bounds.y_last == 11));
  }
  SECTION("the scissor cuts") {
    state.bounds = {.x_first = 5, .y_first = 6, .x_last = 7, .y_last = 20};
    REQUIRE(setup({{at_centre(2, 3), at_centre(30, 3), at_centre(2, 40)}, 0}, state, out) ==
            SetupVerdict::kDrawn);
    CHECK((out.bounds.x_first == 5 && out.bounds.x_last == 7 && out.bounds.y_first == 6 &&
           out.bounds.y_last == 20));
  }
  SECTION("negative coordinates round down") {
    REQUIRE(setup({{at_centre(-20, -3), at_centre(9, -3), at_centre(2, 12)}, 0}, state, out) ==
            SetupVerdict::kDrawn);
    CHECK((out.bounds.x_first == 0 && out.bounds.y_first == 0));
  }
}

TEST_CASE("setup: names why a triangle is dropped") {
  SetupState state = open_state(64);
  SetupTriangle out;
  const ScreenTriangle clockwise{{at_centre(0, 0), at_centre(8, 0), at_centre(0, 8)}, 0};
  const ScreenTriangle counter{{at_centre(0, 0), at_centre(0, 8), at_centre(8, 0)}, 0};
  SECTION("facing") {
    for (const bool positive_is_front : {false, true}) {
      for (const bool cull_front : {false, true}) {
        for (const bool cull_back : {false, true}) {
          state.front_positive_area = positive_is_front;
          state.cull_front = cull_front;
          state.cull_back = cull_back;
          const bool clockwise_culled = positive_is_front ? cull_front : cull_back;
          const bool counter_culled = positive_is_front ? cull_back : cull_front;
          CHECK((setup(clockwise, state, out) == SetupVerdict::kCulled) == clockwise_culled);
          CHECK((setup(counter, state, out) == SetupVerdict::kCulled) == counter_culled);
        }
      }
    }
  }
  SECTION("no area") {
    CHECK(setup({{at_centre(0, 0), at_centre(4, 4), at_centre(9, 9)}, 0}, state, out) ==
          SetupVerdict::kZeroArea);
  }
  SECTION("between the centres") {
    const ScreenTriangle t{{ScreenVertex{130, 130, 0}, ScreenVertex{380, 130, 0}, ScreenVertex{130, 380, 0}},
                           0};
    CHECK(setup(t, state, out) == SetupVerdict::kNoSample);
  }
  SECTION("beside the target") {
    CHECK(setup({{at_centre(64, 0), at_centre(80, 0), at_centre(64, 8)}, 0}, state, out) ==
          SetupVerdict::kOutside);
    CHECK(setup({{at_centre(-9, 0), at_centre(-1, 0), at_centre(-9, 8)}, 0}, state, out) ==
          SetupVerdict::kOutside);
  }
}

TEST_CASE("setup: the order of the vertices changes nothing") {
  TriangleSource source(1, 64, 8);
  const SetupState state = open_state(64);
  for (int n = 0; n < 2000; ++n) {
    ScreenTriangle t = source.next();
    std::array<std::size_t, 3> order{0, 1, 2};
    SetupTriangle first;
    const SetupVerdict verdict = setup(t, state, first);
    do {
      SetupTriangle out;
      REQUIRE(setup({{t.v[order[0]], t.v[order[1]], t.v[order[2]]}, t.triangle}, state, out) == verdict);
      REQUIRE((verdict != SetupVerdict::kDrawn || same(first, out)));
    } while (std::next_permutation(order.begin(), order.end()));
  }
}

TEST_CASE("setup: fits its widths at the ends of the guard band") {
  const Widths widths;
  const int far = 32767 * 256;
  const std::array<ScreenVertex, 4> corner{{{-far, -far, 0}, {far, -far, 0}, {far, far, 0}, {-far, far, 0}}};
  for (std::size_t skip = 0; skip < 4; ++skip) {
    const ScreenTriangle t{{corner[(skip + 1) % 4], corner[(skip + 2) % 4], corner[(skip + 3) % 4]}, 0};
    SetupTriangle out;
    REQUIRE(setup(t, open_state(16384), out) == SetupVerdict::kDrawn);
    for (const Edge& edge : out.edge) {
      CHECK(std::abs(std::int64_t{edge.a}) < std::int64_t{1} << (widths.StepBits - 1));
      CHECK(std::abs(std::int64_t{edge.b}) < std::int64_t{1} << (widths.StepBits - 1));
      for (const int x : {-32767, 0, 16383 + 64, 32767}) {
        for (const int y : {-32767, 0, 16383 + 64, 32767}) {
          CHECK(std::abs(value(edge, x, y)) < std::int64_t{1} << (widths.EdgeBits - 1));
        }
      }
    }
  }
}
