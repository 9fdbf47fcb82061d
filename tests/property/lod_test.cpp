// Simplified meshes: the distance between surfaces by brute force.
#include <algorithm>
#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "../frames.hpp"
#include "halfspace/core/functional.hpp"
#include "halfspace/scene/ptf.hpp"
#include "halfspace/whatif/lod.hpp"
#include "halfspace/whatif/surface_distance.hpp"
#include "random.hpp"

namespace halfspace::testing {
namespace {

using whatif::Corners;
using Surfaces = std::vector<Corners>;

double to_segment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const double length = glm::dot(b - a, b - a);
  const double t = length == 0 ? 0 : std::clamp(glm::dot(p - a, b - a) / length, 0.0, 1.0);
  return glm::distance(p, a + (b - a) * t);
}

/// By the sides, and by the plane where the foot of the perpendicular is inside.
double naive_distance(const glm::dvec3& p, const Corners& t) {
  double least = std::min({to_segment(p, t[0], t[1]), to_segment(p, t[1], t[2]), to_segment(p, t[2], t[0])});
  const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
  bool inside = glm::length(normal) > 0;
  for (std::size_t i = 0; i < 3 && inside; ++i) {
    inside = glm::dot(glm::cross(t[(i + 1) % 3] - t[i], p - t[i]), normal) >= 0;
  }
  return inside ? std::min(least, std::abs(glm::dot(p - t[0], glm::normalize(normal)))) : least;
}

double naive_distance(const glm::dvec3& p, const Surfaces& surface) {
  double least = std::numeric_limits<double>::infinity();
  for (const Corners& t : surface) {
    least = std::min(least, naive_distance(p, t));
  }
  return least;
}

double unit_random(Random& random) { return static_cast<double>(random.between(0, 1 << 20)) / (1 << 20); }

glm::dvec3 point_on(Random& random, const Surfaces& surface) {
  const Corners& t =
      surface[static_cast<std::size_t>(random.between(0, static_cast<std::int64_t>(surface.size()) - 1))];
  double u = unit_random(random);
  double v = unit_random(random);
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  return t[0] + (t[1] - t[0]) * u + (t[2] - t[0]) * v;
}

/// The surface of a draw as the header describes it, depth scaled by the extents of the draw `as` it was.
struct WindowSpace {
  explicit WindowSpace(const Frame& frame, const Command& draw) {
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high = -low;
    for (std::uint32_t i = 0; i < draw.index_count; ++i) {
      const glm::dvec3 p = window(frame, draw, i);
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    const glm::dvec3 size = high - low;
    scale = size.z > 0 ? std::max(size.x, size.y) / size.z : 0;
  }

  static glm::dvec3 window(const Frame& frame, const Command& draw, std::uint32_t i) {
    const glm::dvec4 v(frame.vertices[draw.first_vertex + frame.indices[draw.first_index + i]]);
    const double z = v.z / v.w;
    const double near = draw.depth_range.x;
    const double far = draw.depth_range.y;
    return {draw.viewport.x + (v.x / v.w + 1) * draw.viewport.z / 2,
            draw.viewport.y + (v.y / v.w + 1) * draw.viewport.w / 2,
            draw.has(Flag::kNdcZMinusOneToOne) ? (far - near) / 2 * z + (far + near) / 2
                                               : near + z * (far - near)};
  }

  [[nodiscard]] Surfaces surface(const Frame& frame, const Command& draw) const {
    Surfaces triangles(draw.index_count / 3);
    for (std::uint32_t i = 0; i < draw.index_count; ++i) {
      const glm::dvec3 p = window(frame, draw, i);
      triangles[i / 3][i % 3] = {p.x, p.y, p.z * scale};
    }
    return triangles;
  }

  double scale = 0;
};

std::uint64_t triangles_of(const Frame& frame) {
  std::uint64_t sum = 0;
  for (const Command& command : frame.commands) {
    sum += command.kind == CommandKind::kDraw ? command.index_count / 3 : 0;
  }
  return sum;
}

/// cells x cells cells of two triangles in a square of 48 pixels, with the depth that height(x, y) says.
template <class Height>
std::vector<glm::dvec3> height_field(int cells, const Height& height) {
  std::vector<glm::dvec3> window;
  const auto vertex = [&](int x, int y) {
    const double px = 8 + 48.0 * x / cells;
    const double py = 8 + 48.0 * y / cells;
    window.emplace_back(px, py, height(px, py));
  };
  for (int y = 0; y < cells; ++y) {
    for (int x = 0; x < cells; ++x) {
      vertex(x, y);
      vertex(x + 1, y);
      vertex(x, y + 1);
      vertex(x + 1, y);
      vertex(x + 1, y + 1);
      vertex(x, y + 1);
    }
  }
  return window;
}

/// Checks random points of each simplified draw, both ways.
void check_bound(Random& random, const Frame& before, const Frame& after, double pixels, int points,
                 std::size_t most_triangles) {
  REQUIRE(before.commands.size() == after.commands.size());
  for (std::size_t i = 0; i < before.commands.size(); ++i) {
    const Command& was = before.commands[i];
    const Command& is = after.commands[i];
    if (was.kind != CommandKind::kDraw || was.first_index == is.first_index ||
        was.index_count / 3 > most_triangles) {
      continue;
    }
    const WindowSpace space(before, was);
    const Surfaces old_surface = space.surface(before, was);
    const Surfaces new_surface = space.surface(after, is);
    double farthest = 0;
    for (int n = 0; n < points; ++n) {
      farthest = std::max({farthest, naive_distance(point_on(random, old_surface), new_surface),
                           naive_distance(point_on(random, new_surface), old_surface)});
    }
    CAPTURE(i, was.index_count / 3, is.index_count / 3);
    REQUIRE(farthest <= pixels * (1 + 1e-9));
  }
}

}  // namespace

TEST_CASE("lod: a distance to a triangle is that to its sides or its plane", "[property]") {
  Random random(seed());
  const auto point = [&] {
    return glm::dvec3(unit_random(random), unit_random(random), unit_random(random)) * 4.0 - 2.0;
  };
  for (int n = 0; n < 20'000; ++n) {
    const Corners t{point(), point(), point()};
    const glm::dvec3 p = point();
    CAPTURE(seed(), n);
    REQUIRE(std::sqrt(whatif::squared_distance(p, t)) == Approx(naive_distance(p, t)).margin(1e-9));
  }
}

TEST_CASE("lod: surfaces are compared at every point, not only at vertices") {
  const auto quad = [](double x, double y, double w, double h, double z) {
    return Surfaces{Corners{glm::dvec3(x, y, z), {x + w, y, z}, {x, y + h, z}},
                    Corners{glm::dvec3(x + w, y, z), {x + w, y + h, z}, {x, y + h, z}}};
  };
  const Surfaces whole = quad(0, 0, 9, 9, 0);
  CHECK(whatif::within(whole, quad(0, 0, 9, 9, 1), 1.001));
  CHECK_FALSE(whatif::within(whole, quad(0, 0, 9, 9, 1), 0.999));
  Surfaces ring;  // the same but for the middle 3 x 3, whose own middle is 1.5 away
  for (const int x : {0, 3, 6}) {
    for (const int y : {0, 3, 6}) {
      if (x != 3 || y != 3) {
        const Surfaces cell = quad(x, y, 3, 3, 0);
        ring.insert(ring.end(), cell.begin(), cell.end());
      }
    }
  }
  CHECK_FALSE(whatif::within(whole, ring, 1.4));
  CHECK(whatif::within(whole, ring, 1.8));        // not sharp: by up to an eighth
  CHECK_FALSE(whatif::within(ring, whole, 1.4));  // either way round
  const Surfaces middle = quad(3, 3, 3, 3, 0);
  ring.insert(ring.end(), middle.begin(), middle.end());
  CHECK(whatif::within(whole, ring, 1e-3));
  CHECK_FALSE(whatif::within(whole, {}, 1));
}

TEST_CASE("lod: a plane keeps its outline and depth, of a few triangles") {
  FrameBuilder builder(64, DepthFormat::kFloat32);
  builder.draw(height_field(16, [](double x, double y) { return 0.25 + x / 256 + y / 512; }));
  Frame simple = builder.frame;
  CHECK(whatif::simplify(simple, 0.25).draws == 1);
  CHECK(triangles_of(builder.frame) == 512);
  CHECK(triangles_of(simple) <= 8);
  const FrameResult before = run_functional(builder.frame, {});
  const FrameResult after = run_functional(simple, {});
  CHECK(after.counters.quad_generator.fragments == 48 * 48);
  for (int y = 8; y < 56; ++y) {
    for (int x = 8; x < 56; ++x) {
      CAPTURE(x, y);
      const auto depth = [&](const FrameResult& result) {
        return depth_of_code(DepthFormat::kFloat32, result.surfaces[0].codes.at(x, y));
      };
      REQUIRE(std::abs(depth(before) - depth(after)) < 1e-6);
    }
  }
}

TEST_CASE("lod: no point of a bumpy surface moves farther than it may", "[property]") {
  Random random(seed() + 1);
  std::uint64_t saved = 0;
  for (int run = 0; run < 12; ++run) {
    CAPTURE(seed(), run);
    FrameBuilder builder(64, DepthFormat::kFloat32);
    const double waves = 0.05 + unit_random(random) / 2;
    const double high = 0.3 * unit_random(random);
    builder.draw(height_field(static_cast<int>(random.between(4, 24)), [&](double x, double y) {
      return 0.5 + high * std::sin(x * waves) * std::cos(y * waves * 0.7);
    }));
    for (const double pixels : {0.1, 0.5, 2.0, 8.0}) {
      CAPTURE(pixels);
      Frame simple = builder.frame;
      whatif::simplify(simple, pixels);
      check_bound(random, builder.frame, simple, pixels, 200, 10'000);
      saved += triangles_of(builder.frame) - triangles_of(simple);
    }
  }
  CHECK(saved > 1000);
}

TEST_CASE("lod: the parts of a truck stay within the pixels asked for, and more of them take fewer triangles",
          "[property][exhaustive]") {
  Random random(seed() + 2);
  const Frame truck = read_ptf(HALFSPACE_SCENES "/cc0_truck.ptf.xz");
  std::uint64_t last = triangles_of(truck);
  for (const double pixels : {1.0, 8.0}) {
    CAPTURE(seed(), pixels);
    Frame simple = truck;
    whatif::simplify(simple, pixels);
    CHECK(triangles_of(simple) < last);
    last = triangles_of(simple);
    check_bound(random, truck, simple, pixels, 30, 3000);
  }
}

TEST_CASE("lod: leaves alone what is behind the eye, not finite, or may not move") {
  FrameBuilder builder(64);
  builder.draw(height_field(4, [](double, double) { return 0.5; })).flags |= bits({Flag::kShaderDiscards});
  builder.draw(height_field(4, [](double, double) { return 0.5; }));
  builder.draw(height_field(4, [](double, double) { return 0.5; }));
  Frame& frame = builder.frame;
  frame.vertices[frame.commands[2].first_vertex + 7].w = 0;
  frame.vertices[frame.commands[3].first_vertex + 7].x = std::numeric_limits<float>::quiet_NaN();
  CHECK(whatif::simplify(frame, 4).draws == 0);
  CHECK(triangles_of(frame) == 3 * 32);
}

}  // namespace halfspace::testing
