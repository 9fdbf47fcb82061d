/// Reports of surfaces that lie in one another and fight.
#include <array>
#include <vector>

#include "halfspace/stress/draw_list.hpp"
#include "halfspace/stress/grid_mesh.hpp"
#include "halfspace/stress/reports/scenes.hpp"

namespace halfspace::stress::report {
namespace {

constexpr std::uint32_t kSide = 32;

struct Vertex {
  GridPoint position;
  float z;
};
using Triangle = std::array<Vertex, 3>;

void add_all(DrawList& list, const std::vector<Triangle>& triangles) {
  for (const Triangle& t : triangles) {
    list.add({t[0].position, t[1].position, t[2].position}, {t[0].z, t[1].z, t[2].z});
  }
}

/// Draws the mesh twice, the second time with `func`, its triangles and their vertices in another order.
Case drawn_twice(DrawList& list, std::vector<Triangle> triangles, DepthFunc func) {
  list.draw().depth_func = DepthFunc::kLess;
  add_all(list, triangles);
  list.shuffle(triangles);
  for (Triangle& triangle : triangles) {
    list.shuffle(triangle);
  }
  Command& again = list.draw();
  again.depth_func = func;
  again.flags &= ~bits({Flag::kDepthWrite});
  add_all(list, triangles);
  Case made = list.take_defined();
  made.survivors.assign(kSide * kSide, 2);
  return made;
}

}  // namespace

Case overlay_tile(const Precision& precision, std::uint64_t seed) {
  DrawList list(precision, kSide, seed);
  const std::int64_t end = list.extent();
  const auto z = [&] { return list.depth() * 0.75F; };
  const std::vector<Vertex> corners{{{0, 0}, z()}, {{end, 0}, z()}, {{0, end}, z()}, {{end, end}, z()}};
  return drawn_twice(list, grid_mesh(list, corners, 2), DepthFunc::kLequal);
}

Case depth_prepass(const Precision& precision, std::uint64_t seed) {
  DrawList list(precision, kSide, seed);
  constexpr std::int64_t kCells = 5;
  const std::int64_t step = list.extent() / kCells + 1;
  std::vector<Vertex> vertices;
  for (std::int64_t j = -1; j <= kCells + 1; ++j) {
    for (std::int64_t i = -1; i <= kCells + 1; ++i) {
      vertices.push_back({{i * step + list.between(0, step / 4), j * step + list.between(0, step / 4)},
                          list.depth() * 0.75F});
    }
  }
  return drawn_twice(list, grid_mesh(list, vertices, kCells + 3), DepthFunc::kEqual);
}

Case floor_decal(const Precision& precision, std::uint64_t seed) {
  DrawList list(precision, kSide, seed);
  // The floor's depth in 2^-24 for a sub-pixel in x and in y: vertices of both lie in one plane exactly, and
  // a pixel's slope, which the offset takes away, is sixteen codes of 16 bits or more.
  const std::int64_t dx = list.between(16, 64) * 256 / list.one();
  const std::int64_t dy = list.between(16, 64) * 256 / list.one();
  const auto on_floor = [&](const GridPoint& p) {
    return Vertex{p, static_cast<float>((1 << 22) + dx * p.x + dy * p.y) * 0x1p-24F};
  };
  const auto quad = [&](const GridPoint& from, const GridPoint& to) {
    return grid_mesh<Vertex>(
        list, {on_floor(from), on_floor({to.x, from.y}), on_floor({from.x, to.y}), on_floor(to)}, 2);
  };
  const std::int64_t end = list.extent();
  list.draw().depth_func = DepthFunc::kLess;
  add_all(list, quad({0, 0}, {end, end}));
  Command& decal = list.draw();
  decal.depth_func = DepthFunc::kLess;
  decal.flags |= bits({Flag::kPolygonOffset});
  decal.offset_factor = -1;
  const GridPoint from = list.point(0, end / 2);
  const std::vector<Triangle> triangles =
      quad(from, {from.x + list.between(end / 4, end / 2), from.y + list.between(end / 4, end / 2)});
  add_all(list, triangles);
  Case made = list.take_defined();
  for (std::uint32_t y = 0; y < kSide; ++y) {
    for (std::uint32_t x = 0; x < kSide; ++x) {
      std::int32_t survivors = 1;
      for (const Triangle& t : triangles) {
        survivors += reference::covers({t[0].position, t[1].position, t[2].position}, list.sample_of(x, y),
                                       precision.rule)
                         ? 1
                         : 0;
      }
      made.survivors.push_back(survivors);
    }
  }
  return made;
}

}  // namespace halfspace::stress::report
