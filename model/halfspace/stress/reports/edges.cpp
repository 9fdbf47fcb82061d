/// Reports of samples at edges: covered twice, or not at all.
#include <algorithm>
#include <array>
#include <tuple>
#include <vector>

#include "halfspace/stress/draw_list.hpp"
#include "halfspace/stress/grid_mesh.hpp"
#include "halfspace/stress/reports/scenes.hpp"

namespace halfspace::stress::report {
namespace {

Case tiling(DrawList& list) {
  Case made = list.take_defined();
  made.partition = true;
  return made;
}

void add_all(DrawList& list, const std::vector<GridTriangle>& triangles) {
  for (const GridTriangle& triangle : triangles) {
    list.add(triangle);
  }
}

}  // namespace

Case shared_diagonal(const Precision& precision, std::uint64_t seed) {
  constexpr std::uint32_t kSize = 8;
  DrawList list(precision, kSize, seed);
  list.draw();
  // Half a pixel more than there, where samples are at the corners of pixels. Both are 2^-14 pixel off a
  // grid, so that the square is 1 to 7 after snapping.
  constexpr double kLow = 0.99993896484375;
  constexpr double kHigh = 7.00006103515625;
  const auto at = [](double x, double y) { return glm::vec4(x * 2 / kSize - 1, y * 2 / kSize - 1, 0.5, 1); };
  const std::array<glm::vec4, 4> v{at(1, kLow), at(1, 7), at(kHigh, kLow), at(kHigh, 7)};
  for (std::array<glm::vec4, 3> triangle : {std::array{v[0], v[1], v[2]}, std::array{v[3], v[2], v[1]}}) {
    list.shuffle(triangle);
    list.add_clip(triangle);
  }
  Case made{.frame = list.take_frame()};
  for (std::uint32_t y = 0; y < kSize; ++y) {
    for (std::uint32_t x = 0; x < kSize; ++x) {
      made.fragments.push_back(x >= 1 && x < 7 && y >= 1 && y < 7 ? 1 : 0);
    }
  }
  return made;
}

Case fading_screen(const Precision& precision, std::uint64_t seed) {
  DrawList list(precision, 16, seed);
  list.draw();
  const std::int64_t end = list.extent();
  add_all(list, grid_mesh<GridPoint>(list, {{0, 0}, {end, 0}, {0, end}, {end, end}}, 2));
  return tiling(list);
}

Case polygon_strip(const Precision& precision, std::uint64_t seed) {
  DrawList list(precision, 16, seed);
  list.draw();
  // Rows of samples from one above the screen to one below. The strips between them have vertices of their
  // own there.
  const std::int64_t last = list.size();
  for (std::int64_t top = -1; top < last;) {
    const std::int64_t bottom = std::min(top + list.between(1, 6), last);
    std::array<std::vector<std::int64_t>, 2> columns;
    for (auto& side : columns) {
      for (std::int64_t x = -1; x < last; x += list.between(1, 6)) {
        side.push_back(x);
      }
      side.push_back(last);
    }
    // From triangle to triangle one vertex further on the upper side or on the lower one.
    std::size_t above = 0;
    std::size_t below = 0;
    while (above + 1 < columns[0].size() || below + 1 < columns[1].size()) {
      const GridPoint a = list.sample_of(columns[0][above], top);
      const GridPoint b = list.sample_of(columns[1][below], bottom);
      const bool goes_above =
          below + 1 == columns[1].size() || (above + 1 < columns[0].size() && list.one_in(2));
      const GridPoint c =
          goes_above ? list.sample_of(columns[0][++above], top) : list.sample_of(columns[1][++below], bottom);
      list.add(list.shuffled({a, b, c}));
    }
    top = bottom;
  }
  return tiling(list);
}

Case far_edges(const Precision& precision, std::uint64_t seed) {
  DrawList list(precision, 16, seed);
  list.draw();
  const auto far = [&] {
    return list.between(4 * list.extent(), 500 * list.one()) * (list.one_in(2) ? 1 : -1);
  };
  for (int n = 0; n < 16;) {
    const std::int64_t dx = far();
    const std::int64_t dy = far();
    const auto [gcd, u, v] = bezout(dx, dy);
    if (gcd != 1) {
      continue;
    }
    ++n;
    // An edge whose function is up to an eighth of a square pixel for each step at the sample, less than
    // float32 resolves in its products. The sample is not in the middle, where the two sides err alike.
    const GridPoint sample =
        list.sample_of(list.between(0, list.size() - 1), list.between(0, list.size() - 1));
    const std::int64_t value = list.between(-list.one() * list.one() / 8, list.one() * list.one() / 8);
    const GridPoint beside{-v * value, u * value};
    const std::int64_t along = (beside.x * dx + beside.y * dy) / (dx * dx + dy * dy);
    const GridPoint on{sample.x + beside.x - along * dx, sample.y + beside.y - along * dy};
    const std::int64_t back = list.between(2, 8);
    const std::int64_t ahead = list.between(2, 8);
    const GridPoint from{on.x - back * dx, on.y - back * dy};
    const GridPoint to{on.x + ahead * dx, on.y + ahead * dy};
    list.add(list.shuffled({from, to, {on.x - 4 * dy, on.y + 4 * dx}}));
    list.add(list.shuffled({from, to, {on.x + 4 * dy, on.y - 4 * dx}}));
  }
  return list.take_defined();
}

Case lod_border(const Precision& precision, std::uint64_t seed) {
  DrawList list(precision, 16, seed);
  list.draw();
  constexpr std::int64_t kFine = 4;
  const std::int64_t end = list.extent();
  const std::int64_t out = end / 4;  // so far the cells reach beyond the screen
  // The border from top to bottom, in steps that are on the grid.
  const GridPoint step{list.between(-end / 8, end / 8), (end + 2 * out) / kFine};
  const GridPoint top{end / 2 - 2 * step.x + list.between(-end / 8, end / 8), -out};
  const auto border = [&](std::int64_t i) { return GridPoint{top.x + i * step.x, top.y + i * step.y}; };
  add_all(list, grid_mesh<GridPoint>(list, {{-out, -out}, border(0), {-out, end + out}, border(kFine)}, 2));
  std::vector<GridPoint> fine;
  for (std::int64_t i = 0; i <= kFine; ++i) {
    fine.push_back(border(i));
    fine.push_back({end + out, border(i).y});
  }
  add_all(list, grid_mesh(list, fine, 2));
  return tiling(list);
}

Case fractional_rows(const Precision& precision, std::uint64_t seed) {
  DrawList list(precision, 32, seed);
  list.draw();
  constexpr std::int64_t kCells = 6;
  const std::int64_t step = list.extent() / kCells;
  std::array<std::array<GridPoint, kCells + 1>, kCells + 1> at{};
  for (std::int64_t j = 0; j <= kCells; ++j) {
    for (std::int64_t i = 0; i <= kCells; ++i) {
      at[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)] = {
          i * step + list.between(-step / 5, step / 5), j * step + list.between(-step / 5, step / 5)};
    }
  }
  for (std::size_t j = 0; j < kCells; ++j) {
    for (std::size_t i = j % 2; i < kCells; i += 2) {  // every other cell, so that borders show
      add_all(list, grid_mesh<GridPoint>(list, {at[j][i], at[j][i + 1], at[j + 1][i], at[j + 1][i + 1]}, 2));
    }
  }
  return list.take_defined();
}

