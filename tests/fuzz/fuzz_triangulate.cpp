#include <cstdlib>
#include <cstring>
#include <glm/vec3.hpp>
#include <vector>

#include "../seamless.hpp"
#include "halfspace/scene/triangulate.hpp"

namespace {

struct Polygon {
  std::vector<glm::dvec3> positions;
  std::vector<std::uint32_t> corners;

  void add(double x, double y, double z) {
    corners.push_back(static_cast<std::uint32_t>(positions.size()));
    positions.emplace_back(x, y, z);
  }
};

/// Twice the signed area in the plane of x and y.
double twice_area(const Polygon& polygon, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  const glm::dvec3 u = polygon.positions[b] - polygon.positions[a];
  const glm::dvec3 v = polygon.positions[c] - polygon.positions[a];
  return u.x * v.y - u.y * v.x;
}

/// The triangles, which must fill the polygon without a seam.
std::vector<std::uint32_t> triangles_of(const Polygon& polygon) {
  std::vector<std::uint32_t> triangles;
  if (!halfspace::triangulate(polygon.corners, polygon.positions, triangles)) std::abort();
  if (triangles.size() != 3 * (polygon.corners.size() - 2)) std::abort();
  if (!halfspace::testing::is_seamless(polygon.corners, triangles)) std::abort();
  return triangles;
}

}  // namespace

// After a zero a lattice polygon, two bytes a corner: the areas of the triangles add up to its own. After any
// other byte three doubles a corner, any doubles.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Polygon polygon;
  const bool lattice = size > 0 && data[0] == 0;
  const std::size_t step = lattice ? 2 : 3 * sizeof(double);
  for (std::size_t at = 1; at + step <= size; at += step) {
    if (lattice) {
      polygon.add(data[at], data[at + 1], 0);
    } else {
      double p[3];
      std::memcpy(p, data + at, sizeof p);
      polygon.add(p[0], p[1], p[2]);
    }
  }
  if (polygon.corners.size() < 3) return 0;
  const std::vector<std::uint32_t> triangles = triangles_of(polygon);
  if (!lattice) return 0;
  double area = 0;
  for (std::uint32_t i = 1; i + 1 < polygon.corners.size(); ++i) area += twice_area(polygon, 0, i, i + 1);
  for (std::size_t i = 0; i < triangles.size(); i += 3) {
    area -= twice_area(polygon, triangles[i], triangles[i + 1], triangles[i + 2]);
  }
  if (area != 0) std::abort();  // integers of less than 30 bits: exact
  return 0;
}
