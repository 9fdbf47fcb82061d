/// Finds the corners of a polygon that are near a triangle.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include "halfspace/numerics/orientation.hpp"

namespace halfspace {

/// A binary tree of bounding boxes over corners, each half of which has neighbours in space. Corners can be
/// put in and taken out.
class CornerTree {
 public:
  /// Without corners yet.
  explicit CornerTree(std::span<const glm::dvec2> points)
      : points_(points),
        corners_(points.size()),
        places_(points.size()),
        leaves_(std::bit_ceil(points.size())),
        boxes_(2 * leaves_) {
    std::iota(corners_.begin(), corners_.end(), std::uint32_t{0});
    order(0, leaves_, 0);
    for (std::uint32_t place = 0; place < points.size(); ++place) places_[corners_[place]] = place;
  }

  void insert(std::uint32_t corner) { set(places_[corner], {points_[corner], points_[corner]}); }
  void erase(std::uint32_t corner) { set(places_[corner], {}); }

  /// Calls visit(corner) for the corners in the closed triangle, and perhaps for others near it, until it
  /// returns false. The triangle winds counter-clockwise. Corners in the places of its own first and last are
  /// left out.
  template <class Visit>
  void visit_near(const std::array<glm::dvec2, 3>& triangle, const Visit& visit) const {
    const Box bounds{glm::min(glm::min(triangle[0], triangle[1]), triangle[2]),
                     glm::max(glm::max(triangle[0], triangle[1]), triangle[2])};
    std::array<std::size_t, 64> stack;  // one box waits on each level
    std::size_t waiting = 0;
    stack[waiting++] = 1;
    while (waiting > 0) {
      const std::size_t node = stack[--waiting];
      if (!meets(boxes_[node], bounds, triangle)) continue;
      if (node < leaves_) {
        stack[waiting++] = 2 * node + 1;
        stack[waiting++] = 2 * node;
      } else if (!visit(corners_[node - leaves_])) {
        return;
      }
    }
  }

 private:
  struct Box {  ///< empty unless told otherwise
    glm::dvec2 least{std::numeric_limits<double>::infinity()};
    glm::dvec2 most{-std::numeric_limits<double>::infinity()};
    bool operator==(const Box&) const = default;
  };

  /// Orders the corners of these places, of which the last may be empty, as a k-d tree: half of them to one
  /// side along this axis, half to the other, and so on along the other axis.
  void order(std::size_t first, std::size_t count, int axis) {
    const std::size_t last = std::min(first + count, corners_.size());
    if (first + 1 >= last) return;
    const std::size_t middle = first + count / 2;
    if (middle < last) {
      const auto at = [&](std::size_t place) {
        return corners_.begin() + static_cast<std::ptrdiff_t>(place);
      };
      std::nth_element(at(first), at(middle), at(last),
                       [&](std::uint32_t a, std::uint32_t b) { return points_[a][axis] < points_[b][axis]; });
    }
    order(first, count / 2, 1 - axis);
    order(middle, count / 2, 1 - axis);
  }

  void set(std::size_t place, const Box& box) {
    std::size_t node = leaves_ + place;
    boxes_[node] = box;
    while (node > 1) {
      node /= 2;
      const Box& one = boxes_[2 * node];
      const Box& other = boxes_[2 * node + 1];
      const Box both{glm::min(one.least, other.least), glm::max(one.most, other.most)};
      if (both == boxes_[node]) return;
      boxes_[node] = both;
    }
  }

  /// Not wholly beyond one side of the triangle's bounds, or of the triangle.
  static bool meets(const Box& box, const Box& bounds, const std::array<glm::dvec2, 3>& triangle) {
    if (box.least.x > bounds.most.x || box.least.y > bounds.most.y || box.most.x < bounds.least.x ||
        box.most.y < bounds.least.y) {
      return false;
    }
    if (box.least == box.most) return box.least != triangle[0] && box.least != triangle[2];
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec2 from = triangle[i];
      const glm::dvec2 to = triangle[(i + 1) % 3];
      const glm::dvec2 leftmost{to.y < from.y ? box.most.x : box.least.x,
                                to.x > from.x ? box.most.y : box.least.y};
      if (orientation(from, to, leftmost) < 0) return false;
    }
    return true;
  }

  std::span<const glm::dvec2> points_;
  std::vector<std::uint32_t> corners_;  ///< in each place
  std::vector<std::uint32_t> places_;   ///< of each corner
  std::size_t leaves_;
  std::vector<Box> boxes_;  ///< that of node i is the box of 2 i and 2 i + 1; 1 is the root, leaves come last
};

}  // namespace halfspace