Case distant_mesh(const Precision& precision, std::uint64_t seed) {
  DrawList list(precision, 16, seed);
  list.draw();
  constexpr std::int64_t kStep = 2;
  constexpr std::int64_t kCells = 8;
  const std::int64_t x = list.between(1, list.size() - 2);
  const std::int64_t y = list.between(1, list.size() - 2);
  const GridPoint first{list.sample_of(x, y).x - list.between(1, kStep * kCells - 1),
                        list.sample_of(x, y).y - list.between(1, kStep * kCells - 1)};
  std::vector<GridPoint> vertices;
  for (std::int64_t j = 0; j <= kCells; ++j) {
    for (std::int64_t i = 0; i <= kCells; ++i) {
      vertices.push_back({first.x + i * kStep, first.y + j * kStep});
    }
  }
  add_all(list, grid_mesh(list, vertices, kCells + 1));
  Case made = list.take_defined();
  made.fragments.assign(static_cast<std::size_t>(list.size() * list.size()), kUncertain);
  made.fragments[static_cast<std::size_t>(y * list.size() + x)] = 1;
  return made;
}

Case screen_border(const Precision& precision, std::uint64_t seed) {
  DrawList list(precision, 16, seed);
  list.draw();
  const std::int64_t end = list.extent();
  const GridPoint middle = list.point(1, end - 1);
  std::vector<GridPoint> around;
  for (const auto& [from, dx, dy] :
       {std::tuple{GridPoint{0, 0}, 1, 0}, std::tuple{GridPoint{end, 0}, 0, 1},
        std::tuple{GridPoint{end, end}, -1, 0}, std::tuple{GridPoint{0, end}, 0, -1}}) {
    around.push_back(from);
    const std::int64_t on = list.between(1, end - 1);
    around.push_back({from.x + dx * on, from.y + dy * on});
  }
  for (std::size_t i = 0; i < around.size(); ++i) {
    list.add(list.shuffled({middle, around[i], around[(i + 1) % around.size()]}));
  }
  return tiling(list);
}

Case sixteen_bits(const Precision& precision, std::uint64_t seed) {
  DrawList list(precision, 512, seed);  // 320x240 and more
  list.draw();
  // There a vertex is on a sample.
  list.add(list.shuffled({list.sample_of(314, 11), list.sample_of(14, 200), list.sample_of(97, 237)}));
  return list.take_defined();
}

Case pixel_centres(const Precision& precision, std::uint64_t seed) {
  DrawList list(precision, 16, seed);
  list.draw();
  for (std::int64_t y = 0; y < list.size(); y += 4) {
    const std::int64_t left = list.between(1, 8) * list.one() + list.between(1, list.one() / 2 - 1);
    const std::int64_t right = left + 4 * list.one();
    const std::int64_t top = y * list.one();
    add_all(list,
            grid_mesh<GridPoint>(
                list,
                {{left, top}, {right, top}, {left, top + 3 * list.one()}, {right, top + 3 * list.one()}}, 2));
  }
  return list.take_defined();
}

}  // namespace halfspace::stress::report
