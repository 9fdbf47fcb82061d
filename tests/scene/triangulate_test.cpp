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

}  // namespace

TEST_CASE("a convex polygon becomes a fan") {
  const std::vector<glm::dvec3> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  std::vector<std::uint32_t> triangles{7};
  REQUIRE(triangulate(all_corners(4), points, triangles));
  CHECK(triangles == std::vector<std::uint32_t>{7, 0, 1, 2, 0, 2, 3});
}

TEST_CASE("a polygon that is not convex is covered exactly, whichever way it faces") {
  const std::vector<glm::vec2> arrow{{0, 0}, {4, 0}, {1, 1}, {0, 4}};  // area 4
  const std::vector<glm::vec2> comb{{0, 0}, {6, 0}, {6, 3}, {5, 1},
                                    {4, 3}, {3, 1}, {2, 3}, {1, 1}};  // area 10.5
  for (const auto& [shape, expected] : {std::pair{arrow, 4.0f}, std::pair{comb, 10.5f}}) {
    for (std::size_t start = 0; start < shape.size(); ++start) {
      for (int axis = 0; axis < 3; ++axis) {
        std::vector<glm::dvec3> front;
        for (std::size_t i = 0; i < shape.size(); ++i) {
          const glm::vec2 p = shape[(start + i) % shape.size()];
          glm::dvec3 q(3);
          q[(axis + 1) % 3] = p.x;
          q[(axis + 2) % 3] = p.y;
          front.push_back(q);
        }
        glm::dvec3 normal(0);
        normal[axis] = 1;
        check_cover(front, normal, expected);
        check_cover({front.rbegin(), front.rend()}, -normal, expected);
      }
    }
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
