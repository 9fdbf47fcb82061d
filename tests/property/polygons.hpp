/// Random polygons of integer corners, many of which touch themselves.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "halfspace/reference/exact_triangle.hpp"
#include "random.hpp"

namespace halfspace::testing {

using reference::GridPoint;
using reference::Int128;
using Ring = std::vector<GridPoint>;

/// Coordinates are below the side, in units of 1/16 pixel: half a pixel is the usual step.
inline constexpr int kPolygonBits = 4;
inline constexpr int kPolygonPixels = 16;
inline constexpr std::int64_t kHalfPixel = 8;
inline constexpr std::int64_t kPolygonSide = kPolygonPixels << kPolygonBits;

inline bool same(const GridPoint& a, const GridPoint& b) { return a.x == b.x && a.y == b.y; }
inline int turn(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  const Int128 area = reference::twice_area(a, b, c);
  return area > 0 ? 1 : area < 0 ? -1 : 0;
}
inline Int128 twice_ring_area(const Ring& ring) {
  Int128 sum = 0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i)
    sum += reference::twice_area(ring[0], ring[i], ring[i + 1]);
  return sum;
}
template <class Value>
void shuffle(Random& random, std::vector<Value>& values) {
  for (std::size_t i = values.size(); i > 1; --i) {
    std::swap(values[i - 1],
              values[static_cast<std::size_t>(random.between(0, static_cast<std::int64_t>(i) - 1))]);
  }
}
inline std::size_t below(Random& random, std::size_t count) {
  return static_cast<std::size_t>(random.between(0, static_cast<std::int64_t>(count) - 1));
}
inline bool one_in(Random& random, std::int64_t count) { return random.between(1, count) == 1; }

/// A plane map: quadrilaterals and triangles between rows and columns of points, all of positive area.
struct PlaneMap {
  std::vector<GridPoint> points;
  std::vector<std::vector<std::size_t>> faces;  ///< corners, in the direction of positive area

  /// Up to 5 cells wide and high, or exactly `cells`, beyond the side.
  static PlaneMap random(Random& random, std::size_t cells = 0) {
    PlaneMap map;
    const auto lines = [&](std::size_t count) {
      std::vector<std::int64_t> at;
      for (std::size_t i = 0; i < count; ++i) {
        at.push_back(i == 0 ? 0 : at[i - 1] + kHalfPixel * random.between(2, 5));
      }
      return at;
    };
    const std::vector<std::int64_t> columns = lines(cells > 0 ? cells + 1 : 2 + below(random, 5));
    const std::vector<std::int64_t> rows = lines(cells > 0 ? cells + 1 : 2 + below(random, 5));
    const std::int64_t shake = one_in(random, 2) ? random.between(1, 3) : 0;  // less than a quarter of a cell
    for (const std::int64_t y : rows) {
      for (const std::int64_t x : columns) {
        map.points.push_back({x + random.between(-shake, shake), y + random.between(-shake, shake)});
      }
    }
    const std::int64_t whole = random.between(1, 3);  // of so many cells one is not cut in two
    for (std::size_t row = 0; row + 1 < rows.size(); ++row) {
      for (std::size_t column = 0; column + 1 < columns.size(); ++column) {
        const std::size_t a = row * columns.size() + column;
        const std::size_t b = a + 1, c = b + columns.size(), d = a + columns.size();
        if (one_in(random, whole)) {
          map.faces.push_back({a, b, c, d});
        } else if (one_in(random, 2)) {
          map.faces.insert(map.faces.end(), {{a, b, c}, {a, c, d}});
        } else {
          map.faces.insert(map.faces.end(), {{a, b, d}, {b, c, d}});
        }
      }
    }
    return map;
  }
};

/// The boundary of a random tree of a plane map's parts: faces, joined along edges; points, joined to faces
/// at their corners and to each other by corridors of no width along edges. A thick drawing of it is a disc
/// in the plane, so that its boundary is weakly simple: it has keyholes, slits, pinches, whiskers and
/// bridges.
class TreeOfFaces {
 public:
  TreeOfFaces(Random& random, const PlaneMap& map) : map_(map) {
    root_ = below(random, map.faces.size());
    const std::int64_t sparse = random.between(1, 8);
    for (std::size_t f = 0; f < map.faces.size(); ++f)
      used_.push_back(f == root_ || !one_in(random, 1 + sparse));
    number_slots();
    join(random);
  }

