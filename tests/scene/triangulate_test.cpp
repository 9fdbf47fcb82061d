// Do the triangles cover the polygon, once, in its winding?
#include "halfspace/scene/triangulate.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numeric>

using namespace halfspace;

namespace {

std::vector<std::uint32_t> all_corners(std::size_t count) {
  std::vector<std::uint32_t> polygon(count);
  std::iota(polygon.begin(), polygon.end(), 0u);
  return polygon;
}

glm::dvec3 area(const std::vector<glm::dvec3>& p, const std::vector<std::uint32_t>& t, std::size_t at) {
  return glm::cross(p[t[at + 1]] - p[t[at]], p[t[at + 2]] - p[t[at]]) / 2.0;
}

/// All triangles face along `normal` and their areas sum to the polygon's.
void check_cover(const std::vector<glm::dvec3>& points, glm::dvec3 normal, double expected_area) {
  std::vector<std::uint32_t> triangles;
  REQUIRE(triangulate(all_corners(points.size()), points, triangles));
  REQUIRE(triangles.size() == 3 * (points.size() - 2));
  double sum = 0;
  for (std::size_t i = 0; i < triangles.size(); i += 3) {
    const double along = glm::dot(area(points, triangles, i), normal);
    CHECK(along >= 0);
    sum += along;
  }
  CHECK(sum == Approx(expected_area));
}

/// However it starts, winds and faces.
void check_every_way(const std::vector<glm::dvec2>& shape, double expected_area) {
  for (std::size_t start = 0; start < shape.size(); ++start) {
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<glm::dvec3> front;
      for (std::size_t i = 0; i < shape.size(); ++i) {
        const glm::dvec2 p = shape[(start + i) % shape.size()];
        glm::dvec3 q(3);
        q[(axis + 1) % 3] = p.x;
        q[(axis + 2) % 3] = p.y;
        front.push_back(q);
      }
      glm::dvec3 normal(0);
      normal[axis] = 1;
      CAPTURE(start, axis);
      check_cover(front, normal, expected_area);
      check_cover({front.rbegin(), front.rend()}, -normal, expected_area);
    }
  }
}

}  // namespace

TEST_CASE("a convex polygon becomes a fan") {
  const std::vector<glm::dvec3> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  std::vector<std::uint32_t> triangles{7};
  REQUIRE(triangulate(all_corners(4), points, triangles));
  CHECK(triangles == std::vector<std::uint32_t>{7, 0, 1, 2, 0, 2, 3});
}

TEST_CASE("a polygon that is not convex is covered exactly, whichever way it faces") {
  check_every_way({{0, 0}, {4, 0}, {1, 1}, {0, 4}}, 4);
  check_every_way({{0, 0}, {6, 0}, {6, 3}, {5, 1}, {4, 3}, {3, 1}, {2, 3}, {1, 1}}, 10.5);
}

