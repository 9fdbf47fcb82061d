/// Families that tile the plane, or a part of it.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "halfspace/stress/clip_plane.hpp"
#include "halfspace/stress/draw_list.hpp"
#include "halfspace/stress/family.hpp"
#include "halfspace/stress/grid_mesh.hpp"

namespace halfspace::stress {
namespace {

/// Whether the direction of `a` comes before that of `b`, going round from +x.
bool earlier(const GridPoint& a, const GridPoint& b) {
  const auto lower = [](const GridPoint& p) { return p.y < 0 || (p.y == 0 && p.x < 0); };
  if (lower(a) != lower(b)) {
    return lower(b);
  }
  return a.x * b.y - a.y * b.x > 0;
}

}  // namespace

Case fan(const Precision& precision, std::uint64_t seed) {
  DrawList list(precision, 16, seed);
  list.draw();
  const std::int64_t x = list.between(0, list.size() - 1);
  const std::int64_t y = list.between(0, list.size() - 1);
  const GridPoint middle = list.sample_of(x, y);
  // One arm in each quadrant at least, so that no two that follow each other are half a turn apart or more.
  std::vector<GridPoint> arms;
  for (const auto& [sx, sy] : {std::array{1, 1}, std::array{-1, 1}, std::array{-1, -1}, std::array{1, -1}}) {
    for (auto n = list.between(1, 12); n > 0; --n) {
      const std::int64_t reach = list.one_in(3) ? 3 : list.one_in(2) ? list.one() : 12 * list.one();
      arms.push_back({sx * list.between(1, reach), sy * list.between(1, reach)});
    }
  }
  std::sort(arms.begin(), arms.end(), earlier);
  const auto parallel = [](const GridPoint& a, const GridPoint& b) { return a.x * b.y == a.y * b.x; };
  std::vector<GridTriangle> triangles;
  for (std::size_t i = 0; i < arms.size(); ++i) {
    // Of arms of one direction the fan goes out along the last and back along the next.
    const GridPoint& here = arms[i];
    const GridPoint& next = arms[(i + 1) % arms.size()];
    if (!parallel(here, next)) {
      triangles.push_back(list.shuffled({middle, GridPoint{middle.x + here.x, middle.y + here.y},
                                         GridPoint{middle.x + next.x, middle.y + next.y}}));
    }
  }
  list.shuffle(triangles);
  for (const GridTriangle& triangle : triangles) {
    list.add(triangle);
  }
  Case made = list.take_defined();
  made.fragments.assign(static_cast<std::size_t>(list.size() * list.size()), kUncertain);
  made.fragments[static_cast<std::size_t>(y * list.size() + x)] = 1;
  return made;
}

Case mesh(const Precision& precision, std::uint64_t seed) {
  constexpr std::uint32_t kSize = 32;
  DrawList list(precision, kSize, seed);
  list.draw();
  const std::int64_t cells = list.between(1, 24);
  // Multiples of 4, so that halves and quarters of an edge are on the grid.
  const std::int64_t step = (list.extent() / cells + 4) / 4 * 4;
  const std::int64_t jitter =
      list.one_in(8) ? 0 : step / 20;  // below a quarter of a cell in all: cells stay convex
  const std::int64_t shift = list.one_in(3) ? list.one() / 2 : 0;  // regular meshes with vertices on samples
  std::vector<GridPoint> corners;
  const std::int64_t row = cells + 3;
  for (std::int64_t j = -1; j <= cells + 1; ++j) {
    for (std::int64_t i = -1; i <= cells + 1; ++i) {
      corners.push_back({i * step + shift + 4 * list.between(-jitter, jitter),
                         j * step + shift + 4 * list.between(-jitter, jitter)});
    }
  }
  std::vector<GridTriangle> triangles;
  // a b c with a vertex on its edge b c, which the neighbour does not have.
  const auto add = [&](const GridPoint& a, const GridPoint& b, const GridPoint& c) {
    const auto kind = list.between(0, 3);
    if (kind > 1) {
      triangles.push_back({a, b, c});
      return;
    }
    const std::int64_t weight = kind == 0 ? 2 : list.one_in(2) ? 1 : 3;
    const GridPoint on{b.x + (c.x - b.x) / 4 * weight, b.y + (c.y - b.y) / 4 * weight};
    triangles.push_back({a, b, on});
    triangles.push_back({a, on, c});
  };
  for (std::int64_t j = 0; j < cells + 2; ++j) {
    for (std::int64_t i = 0; i < cells + 2; ++i) {
      const auto at = [&](std::int64_t right, std::int64_t down) {
        return corners[static_cast<std::size_t>((j + down) * row + i + right)];
      };
      // Either diagonal; an edge of the cell or the diagonal may have the vertex.
      const bool falls = list.one_in(2);
      const std::array<GridPoint, 3> one =
          falls ? std::array{at(0, 0), at(1, 0), at(1, 1)} : std::array{at(1, 0), at(0, 0), at(0, 1)};
      const std::array<GridPoint, 3> two =
          falls ? std::array{at(0, 0), at(1, 1), at(0, 1)} : std::array{at(1, 0), at(0, 1), at(1, 1)};
      const auto turn = static_cast<std::size_t>(list.between(0, 2));
      add(one[turn], one[(turn + 1) % 3], one[(turn + 2) % 3]);
      add(two[turn], two[(turn + 1) % 3], two[(turn + 2) % 3]);
    }
  }
  list.shuffle(triangles);
  for (const GridTriangle& triangle : triangles) {
    list.add(list.shuffled(triangle));
  }
  Case made = list.take_defined();
  made.partition = true;
  return made;
}

Case far_fan(const Precision& precision, std::uint64_t seed) {
  constexpr std::uint32_t kSize = 32;
  constexpr double kTurn = 6.283185307179586;
  DrawList list(precision, kSize, seed);
  list.draw();
  const auto vertex = [&](double x, double y) {
    const double w = std::ldexp(list.random.real(0.5, 1), static_cast<int>(list.between(-4, 4)));
    return glm::vec4(glm::dvec4(x, y, list.random.real(0.1, 0.9), 1) * w);
  };
  const GridPoint middle =
      list.one_in(2) ? list.sample_of(list.between(0, 31), list.between(0, 31)) : list.point_on_target();
  const double scale = 2.0 / static_cast<double>(list.extent());
  const glm::dvec2 hub{static_cast<double>(middle.x) * scale - 1, static_cast<double>(middle.y) * scale - 1};
  // A quarter of a turn at most from one arm to the next, each far longer than the target is wide, so that
  // the fan holds all of it.
  const std::int64_t arms = list.between(8, 24);
  const int nearest = static_cast<int>(list.between(3, 16));
  std::vector<glm::vec4> rim;
  for (std::int64_t i = 0; i < arms; ++i) {
    const double angle =
        kTurn * (static_cast<double>(i) + list.random.real(0, 0.9)) / static_cast<double>(arms);
    const double reach =
        std::ldexp(1.0, list.one_in(2) ? nearest : static_cast<int>(list.between(nearest, 40)));
    rim.push_back(vertex(hub.x + std::cos(angle) * reach, hub.y + std::sin(angle) * reach));
  }
  const glm::vec4 centre = vertex(hub.x, hub.y);
  std::vector<std::array<glm::vec4, 3>> triangles;
  for (std::size_t i = 0; i < rim.size(); ++i) {
    triangles.push_back({centre, rim[i], rim[(i + 1) % rim.size()]});
  }
  list.shuffle(triangles);
  for (auto& triangle : triangles) {
    list.shuffle(triangle);
    list.add_clip(triangle);
  }
  Case made{.frame = list.take_frame(), .sample = list.sample()};
  made.fragments.assign(kSize * kSize, 1);
  return made;
}

Case cut_mesh(const Precision& precision, std::uint64_t seed) {
  constexpr std::uint32_t kSize = 32;
  DrawList list(precision, kSize, seed);
  list.draw();
  const auto real = [&](double low, double high) { return list.random.real(low, high); };
  // A floor or wall: w and z change along the screen; the mesh reaches far beyond the clip volume, and behind
  // the eye where w falls fast.
  ClipPlane plane{};
  const double reach = std::ldexp(1.0, static_cast<int>(list.between(0, 14)));
  plane.at = {real(-0.5, 0.5), real(-0.5, 0.5), real(0.2, 0.8), 1};
  plane.along_u = {reach, real(-0.3, 0.3) * reach, real(-1, 1), real(-0.9, 0.9)};
  plane.along_v = {real(-0.3, 0.3) * reach, reach, real(-1, 1), real(-0.9, 0.9)};
  if (list.one_in(4)) {  // no perspective
    plane.along_u.w = 0;
    plane.along_v.w = 0;
  }
  const std::int64_t cells = list.between(2, 16);
  std::vector<glm::vec4> corners;
  for (std::int64_t j = 0; j <= cells; ++j) {
    for (std::int64_t i = 0; i <= cells; ++i) {
      const double scale = 4 / static_cast<double>(cells);
      corners.emplace_back(plane.point((static_cast<double>(i) + real(-0.2, 0.2)) * scale - 2,
                                       (static_cast<double>(j) + real(-0.2, 0.2)) * scale - 2));
    }
  }
  for (const auto& triangle : grid_mesh(list, corners, cells + 1)) {
    list.add_clip(triangle);
  }
  Case made{.frame = list.take_frame(), .sample = list.sample()};
  const double edge = 2.0 / static_cast<double>(cells);  // borders are jittered
  made.fragments = fragments_of(plane, 2 - 2 * edge, 2 + edge, kSize);
  return made;
}

}  // namespace halfspace::stress