  /// Corners may repeat.
  Ring boundary() {
    walk(root_, slots_[root_].size() - 1);
    return std::move(ring_);
  }
  [[nodiscard]] Int128 twice_area() const { return twice_area_; }

 private:
  /// A place on the boundary of a part, where another may be joined. Faces have a corner and then an edge, in
  /// turns; points have an edge and then the corner of the face to its left, in turns.
  struct Slot {
    std::size_t part = 0;
    std::size_t at = 0;
  };
  struct Join {
    Slot one, other;
    std::size_t edge = 0;  ///< or none
  };
  static constexpr std::size_t kNone = ~std::size_t{0};

  [[nodiscard]] std::size_t part_of_point(std::size_t point) const { return map_.faces.size() + point; }

  void number_slots() {
    slots_.resize(map_.faces.size() + map_.points.size());
    std::vector<std::vector<std::size_t>> neighbours(map_.points.size());
    for (std::size_t f = 0; f < map_.faces.size(); ++f) {
      const std::vector<std::size_t>& face = map_.faces[f];
      slots_[f].assign(2 * face.size(), Slot{kNone, 0});
      for (std::size_t i = 0; i < face.size(); ++i) {
        const std::size_t from = face[i], to = face[(i + 1) % face.size()];
        sides_[{from, to}] = {f, 2 * i + 1};
        corners_[{from, to}] = {f, 2 * i};
        edges_.try_emplace(std::minmax(from, to), edges_.size());
      }
    }
    for (const auto& [edge, number] : edges_) {
      neighbours[edge.first].push_back(edge.second);
      neighbours[edge.second].push_back(edge.first);
    }
    for (std::size_t p = 0; p < neighbours.size(); ++p) {
      const GridPoint centre = map_.points[p];
      const auto upper = [&](const GridPoint& q) {
        return q.y > centre.y || (q.y == centre.y && q.x > centre.x);
      };
      std::sort(neighbours[p].begin(), neighbours[p].end(), [&](std::size_t a, std::size_t b) {
        const GridPoint u = map_.points[a], v = map_.points[b];
        return upper(u) != upper(v) ? upper(u) : turn(centre, u, v) > 0;
      });
      slots_[part_of_point(p)].assign(2 * neighbours[p].size(), Slot{kNone, 0});
      for (std::size_t i = 0; i < neighbours[p].size(); ++i) {
        ways_[{p, neighbours[p][i]}] = {part_of_point(p), 2 * i};
      }
    }
  }

  void join(Random& random) {
    std::vector<Join> joins;
    const std::int64_t glued = random.between(1, 3), attached = random.between(2, 12),
                       corridors = random.between(2, 12);
    for (const auto& [edge, number] : edges_) {
      const auto [p, q] = edge;
      const auto left = sides_.find({p, q}), right = sides_.find({q, p});
      if (left != sides_.end() && right != sides_.end() && used_[left->second.part] &&
          used_[right->second.part] && one_in(random, glued)) {
        joins.push_back({left->second, right->second, number});
      } else if (one_in(random, corridors)) {
        joins.push_back({ways_[{p, q}], ways_[{q, p}], number});
      }
    }
    for (const auto& [way, corner] : corners_) {
      if (!used_[corner.part] || !one_in(random, attached)) continue;
      const Slot edge = ways_[way];
      joins.push_back({corner, {edge.part, edge.at + 1}, kNone});
    }
    shuffle(random, joins);
    std::vector<std::size_t> tree(slots_.size());
    std::iota(tree.begin(), tree.end(), std::size_t{0});
    const auto root_of = [&](std::size_t part) {
      while (tree[part] != part) part = tree[part] = tree[tree[part]];
      return part;
    };
    for (const Join& join : joins) {
      const std::size_t one = root_of(join.one.part), other = root_of(join.other.part);
      if (one == other) continue;
      tree[one] = other;
      slots_[join.one.part][join.one.at] = join.other;
      slots_[join.other.part][join.other.at] = join.one;
    }
  }