TEST_CASE("a polygon that touches itself is covered once") {
  struct Shape {
    const char* name;
    std::vector<glm::dvec2> points;
    double area;
  };
  const std::vector<Shape> shapes{
      {"keyhole", {{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}, {3, 3}, {3, 6}, {6, 6}, {6, 3}, {3, 3}}, 72},
      {"keyhole along an edge",
       {{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 3}, {3, 3}, {3, 6}, {6, 6}, {6, 3}, {0, 3}},
       72},
      {"two holes, one bridge",
       {{0, 0},
        {9, 0},
        {9, 9},
        {0, 9},
        {0, 4},
        {2, 4},
        {3, 6},
        {4, 4},
        {6, 4},
        {7, 6},
        {8, 4},
        {7, 2},
        {6, 4},
        {4, 4},
        {3, 2},
        {2, 4},
        {0, 4}},
       73},
      {"pinch at a corner", {{0, 0}, {4, 0}, {2, 2}, {4, 4}, {0, 4}, {2, 2}}, 8},
      {"hole that touches a corner", {{0, 0}, {6, 0}, {6, 6}, {0, 6}, {0, 0}, {2, 4}, {4, 4}, {4, 2}}, 28},
      {"hole that touches an edge", {{0, 0}, {3, 0}, {2, 3}, {4, 3}, {3, 0}, {6, 0}, {6, 6}, {0, 6}}, 33},
      {"whisker outwards", {{0, 0}, {4, 0}, {4, 2}, {7, 2}, {4, 2}, {4, 4}, {0, 4}}, 16},
      {"whisker inwards", {{0, 0}, {4, 0}, {4, 2}, {1, 2}, {4, 2}, {4, 4}, {0, 4}}, 16},
      {"whisker with a bend and a fork",
       {{0, 0}, {4, 0}, {4, 2}, {6, 2}, {7, 4}, {6, 2}, {7, 0}, {6, 2}, {4, 2}, {4, 4}, {0, 4}},
       16},
      {"whisker along an edge", {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {4, 4}, {4, 1}, {4, 4}, {0, 4}}, 16},
      {"bridge with a bend",
       {{0, 0}, {2, 0}, {2, 2}, {4, 4}, {6, 2}, {8, 2}, {8, 0}, {9, 3}, {6, 2}, {4, 4}, {2, 2}, {0, 2}},
       6},
      {"bends before a room to the left",
       {{0, 0},
        {1, 0},
        {1, 1},
        {41, 1},
        {41, 41},
        {21, 41},
        {21, 1},
        {1, 1},
        {1, 0},
        {0, 0},
        {-20, 20},
        {-20, -20}},
       1200},
      {"bends before a room to the right",
       {{0, 0},
        {1, 0},
        {1, 1},
        {21, 1},
        {21, -39},
        {41, -39},
        {41, 1},
        {1, 1},
        {1, 0},
        {0, 0},
        {-20, 20},
        {-20, -20}},
       1200},
      {"slit inside of a slit", {{0, 0}, {8, 0}, {8, 4}, {2, 4}, {6, 4}, {4, 4}, {8, 4}, {8, 8}, {0, 8}}, 64},
      {"corners that repeat", {{0, 0}, {0, 0}, {4, 0}, {1, 1}, {1, 1}, {1, 1}, {0, 4}, {0, 4}}, 4},
      {"flat corners", {{0, 0}, {2, 0}, {4, 0}, {3, 0.75}, {2, 1.5}, {1, 2.25}, {0, 3}, {1, 1}, {0, 1}}, 5},
      {"only whiskers", {{0, 0}, {4, 0}, {0, 0}, {0, 4}, {0, 0}, {-3, -3}}, 0},
      {"a line", {{0, 0}, {3, 3}, {1, 1}, {5, 5}, {2, 2}}, 0}};
  for (const Shape& shape : shapes) {
    CAPTURE(shape.name);
    check_every_way(shape.points, shape.area);
  }
}

TEST_CASE("no size of coordinates is too large or too small") {
  const std::vector<glm::dvec2> arrow{{0, 0}, {4, 0}, {1, 1}, {0, 4}};
  for (const int log2 : {-1074, -1000, -500, 0, 500, 1021}) {
    std::vector<glm::dvec3> points;
    points.reserve(arrow.size());
    for (const glm::dvec2& p : arrow) points.emplace_back(std::ldexp(p.x, log2), std::ldexp(p.y, log2), 0);
    std::vector<std::uint32_t> triangles;
    REQUIRE(triangulate(all_corners(4), points, triangles));
    CAPTURE(log2);
    CHECK(triangles == std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3});
  }
}

TEST_CASE("degenerate and self-crossing polygons still give n - 2 triangles") {
  const std::vector<std::vector<glm::dvec3>> shapes{
      {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}},
      {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {1, 0, 0}},
      {{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2.5f, 0}},
      {{0, 0, 0}, {NAN, 0, 0}, {2, 0, 0}, {0, INFINITY, 0}},
      {{0, 3, 0}, {2, -3, 0}, {-3, 1, 0}, {3, 1, 0}, {-2, -3, 0}}};
  for (const std::vector<glm::dvec3>& points : shapes) {
    std::vector<std::uint32_t> triangles;
    CHECK(triangulate(all_corners(points.size()), points, triangles));
    CHECK(triangles.size() == 3 * (points.size() - 2));
  }
}

TEST_CASE("only a polygon that is not convex is limited in its corners") {
  std::vector<glm::dvec3> points;
  for (std::size_t i = 0; i < kMaxConcaveCorners + 1; ++i) {
    const double angle = 6.283185307 * static_cast<double>(i) / (kMaxConcaveCorners + 1);
    points.emplace_back(std::cos(angle), std::sin(angle), 0);
  }
  std::vector<std::uint32_t> triangles;
  CHECK(triangulate(all_corners(points.size()), points, triangles));
  triangles.clear();
  points[5] *= 0.5f;
  CHECK_FALSE(triangulate(all_corners(points.size()), points, triangles));
  CHECK(triangles.empty());
  points.pop_back();
  CHECK(triangulate(all_corners(points.size()), points, triangles));
  CHECK(triangles.size() == 3 * (points.size() - 2));
}
