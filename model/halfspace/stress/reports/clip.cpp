/// Reports of clipping: holes where triangles were cut, triangles lost with a vertex behind the eye, and what
/// should have been cut off. A camera of 90 degrees stands at the origin; distances along its axis are w.
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "halfspace/stress/clip_plane.hpp"
#include "halfspace/stress/draw_list.hpp"
#include "halfspace/stress/grid_mesh.hpp"
#include "halfspace/stress/homogeneous_oracle.hpp"
#include "halfspace/stress/reports/scenes.hpp"

namespace halfspace::stress::report {
namespace {

constexpr std::uint32_t kScreen = 32;
constexpr double kNear = 1;
constexpr double kFar = 100;

glm::dvec4 project(double x, double y, double distance) {
  constexpr double kScale = kFar / (kFar - kNear);
  return {x, y, (distance - kNear) * kScale, distance};
}

/// u goes across, from -2 to 2, and v from the distance `first` to the distance `last`, at the height
/// `height` (y down) at both ends.
ClipPlane floor_between(double first, double last, double half_width, double height) {
  const glm::dvec4 begin = project(0, height, first);
  const glm::dvec4 end = project(0, height, last);
  return {.at = (begin + end) / 2.0, .along_u = {half_width / 2, 0, 0, 0}, .along_v = (end - begin) / 4.0};
}

/// The same as a wall on the right.
ClipPlane wall_between(double first, double last, double half_height, double right) {
  const glm::dvec4 begin = project(right, 0, first);
  const glm::dvec4 end = project(right, 0, last);
  return {.at = (begin + end) / 2.0, .along_u = {0, half_height / 2, 0, 0}, .along_v = (end - begin) / 4.0};
}

/// The plane as a mesh of `cells` by `cells`.
Case drawn(DrawList& list, const ClipPlane& plane, std::int64_t cells) {
  std::vector<glm::vec4> vertices;
  for (std::int64_t j = 0; j <= cells; ++j) {
    for (std::int64_t i = 0; i <= cells; ++i) {
      const double step = 4.0 / static_cast<double>(cells);
      vertices.emplace_back(
          plane.point(static_cast<double>(i) * step - 2, static_cast<double>(j) * step - 2));
    }
  }
  for (const auto& triangle : grid_mesh(list, vertices, cells + 1)) {
    list.add_clip(triangle);
  }
  Case made{.frame = list.take_frame()};
  made.fragments = fragments_of(plane, 1.999, 2.001, kScreen);
  return made;
}

}  // namespace

Case near_camera(const Precision& precision, std::uint64_t seed) {
  DrawList list(precision, kScreen, seed);
  list.draw();
  const auto far = [&] { return static_cast<float>(list.random.real(1, 2) * 40000 * 2 / kScreen); };
  // Around the middle of the screen, so the edges that two of them share cross it.
  const glm::vec4 middle(static_cast<float>(list.random.real(-0.9, 0.9)),
                         static_cast<float>(list.random.real(-0.9, 0.9)), 0.5F, 1);
  const std::array<glm::vec4, 4> around{glm::vec4{far(), far(), 0.5F, 1}, glm::vec4{-far(), far(), 0.5F, 1},
                                        glm::vec4{-far(), -far(), 0.5F, 1},
                                        glm::vec4{far(), -far(), 0.5F, 1}};
  for (std::size_t i = 0; i < around.size(); ++i) {
    std::array<glm::vec4, 3> triangle{middle, around[i], around[(i + 1) % around.size()]};
    list.shuffle(triangle);
    list.add_clip(triangle);
  }
  Case made{.frame = list.take_frame()};
  made.fragments.assign(kScreen * kScreen, 1);
  return made;
}

Case across_near(const Precision& precision, std::uint64_t seed) {
  DrawList list(precision, kScreen, seed);
  list.draw();
  const double first = list.random.real(0.1, 0.9);
  return drawn(list, floor_between(first, list.random.real(30, 90), 200, list.random.real(0.3, 1)), 1);
}

Case corner_cut_off(const Precision& precision, std::uint64_t seed) {
  DrawList list(precision, kScreen, seed);
  list.draw();
  ClipPlane wall = wall_between(list.random.real(0.2, 0.8), 40, 30, list.random.real(0.4, 0.9));
  wall.along_u +=
      project(0, 0, list.random.real(0.1, 0.2)) - project(0, 0, 0);  // the lower corners are farther
  return drawn(list, wall, 2);
}

Case cut_apart(const Precision& precision, std::uint64_t seed) {
  DrawList list(precision, kScreen, seed);
  list.draw();
  const auto real = [&](double low, double high) { return list.random.real(low, high); };
  // A fan on the floor around a point in front of the camera. Its other vertices are so far off, in all
  // directions, that every triangle is cut by the near plane or the far plane or a side.
  const double height = real(0.3, 1.5);
  const glm::vec4 middle(project(real(-1, 1), height, real(1.5, 4)));
  std::vector<glm::vec4> around;
  const std::int64_t arms = list.between(6, 12);
  for (std::int64_t i = 0; i < arms; ++i) {
    const double angle =
        2 * std::numbers::pi * (static_cast<double>(i) + real(-0.3, 0.3)) / static_cast<double>(arms);
    const double reach = real(1e5, 1e6);
    around.emplace_back(project(reach * std::cos(angle), height, reach * std::sin(angle)));
  }
  for (std::size_t i = 0; i < around.size(); ++i) {
    std::array<glm::vec4, 3> triangle{middle, around[i], around[(i + 1) % around.size()]};
    list.shuffle(triangle);
    list.add_clip(triangle);
  }
  Case made{.frame = list.take_frame()};
  constexpr double kEndless = 1e30;  // the borders of the fan are out of view
  made.fragments = fragments_of(floor_between(kNear, kFar, kFar, height), kEndless, kEndless, kScreen);
  return made;
}

Case vertex_behind_eye(const Precision& precision, std::uint64_t seed) {
  DrawList list(precision, kScreen, seed);
  list.draw();
  const auto real = [&](double low, double high) { return list.random.real(low, high); };
  const double side = list.one_in(2) ? 1 : -1;
  const double height = real(0.5, 3) * (list.one_in(2) ? 1 : -1);
  // Two vertices in front of the eye, left of what it sees, the third behind on the right: x / w of all is
  // below -1, though the triangle crosses the view.
  std::array<glm::vec4, 3> triangle{glm::vec4(project(-side * real(80, 120), height, real(40, 60))),
                                    glm::vec4(project(-side * real(12, 20), height, 10)),
                                    glm::vec4(project(side * real(80, 120), height, -real(3, 8)))};
  list.shuffle(triangle);
  list.add_clip(triangle);
  Case made{.frame = list.take_frame()};
  const HomogeneousTriangle exact(triangle, kScreen, precision.sub_pixel_bits);
  for (std::uint32_t y = 0; y < kScreen; ++y) {
    for (std::uint32_t x = 0; x < kScreen; ++x) {
      const Certainty certainty = exact.covers(x, y);
      made.fragments.push_back(
          certainty == Certainty::kUncertain ? kUncertain : (certainty == Certainty::kInside ? 1 : 0));
    }
  }
  return made;
}

Case hidden_by_near(const Precision& precision, std::uint64_t seed) {
  DrawList list(precision, kScreen, seed);
  list.draw();
  const double right = list.random.real(0.15, 0.4) * (list.one_in(2) ? 1 : -1);
  return drawn(list, wall_between(list.random.real(0.1, 0.4), list.random.real(2, 4), 1, right), 2);
}

Case beyond_far(const Precision& precision, std::uint64_t seed) {
  DrawList list(precision, kScreen, seed);
  list.draw();
  const double last = list.random.real(1.5, 4) * kFar;
  return drawn(list, wall_between(list.random.real(10, 60), last, 200, list.random.real(20, 50)), 2);
}

}  // namespace halfspace::stress::report
