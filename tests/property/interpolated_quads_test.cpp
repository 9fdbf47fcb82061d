// What the interpolator gives of the quads of whole frames, against exact rational arithmetic on the vertices
// of the input.
#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <memory>
#include <vector>

#include "../frames.hpp"
#include "halfspace/core/functional.hpp"
#include "halfspace/scene/camera.hpp"
#include "halfspace/scene/mesh_attributes.hpp"
#include "random.hpp"

namespace halfspace::testing::interpolated_quads {
namespace {

constexpr int kSize = 64;
constexpr double kOne = 65536;  // of an attribute

class Quads final : public PacketObserver {
 public:
  std::vector<QuadEvent> all;
  [[nodiscard]] bool wants_quads() const override { return true; }
  void quad(const QuadEvent& event) override { all.push_back(event); }
};

Config machine_with(int attributes, int bits) {
  Config config;
  config.interpolator.enabled = true;
  config.interpolator.attributes = attributes;
  config.interpolator.bits = bits;
  return config;
}

/// The place of a pixel of the quad, in pixels: its sample.
std::array<double, 2> place(const QuadEvent& quad, unsigned pixel, const Config& config) {
  const SamplePosition at = sample_pattern(config).at[quad.sample];
  return {quad.x + pixel % 2 + at.x / 16.0, quad.y + pixel / 2 + at.y / 16.0};
}

/// A vertex in the window, on the sub-pixel grid, and its w, a power of two.
struct Vertex {
  double x;
  double y;
  double w;
};

/// The coordinates of a place in a triangle: E_i / w_i, by their sum.
std::array<mpq_class, 3> coordinates(const std::array<Vertex, 3>& v, double x, double y) {
  std::array<mpq_class, 3> b;
  mpq_class sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vertex& from = v[(i + 1) % 3];
    const Vertex& to = v[(i + 2) % 3];
    b[i] = (mpq_class(to.x) - from.x) * (mpq_class(y) - from.y) -
           (mpq_class(to.y) - from.y) * (mpq_class(x) - from.x);
    b[i] /= mpq_class(v[i].w);
    sum += b[i];
  }
  for (mpq_class& each : b) {
    each /= sum;
  }
  return b;
}

std::vector<Vertex> random_vertices(Random& random, int triangles) {
  std::vector<Vertex> all;
  for (int i = 0; i < 3 * triangles; ++i) {
    const auto coordinate = [&] { return static_cast<double>(random.between(-32 * 256, 96 * 256)) / 256; };
    all.push_back({coordinate(), coordinate(), std::ldexp(1, static_cast<int>(random.between(-3, 3)))});
  }
  return all;
}

Frame frame_of(Random& random, const std::vector<Vertex>& vertices) {
  FrameBuilder builder(kSize);
  std::vector<glm::dvec3> window;
  for (const Vertex& v : vertices) {
    window.emplace_back(v.x, v.y, static_cast<double>(random.between(0, 256)) / 256);
  }
  builder.draw(window);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    builder.frame.vertices[i] *= static_cast<float>(vertices[i].w);
  }
  return builder.frame;
}

}  // namespace

