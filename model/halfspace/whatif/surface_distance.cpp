#include "halfspace/whatif/surface_distance.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <utility>

namespace halfspace::whatif {
namespace {

constexpr std::uint32_t kLeafTriangles = 4;
constexpr double kLeastPiece = 1.0 / 8;  // of the limit

glm::dvec3 low_of(const Corners& t) { return glm::min(t[0], glm::min(t[1], t[2])); }
glm::dvec3 high_of(const Corners& t) { return glm::max(t[0], glm::max(t[1], t[2])); }

double squared(const glm::dvec3& v) { return glm::dot(v, v); }

}  // namespace

/// C. Ericson, "Real-Time Collision Detection", 2005, section 5.1.5: by the region of the plane that the
/// point is over.
double squared_distance(const glm::dvec3& point, const Corners& triangle) {
  const auto& [a, b, c] = triangle;
  const glm::dvec3 ab = b - a;
  const glm::dvec3 ac = c - a;
  const double ab_a = glm::dot(ab, point - a);
  const double ac_a = glm::dot(ac, point - a);
  if (ab_a <= 0 && ac_a <= 0) {
    return squared(point - a);
  }
  const double ab_b = glm::dot(ab, point - b);
  const double ac_b = glm::dot(ac, point - b);
  if (ab_b >= 0 && ac_b <= ab_b) {
    return squared(point - b);
  }
  const double ab_c = glm::dot(ab, point - c);
  const double ac_c = glm::dot(ac, point - c);
  if (ac_c >= 0 && ab_c <= ac_c) {
    return squared(point - c);
  }
  const double over_c = ab_a * ac_b - ab_b * ac_a;
  if (over_c <= 0 && ab_a >= 0 && ab_b <= 0) {
    return squared(point - (a + ab * (ab_a / (ab_a - ab_b))));
  }
  const double over_b = ab_c * ac_a - ab_a * ac_c;
  if (over_b <= 0 && ac_a >= 0 && ac_c <= 0) {
    return squared(point - (a + ac * (ac_a / (ac_a - ac_c))));
  }
  const double over_a = ab_b * ac_c - ab_c * ac_b;
  if (over_a <= 0 && ac_b >= ab_b && ab_c >= ac_c) {
    const double part = (ac_b - ab_b) / ((ac_b - ab_b) + (ab_c - ac_c));
    return squared(point - (b + (c - b) * part));
  }
  const double all = over_a + over_b + over_c;
  return squared(point - (a + ab * (over_b / all) + ac * (over_c / all)));
}

SurfaceTree::SurfaceTree(std::vector<Corners> triangles) : triangles_(std::move(triangles)) {
  if (!triangles_.empty()) {
    build(0, static_cast<std::uint32_t>(triangles_.size()));
  }
}

std::uint32_t SurfaceTree::build(std::uint32_t first, std::uint32_t last) {
  const auto number = static_cast<std::uint32_t>(nodes_.size());
  Node node{.low = low_of(triangles_[first]), .high = high_of(triangles_[first])};
  for (std::uint32_t i = first; i < last; ++i) {
    node.low = glm::min(node.low, low_of(triangles_[i]));
    node.high = glm::max(node.high, high_of(triangles_[i]));
  }
  nodes_.push_back(node);
  if (last - first <= kLeafTriangles) {
    nodes_[number].first = first;
    nodes_[number].count = last - first;
    return number;
  }
  const glm::dvec3 size = node.high - node.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::uint32_t middle = first + (last - first) / 2;
  std::nth_element(triangles_.begin() + first, triangles_.begin() + middle, triangles_.begin() + last,
                   [axis](const Corners& l, const Corners& r) {
                     return l[0][axis] + l[1][axis] + l[2][axis] < r[0][axis] + r[1][axis] + r[2][axis];
                   });
  build(first, middle);
  const std::uint32_t right = build(middle, last);
  nodes_[number].right = right;
  return number;
}

bool SurfaceTree::one_holds(const Corners& piece, double limit) const {
  const glm::dvec3 low = high_of(piece) - limit;  // what the box must reach down to, and up to
  const glm::dvec3 high = low_of(piece) + limit;
  std::array<std::uint32_t, 64> waiting{};  // deeper than any tree of 2^32 triangles, which are halved
  std::size_t count = triangles_.empty() ? 0 : 1;
  while (count != 0) {
    const std::uint32_t number = waiting[--count];
    const Node& node = nodes_[number];
    if (glm::any(glm::lessThan(node.high, low)) || glm::any(glm::greaterThan(node.low, high))) {
      continue;
    }
    if (node.right != 0) {
      waiting[count++] = node.right;
      waiting[count++] = number + 1;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      if (std::ranges::all_of(piece, [&](const glm::dvec3& corner) {
            return squared_distance(corner, triangles_[i]) <= limit * limit;
          })) {
        return true;
      }
    }
  }
  return false;
}

bool SurfaceTree::holds_within(const Corners& piece, double limit) const {
  std::vector<Corners> pieces{piece};
  while (!pieces.empty()) {
    const Corners now = pieces.back();
    pieces.pop_back();
    if (one_holds(now, limit)) {
      continue;
    }
    std::size_t longest = 0;  // from this corner to the next
    double most = -1;
    for (std::size_t i = 0; i < 3; ++i) {
      const double length = squared(now[(i + 1) % 3] - now[i]);
      if (length > most) {
        most = length;
        longest = i;
      }
    }
    if (!(most > kLeastPiece * limit * kLeastPiece * limit)) {
      return false;
    }
    const glm::dvec3& from = now[longest];
    const glm::dvec3& to = now[(longest + 1) % 3];
    const glm::dvec3& apex = now[(longest + 2) % 3];
    const glm::dvec3 middle = (from + to) / 2.0;
    pieces.push_back({from, middle, apex});
    pieces.push_back({middle, to, apex});
  }
  return true;
}

bool within(std::span<const Corners> a, std::span<const Corners> b, double limit) {
  const auto holds = [limit](std::span<const Corners> one, std::span<const Corners> other) {
    const SurfaceTree tree({other.begin(), other.end()});
    return std::ranges::all_of(one, [&](const Corners& each) { return tree.holds_within(each, limit); });
  };
  return holds(a, b) && holds(b, a);
}

}  // namespace halfspace::whatif
