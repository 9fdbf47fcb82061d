/// A polygon is weakly simple when arbitrarily small moves of its corners, and of points between them, make
/// it simple (H.-C. Chang, J. Erickson, C. Xu, "Detecting weakly simple polygons", SODA 2015). What is cut
/// off here leaves it weakly simple, and there is always something to cut off.
///
/// A spike, where the boundary turns back on itself or repeats a point, encloses nothing. Spikes go at once.
///
/// The simple polygon nearby has an ear (G. H. Meisters, "Polygons have ears", 1975). That is a flat corner,
/// or a triangle that winds counter-clockwise and that the boundary does not enter. Where the boundary enters
/// a triangle, so does a reflex corner: the one that is farthest in. Only cuts at a corner's own neighbours
/// can make it an ear.
///
/// Where the boundary runs along both sides of a triangle and back, as at a keyhole, nothing enters, and yet
/// one part may be inside of the other. Parts that run along each other keep their order up to where they
/// part; they do part, because there are no spikes.
#include "halfspace/scene/ear_clipping.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <queue>
#include <tuple>
#include <utility>

#include "halfspace/numerics/orientation.hpp"
#include "halfspace/scene/corner_tree.hpp"

namespace halfspace {
namespace {

using Corner = std::uint32_t;

constexpr Corner kNone = std::numeric_limits<Corner>::max();

/// What is cut off, the best first.
enum class Kind : std::uint8_t {
  kEar,
  kTouchedEar,  ///< a corner lies on the cut: that makes a flat triangle later
  kFlat,
  kCrossing,  ///< reflex, or the boundary enters it: only a polygon that crosses itself has nothing better
};

/// Cuts the corner `at` off, from `before` to `after`.
struct Cut {
  Kind kind = Kind::kCrossing;
  double size = 0;  ///< the least goes first
  Corner at = kNone;
  Corner before = kNone;
  Corner after = kNone;
  bool operator==(const Cut&) const = default;
  bool operator>(const Cut& other) const {
    return std::tie(kind, size, at) > std::tie(other.kind, other.size, other.at);
  }
};

class EarClipping {
 public:
  explicit EarClipping(std::span<const glm::dvec2> points)
      : points_(points), corners_(points.size()), left_(points.size()), reflex_(points) {
    triangles_.reserve(3 * points.size());
    for (Corner i = 0; i < points.size(); ++i) {
      corners_[i].before = i > 0 ? i - 1 : static_cast<Corner>(points.size() - 1);
      corners_[i].after = i + 1 < points.size() ? i + 1 : 0;
      changed_.push_back(i);
    }
  }

  std::vector<std::uint32_t> run() {
    settle();
    while (left_ > 3) {
      const Cut cut = queue_.top();
      queue_.pop();
      if (cut != corners_[cut.at].cut) continue;  // its surroundings have changed since
      remove(cut.at);
      settle();
    }
    add_triangle(last_);
    return std::move(triangles_);
  }

 private:
  struct State {
    Corner before = kNone;
    Corner after = kNone;
    int turn = 0;  ///< to the left 1, flat 0, reflex -1
    Cut cut;       ///< as it is in the queue
    bool removed = false;
  };
  enum class Contact : std::uint8_t { kNone, kTouches, kBlocks };

  [[nodiscard]] glm::dvec2 point(Corner corner) const { return points_[corner]; }
  [[nodiscard]] Corner before(Corner corner) const { return corners_[corner].before; }
  [[nodiscard]] Corner after(Corner corner) const { return corners_[corner].after; }
  [[nodiscard]] std::array<glm::dvec2, 3> triangle(Corner at) const {
    return {point(before(at)), point(at), point(after(at))};
  }

  void add_triangle(Corner at) { triangles_.insert(triangles_.end(), {before(at), at, after(at)}); }

  void remove(Corner at) {
    add_triangle(at);
    State& corner = corners_[at];
    corners_[corner.before].after = corner.after;
    corners_[corner.after].before = corner.before;
    changed_.insert(changed_.end(), {corner.before, corner.after});
    last_ = corner.after;
    corner.removed = true;
    corner.cut = {};
    reflex_.erase(at);
    --left_;
  }

  /// Removes spikes until there are none, then brings the queue up to date.
  void settle() {
    while (!changed_.empty()) {
      const Corner at = changed_.back();
      changed_.pop_back();
      State& corner = corners_[at];
      if (corner.removed) continue;
      const auto [a, b, c] = triangle(at);
      corner.turn = orientation(a, b, c);
      if (corner.turn == 0 && !strictly_between(a, b, c) && left_ > 3) {
        remove(at);
        continue;
      }
      if (corner.turn > 0) {
        reflex_.erase(at);
      } else {
        reflex_.insert(at);
      }
      unrated_.push_back(at);
    }
    for (const Corner at : unrated_) {
      if (!corners_[at].removed) rate(at);
    }
    unrated_.clear();
  }