  /// Around a part, from behind a slot to that slot.
  void walk(std::size_t part, std::size_t behind) {
    const bool is_face = part < map_.faces.size();
    const std::size_t count = slots_[part].size();
    const auto emit_point = [&] {
      if (!is_face) ring_.push_back(map_.points[part - map_.faces.size()]);
    };
    if (is_face) {
      const std::vector<std::size_t>& face = map_.faces[part];
      for (std::size_t i = 1; i + 1 < face.size(); ++i) {
        twice_area_ +=
            reference::twice_area(map_.points[face[0]], map_.points[face[i]], map_.points[face[i + 1]]);
      }
    }
    emit_point();
    for (std::size_t step = 1; step <= count; ++step) {
      const std::size_t at = (behind + step) % count;
      const bool entry = step == count && part != root_;
      const Slot next = slots_[part][at];
      if (!entry && next.part != kNone) {
        walk(next.part, next.at);
        emit_point();
      } else if (!entry && is_face && at % 2 == 0) {
        ring_.push_back(map_.points[map_.faces[part][at / 2]]);
      }
    }
  }

  using Way = std::pair<std::size_t, std::size_t>;
  const PlaneMap& map_;
  std::size_t root_ = 0;
  std::vector<bool> used_;                ///< faces
  std::vector<std::vector<Slot>> slots_;  ///< of each part: what is joined there
  std::map<Way, std::size_t> edges_;      ///< between points, the lesser first
  std::map<Way, Slot> sides_, corners_;  ///< of the face to the left: its edge; its corner at the first point
  std::map<Way, Slot> ways_;             ///< of the first point: the edge to the second
  Ring ring_;
  Int128 twice_area_ = 0;
};

/// Points in any order, untangled: while two edges meet, what lies between is turned round. Nothing when
/// edges still touch in the end.
inline std::optional<Ring> untangled(Random& random, std::size_t corners, std::int64_t step) {
  Ring ring;
  for (std::size_t i = 0; i < corners; ++i) {
    const GridPoint p{step * random.between(0, kPolygonSide / step),
                      step * random.between(0, kPolygonSide / step)};
    if (std::none_of(ring.begin(), ring.end(), [&](const GridPoint& q) { return same(p, q); }))
      ring.push_back(p);
  }
  const std::size_t n = ring.size();
  if (n < 4) return std::nullopt;
  const auto between = [](const GridPoint& a, const GridPoint& p, const GridPoint& b) {
    return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
           p.y <= std::max(a.y, b.y);
  };
  const auto meet = [&](const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& d) {
    const int abc = turn(a, b, c), abd = turn(a, b, d), cda = turn(c, d, a), cdb = turn(c, d, b);
    if (abc * abd < 0 && cda * cdb < 0) return true;
    return (abc == 0 && between(a, c, b)) || (abd == 0 && between(a, d, b)) ||
           (cda == 0 && between(c, a, d)) || (cdb == 0 && between(c, b, d));
  };
  for (int round = 0; round < 100; ++round) {
    bool met = false;
    for (std::size_t i = 0; i + 2 < n; ++i) {
      for (std::size_t j = i + 2; j < n; ++j) {
        if (i == 0 && j == n - 1) continue;
        if (!meet(ring[i], ring[i + 1], ring[j], ring[(j + 1) % n])) continue;
        std::reverse(ring.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                     ring.begin() + static_cast<std::ptrdiff_t>(j) + 1);
        met = true;
      }
    }
    if (met) continue;
    for (std::size_t i = 0; i < n; ++i) {  // a corner where the boundary turns back
      const GridPoint a = ring[i], b = ring[(i + 1) % n], c = ring[(i + 2) % n];
      if (turn(a, b, c) == 0 && !between(a, b, c)) return std::nullopt;
    }
    return ring;
  }
  return std::nullopt;
}

