/// How far a surface of triangles is from another: a bound that holds at every point, not only at vertices.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace halfspace::whatif {

using Corners = std::array<glm::dvec3, 3>;

/// Squared distance of a point to a triangle. NaN where the triangle is degenerate and the nearest point of
/// it does not follow from its corners alone.
[[nodiscard]] double squared_distance(const glm::dvec3& point, const Corners& triangle);

/// Triangles, found by place: a tree of boxes.
class SurfaceTree {
 public:
  explicit SurfaceTree(std::vector<Corners> triangles);

  /// True only if every point of `piece` lies within `limit` of the surface: where its corners are within it
  /// of one triangle, the whole piece is, for the distance to a convex set is a convex function. Else the
  /// piece is halved at its longest side, down to an eighth of the limit. So where it says no, the farthest
  /// point may still be closer than the limit, by up to an eighth of it.
  [[nodiscard]] bool holds_within(const Corners& piece, double limit) const;

 private:
  struct Node {
    glm::dvec3 low;
    glm::dvec3 high;
    std::uint32_t first = 0;  ///< triangles of a leaf
    std::uint32_t count = 0;
    std::uint32_t right = 0;  ///< the other child; the left one is the next node. 0: a leaf
  };

  std::uint32_t build(std::uint32_t first, std::uint32_t last);
  [[nodiscard]] bool one_holds(const Corners& piece, double limit) const;

  std::vector<Corners> triangles_;
  std::vector<Node> nodes_;
};

/// True only if every point of each surface lies within `limit` of the other, the Hausdorff distance.
[[nodiscard]] bool within(std::span<const Corners> a, std::span<const Corners> b, double limit);

}  // namespace halfspace::whatif