TEST_CASE("interpolated quads: coordinates are within the bound of exact ones", "[property]") {
  CAPTURE(seed());
  Random random(seed());
  std::uint64_t compared = 0;
  mpq_class worst = 0;
  for (int run = 0; run < 24; ++run) {
    const int bits = 2 * static_cast<int>(random.between(4, 12));
    Config config = machine_with(2, bits);
    config.raster.samples = run % 3 == 2 ? 4 : 1;
    const std::vector<Vertex> vertices = random_vertices(random, 8);
    Quads quads;
    const FrameResult result = run_functional(frame_of(random, vertices), config, {.observer = &quads});
    const InterpolatorCounters& counters = result.counters.interpolator;
    std::uint64_t alive = 0;
    std::uint64_t passed = 0;
    for (const QuadEvent& quad : quads.all) {
      passed += static_cast<std::uint64_t>(std::popcount(quad.passed));
      if (quad.passed == 0) {
        REQUIRE(quad.attributes.empty());
        continue;
      }
      ++alive;
      REQUIRE(quad.attributes.size() == 2);
      REQUIRE(quad.attributes[0] == quad.attributes[1]);
      const std::size_t first = std::size_t{3} * quad.triangle;
      const std::array<Vertex, 3> v{vertices[first], vertices[first + 1], vertices[first + 2]};
      for (unsigned pixel = 0; pixel < 4; ++pixel) {
        if ((quad.passed >> pixel & 1) == 0) {
          continue;
        }
        const auto [x, y] = place(quad, pixel, config);
        const std::array<mpq_class, 3> exact = coordinates(v, x, y);
        for (std::size_t i = 0; i < 3; ++i) {
          const mpq_class rises = i == 0 ? 2 * kOne : kOne;
          const mpq_class off = abs(exact[i] * kOne - quad.attributes[0][4 * pixel + i]);
          REQUIRE(off <= 3 * rises / (1u << bits) + mpq_class(1, 2));
          worst = std::max(worst, mpq_class((off - mpq_class(1, 2)) * (1u << bits) / rises));
          ++compared;
        }
        REQUIRE(quad.attributes[0][4 * pixel + 3] == 0);
      }
    }
    REQUIRE(counters.quads == alive);
    REQUIRE(counters.quads_killed == quads.all.size() - alive);
    REQUIRE(counters.attributes == 2 * alive);
    REQUIRE(counters.helpers == 4 * alive - passed);
  }
  INFO("worst " << worst.get_d() << " of 3 in " << compared);
  CHECK(compared > 10'000);
  CHECK(worst > 0.5);  // or the bound says nothing
}

TEST_CASE("interpolated quads: each piece of a clipped triangle goes on with its coordinates", "[property]") {
  CAPTURE(seed());
  Random random(seed() + 1);
  const Config config = machine_with(1, 24);
  std::uint64_t compared = 0;
  std::uint64_t pieces = 0;
  for (int run = 0; run < 60; ++run) {
    FrameBuilder builder(kSize);
    builder.draw({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
    glm::dmat3 m;  // of x, y and w by vertex: row i of its inverse gives coordinate i
    for (int i = 0; i < 3; ++i) {
      const auto any = [&] { return static_cast<double>(random.between(-4096, 4096)) / 1024; };
      const glm::vec4 v(any(), any(), any() / 4 + 0.5, any() + 1);
      builder.frame.vertices[static_cast<std::size_t>(i)] = v;
      m[i] = glm::dvec3(v.x, v.y, v.w);
    }
    const double area = std::abs(glm::determinant(m));
    if (area < 4) {
      continue;  // a sliver, in which a sub-pixel is far
    }
    const glm::dmat3 inverse = glm::inverse(m);
    Quads quads;
    const FrameResult result = run_functional(builder.frame, config, {.observer = &quads});
    pieces += result.counters.front_end.emitted > 1 ? 1 : 0;
    for (const QuadEvent& quad : quads.all) {
      for (unsigned pixel = 0; pixel < 4 && quad.passed != 0; ++pixel) {
        if ((quad.passed >> pixel & 1) == 0) {
          continue;
        }
        const auto [x, y] = place(quad, pixel, config);
        for (int i = 0; i < 3; ++i) {
          // Corners are snapped by up to half a sub-pixel each way: so far is the place that has the value.
          double least = 1e9;
          double most = -1e9;
          for (const double dx : {-0.75, 0.75}) {
            for (const double dy : {-0.75, 0.75}) {
              const glm::dvec3 b =
                  inverse * glm::dvec3((x + dx / 256) * 2 / kSize - 1, (y + dy / 256) * 2 / kSize - 1, 1);
              const double value = b[i] / (b.x + b.y + b.z) * kOne;
              least = std::min(least, value);
              most = std::max(most, value);
            }
          }
          const double value = quad.attributes.at(0)[4 * pixel + static_cast<unsigned>(i)];
          REQUIRE(value >= least - 2);
          REQUIRE(value <= most + 2);
          ++compared;
        }
      }
    }
  }
  CHECK(pieces > 10);
  CHECK(compared > 10'000);
}

TEST_CASE("interpolated quads: those of a mesh have its attributes, then coordinates", "[property]") {
  Mesh mesh;
  mesh.positions = {{-8, 0, 1}, {8, 0, 1}, {8, 0, -24}, {-8, 0, -24}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  mesh.parts = {{.name = "floor", .first_index = 0, .index_count = 6}};
  AttributeBuilder attributes;
  for (std::uint32_t i = 0; i < 4; ++i) {
    attributes.set_color(i, glm::vec4(i == 0, i == 1, i == 2, 1));
    attributes.set_uv(i, glm::vec2(mesh.positions[i].x / 8, mesh.positions[i].z / 8));
  }
  attributes.end_parts(1, kNoAttribute);
  std::move(attributes).finish(mesh);
  Camera camera;
  camera.width = camera.height = kSize;
  camera.eye = glm::dvec3(0.3, 1, 0);
  camera.at = glm::dvec3(0, 0.2, -4);
  const Frame frame = frame_from_mesh(mesh, camera, "floor");
  REQUIRE(frame.attributes != nullptr);
  Quads quads;
  run_functional(frame, machine_with(3, 24), {.observer = &quads});
  std::uint64_t compared = 0;
  for (const QuadEvent& quad : quads.all) {
    for (unsigned pixel = 0; pixel < 4 && quad.passed != 0; ++pixel) {
      const auto value = [&](std::size_t attribute, unsigned component) -> double {
        return quad.attributes.at(attribute)[4 * pixel + component];
      };
      glm::dvec4 color(0);
      glm::dvec4 uv(0);
      for (unsigned i = 0; i < 3; ++i) {
        const std::uint32_t vertex = mesh.indices[3 * quad.triangle + i];
        color += glm::dvec4(vertex == 0, vertex == 1, vertex == 2, 1) * value(2, i);
        uv += glm::dvec4(mesh.positions[vertex].x / 8, mesh.positions[vertex].z / 8, 0, 0) * value(2, i);
      }
      if ((quad.passed >> pixel & 1) == 0) {
        continue;
      }
      for (unsigned component = 0; component < 4; ++component) {
        REQUIRE(std::abs(value(0, component) - color[static_cast<int>(component)]) <= 4);
        REQUIRE(std::abs(value(1, component) - uv[static_cast<int>(component)]) <= 8);
        ++compared;
      }
    }
  }
  CHECK(compared > 4'000);
}

TEST_CASE("interpolated quads: a clear asks for none, an outline has those of its first vertex",
          "[property]") {
  FrameBuilder builder(kSize);
  Command& draw = builder.draw({{3, 3, 0.5}, {60, 10, 0.5}, {20, 60, 0.5}});
  draw.polygon_mode = PolygonMode::kLine;
  Config config = machine_with(1, 24);
  config.z_cache.fast_clear = false;
  Quads quads;
  const FrameResult result = run_functional(builder.frame, config, {.observer = &quads});
  // two triangles, which share the quads on the diagonal
  CHECK(result.drawn_clears.quad_generator.quads == kSize * kSize / 4 + kSize / 2);
  CHECK(result.drawn_clears.interpolator.quads == 0);
  CHECK(result.counters.interpolator.quads > 50);
  for (const QuadEvent& quad : quads.all) {
    for (std::size_t i = 0; i < 16 && quad.passed != 0; ++i) {
      REQUIRE(quad.attributes.at(0)[i] == (i % 4 == 0 ? 65536 : 0));
    }
  }
}

}  // namespace halfspace::testing::interpolated_quads