  /// The shortest cut makes the least slender triangles; the smallest triangle does the least harm.
  void rate(Corner at) {
    const auto [a, b, c] = triangle(at);
    const glm::dvec2 cut = c - a;
    const glm::dvec2 side = b - a;
    const Kind what = kind(at);
    const double size =
        what == Kind::kCrossing ? std::abs(cut.x * side.y - cut.y * side.x) : cut.x * cut.x + cut.y * cut.y;
    corners_[at].cut = {what, size, at, before(at), after(at)};
    queue_.push(corners_[at].cut);
  }

  [[nodiscard]] Kind kind(Corner at) const {
    const int turn = corners_[at].turn;
    if (turn <= 0) return turn == 0 ? Kind::kFlat : Kind::kCrossing;
    Contact most = Contact::kNone;
    reflex_.visit_near(triangle(at), [&](Corner other) {
      most = std::max(most, contact(at, other));
      return most != Contact::kBlocks;
    });
    return most == Contact::kNone      ? Kind::kEar
           : most == Contact::kTouches ? Kind::kTouchedEar
                                       : Kind::kCrossing;
  }

  /// What the boundary at another corner does to the triangle that `at` would cut off.
  [[nodiscard]] Contact contact(Corner at, Corner other) const {
    const auto [a, b, c] = triangle(at);
    const glm::dvec2 p = point(other);
    const int from_ab = orientation(a, b, p);
    if (from_ab < 0) return Contact::kNone;
    const int from_bc = orientation(b, c, p);
    if (from_bc < 0) return Contact::kNone;
    const int from_ca = orientation(c, a, p);
    if (from_ca < 0) return Contact::kNone;
    if (from_ca == 0) return from_ab > 0 && from_bc > 0 ? Contact::kTouches : Contact::kNone;

    // In the triangle or on its sides ab and bc: sides of the boundary's neighbours as seen from there.
    const glm::dvec2 in = point(before(other));
    const glm::dvec2 out = point(after(other));
    const int in_from_ab = from_ab > 0 ? 1 : orientation(a, b, in);
    const int in_from_bc = from_bc > 0 ? 1 : orientation(b, c, in);
    const int out_from_ab = from_ab > 0 ? 1 : orientation(a, b, out);
    const int out_from_bc = from_bc > 0 ? 1 : orientation(b, c, out);
    if ((in_from_ab > 0 && in_from_bc > 0) || (out_from_ab > 0 && out_from_bc > 0)) return Contact::kBlocks;
    const bool runs_back_along_it = in_from_bc == 0 && in_from_ab > 0 && out_from_ab == 0 && out_from_bc > 0;
    return runs_back_along_it && lies_inside(at, other) ? Contact::kBlocks : Contact::kNone;
  }

  /// Two parts of the boundary meet in a point and run along each other, one from `at` onwards, the other
  /// backwards from `other`: is the latter on the left?
  [[nodiscard]] bool lies_inside(Corner at, Corner other) const {
    glm::dvec2 from = point(at);
    Corner i = after(at);
    Corner j = before(other);
    for (std::size_t steps = 2 * left_; steps > 0; --steps) {
      const glm::dvec2 p = point(i);
      const glm::dvec2 q = point(j);
      if (p == q) {
        const int side = side_after(from, p, point(after(i)), point(before(j)));
        if (side != 0) return side > 0;
        from = p;
        i = after(i);
        j = before(j);
      } else if (strictly_between(from, p, q)) {
        const int turn = orientation(from, p, point(after(i)));
        if (turn != 0) return turn < 0;
        i = after(i);
      } else {
        const int turn = orientation(from, q, point(before(j)));
        if (turn != 0) return turn > 0;
        j = before(j);
      }
    }
    return true;  // they never part: the polygon is not weakly simple
  }

  /// From -> at -> two places, none of them back: 1 when the other place is to the left of the one, 0 when
  /// both are in one direction.
  static int side_after(glm::dvec2 from, glm::dvec2 at, glm::dvec2 one, glm::dvec2 other) {
    const int turn = orientation(from, at, one);
    const int other_turn = orientation(from, at, other);
    if (turn != other_turn) return turn < other_turn ? 1 : -1;
    return turn == 0 ? 0 : orientation(at, one, other);
  }

  std::span<const glm::dvec2> points_;
  std::vector<State> corners_;
  std::size_t left_;             ///< corners that are not removed
  Corner last_ = 0;              ///< one of them
  CornerTree reflex_;            ///< those that do not turn left
  std::vector<Corner> changed_;  ///< that have new neighbours
  std::vector<Corner> unrated_;  ///< whose cut in the queue may be out of date
  std::priority_queue<Cut, std::vector<Cut>, std::greater<>> queue_;
  std::vector<std::uint32_t> triangles_;
};

}  // namespace

std::vector<std::uint32_t> clip_ears(std::span<const glm::dvec2> points) { return EarClipping(points).run(); }

}  // namespace halfspace