/// Corners at distances at random, in directions that go round a centre.
inline Ring star(Random& random, std::size_t corners) {
  constexpr std::int64_t kReach = kPolygonSide / 2;
  std::vector<GridPoint> steps{{kReach, 0}, {0, kReach}, {-kReach, 0}, {0, -kReach}};
  for (std::size_t i = 0; i < corners; ++i) {
    steps.push_back({random.between(-kReach, kReach), random.between(-kReach, kReach)});
  }
  std::erase_if(steps, [](const GridPoint& p) { return p.x == 0 && p.y == 0; });
  const GridPoint centre{};
  const auto upper = [](const GridPoint& p) { return p.y > 0 || (p.y == 0 && p.x > 0); };
  std::sort(steps.begin(), steps.end(), [&](const GridPoint& p, const GridPoint& q) {
    return upper(p) != upper(q) ? upper(p) : turn(centre, p, q) > 0;
  });
  Ring ring;
  for (const GridPoint& p : steps) {  // the first of each direction
    if (ring.empty() || upper(p) != upper(ring.back()) || turn(centre, ring.back(), p) != 0)
      ring.push_back(p);
  }
  for (GridPoint& p : ring) p = {p.x + kReach, p.y + kReach};
  return ring;
}

/// A circle whose points were rounded: not quite convex, with points that repeat.
inline Ring rounded_disc(Random& random, std::size_t corners) {
  const double radius = static_cast<double>(random.between(3, kPolygonSide / 2));
  Ring ring;
  for (std::size_t i = 0; i < corners; ++i) {
    const double angle = 6.283185307179586 * static_cast<double>(i) / static_cast<double>(corners);
    ring.push_back({kPolygonSide / 2 + std::llround(radius * std::cos(angle)),
                    kPolygonSide / 2 + std::llround(radius * std::sin(angle))});
  }
  return ring;
}

/// A band of `corners` that winds inwards, once around for every 16 corners of a side.
inline Ring spiral(std::size_t corners, double size) {
  const std::size_t half = corners / 2;
  const double turns = static_cast<double>(half) / 16;
  Ring ring;
  for (std::size_t i = 0; i < corners; ++i) {
    const std::size_t step = i < half ? i : corners - 1 - i;
    const double along = static_cast<double>(step) / 16;
    const double radius = size / 2 * (turns + 1 - along - (i < half ? 0 : 0.5)) / (turns + 1);
    ring.push_back({std::llround(size / 2 + radius * std::cos(6.283185307179586 * along)),
                    std::llround(size / 2 + radius * std::sin(6.283185307179586 * along))});
  }
  return ring;
}

/// Teeth of random height on a bar.
inline Ring comb(Random& random, std::size_t teeth, std::int64_t pitch, std::int64_t height) {
  const std::int64_t width = 2 * pitch * static_cast<std::int64_t>(teeth);
  Ring ring{{0, 0}, {width, 0}};
  for (std::int64_t x = width - pitch; x >= 0; x -= pitch) {
    const bool tip = (x / pitch) % 2 == 0;
    ring.push_back({x, tip ? random.between(height / 2, height) : random.between(1, height / 2 - 1)});
  }
  return ring;
}

/// The same curve with other corners: some flat ones less, some more, some repeated, some places where the
/// boundary goes back a little and on again. It starts anywhere.
inline Ring with_other_corners(Random& random, const Ring& ring) {
  const std::int64_t repeat = random.between(2, 30), retreat = random.between(5, 60),
                     halve = random.between(3, 30), drop = random.between(1, 4);
  Ring result;
  const std::size_t n = ring.size();
  const std::size_t start = below(random, n);
  for (std::size_t k = 0; k < n; ++k) {
    const GridPoint b = ring[(start + k) % n], c = ring[(start + k + 1) % n];
    const bool repeated = !result.empty() && same(result.back(), b);
    if (repeated && !one_in(random, repeat)) continue;
    if (!result.empty() && !repeated) {
      const GridPoint a = result.back();
      const bool forwards = (b.x - a.x) * (c.x - b.x) + (b.y - a.y) * (c.y - b.y) > 0;
      if (turn(a, b, c) == 0 && forwards && one_in(random, drop)) continue;
      if (one_in(random, retreat)) {
        result.push_back(b);
        result.push_back(
            (a.x + b.x) % 2 == 0 && (a.y + b.y) % 2 == 0 ? GridPoint{(a.x + b.x) / 2, (a.y + b.y) / 2} : a);
      }
    }
    result.push_back(b);
    if (one_in(random, halve) && (b.x + c.x) % 2 == 0 && (b.y + c.y) % 2 == 0) {
      result.push_back({(b.x + c.x) / 2, (b.y + c.y) / 2});
    }
  }
  return result;
}

}  // namespace halfspace::testing
