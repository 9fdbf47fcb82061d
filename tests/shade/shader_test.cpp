// Attributes over the pixels of frames, against exact rational arithmetic and analytic derivatives.
#include <fmt/format.h>
#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <glm/vec4.hpp>
#include <vector>

#include "../property/random.hpp"
#include "halfspace/machine/attribute_planes.hpp"
#include "halfspace/scene/camera.hpp"
#include "halfspace/scene/front_end.hpp"

using namespace halfspace;
using halfspace::testing::Random;
using halfspace::testing::samples;
using halfspace::testing::seed;

namespace {

constexpr int kFloorBits = 8;  // of the sub-pixel grid
using Corners = std::array<glm::dvec4, 3>;

/// A floor of two triangles, which begins behind the eye and goes to the horizon. Its texture coordinates are
/// its own x and z.
Mesh floor_mesh() {
  Mesh mesh;
  mesh.positions = {{-8, 0, 1}, {8, 0, 1}, {8, 0, -24}, {-8, 0, -24}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  mesh.parts = {{.name = "floor", .first_index = 0, .index_count = 6}};
  return mesh;
}

Frame floor_frame() {
  Camera camera;
  camera.width = 160;
  camera.height = 120;
  camera.eye = glm::dvec3(0.3, 1, 0);
  camera.at = glm::dvec3(0, 0.2, -4);
  return frame_from_mesh(floor_mesh(), camera, "floor");
}

Corners floor_uvs(std::uint32_t triangle) {
  const Mesh mesh = floor_mesh();
  Corners uvs;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3 p = mesh.positions[mesh.indices[3 * triangle + i]];
    uvs[i] = {p.x, p.z, 0, 0};
  }
  return uvs;
}

/// What the definition says, from the corners of what was clipped and the snapped positions, in rationals.
struct ExactPiece {
  std::array<ScreenVertex, 3> v;
  std::array<FrontEnd::Corner, 3> corners;

  [[nodiscard]] std::array<mpq_class, 3> edges(double x, double y) const {
    std::array<mpq_class, 3> e;
    const mpq_class px = mpq_class(x) * (1 << kFloorBits);
    const mpq_class py = mpq_class(y) * (1 << kFloorBits);
    for (std::size_t i = 0; i < 3; ++i) {
      const ScreenVertex& a = v[(i + 1) % 3];
      const ScreenVertex& b = v[(i + 2) % 3];
      e[i] = (mpq_class(b.x) - a.x) * (py - a.y) - (mpq_class(b.y) - a.y) * (px - a.x);
    }
    if (e[0] + e[1] + e[2] < 0) {
      for (mpq_class& each : e) each = -each;
    }
    return e;
  }

  [[nodiscard]] bool covers(int x, int y) const {
    return std::ranges::all_of(edges(x + 0.5, y + 0.5), [](const mpq_class& e) { return e >= 0; });
  }

  /// Component 0 or 1 of the attribute at a place.
  [[nodiscard]] mpq_class value(double x, double y, const Corners& at, int component) const {
    const std::array<mpq_class, 3> e = edges(x, y);
    mpq_class sum = 0;
    mpq_class weighted = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const mpq_class t = e[i] / mpq_class(corners[i].clip.w);
      sum += t;
      weighted += t * at_corner(i, at, component);
    }
    return weighted / sum;
  }

  [[nodiscard]] mpq_class at_corner(std::size_t i, const Corners& at, int component) const {
    mpq_class value = 0;
    for (int s = 0; s < 3; ++s) {
      value += mpq_class(corners[i].weights[s]) * mpq_class(at[static_cast<std::size_t>(s)][component]);
    }
    return value;
  }

  /// In whole units of the attribute's last place.
  [[nodiscard]] mpq_class rises(const Corners& at, int component) const {
    const mpq_class v0 = at_corner(0, at, component);
    return (abs(mpq_class(at_corner(1, at, component) - v0)) +
            abs(mpq_class(at_corner(2, at, component) - v0))) *
           65536;
  }
};

std::vector<ExactPiece> exact_pieces(const FrontEnd& front_end, std::uint32_t triangle) {
  std::vector<ScreenTriangle> fan;
  FrontEndCounters counters;
  front_end.process(triangle, fan, counters);
  const auto polygon = front_end.corners(triangle);
  std::vector<ExactPiece> pieces;
  for (std::size_t i = 0; i < fan.size(); ++i) {
    pieces.push_back({.v = fan[i].v, .corners = {polygon.v[0], polygon.v[i + 1], polygon.v[i + 2]}});
  }
  return pieces;
}

/// use(pieces, planes, triangle, x, y, piece) for each pixel of the floor.
template <class Use>
std::uint64_t for_floor(const Use& use) {
  const Frame frame = floor_frame();
  std::uint64_t pixels = 0;
  for (std::uint32_t triangle = 0; triangle < 2; ++triangle) {
    const FrontEnd front_end(frame, frame.commands[1], DepthFormat::kNone, kFloorBits);
    const std::vector<ExactPiece> pieces = exact_pieces(front_end, triangle);
    const AttributePlanes planes(front_end, triangle, kFloorBits);
    REQUIRE(planes.size() == pieces.size());
    for (int y = 0; y < 120; ++y) {
      for (int x = 0; x < 160; ++x) {
        const auto piece =
            std::ranges::find_if(pieces, [&](const ExactPiece& each) { return each.covers(x, y); });
        if (piece == pieces.end()) continue;
        ++pixels;
        use(*piece, planes, triangle, x, y);
      }
    }
  }
  return pixels;
}

/// The pixel's quad, of which it is pixel number `p`.
struct InQuad {
  int x;
  int y;
  std::size_t p;
  InQuad(int px, int py) : x(px & ~1), y(py & ~1), p(static_cast<std::size_t>((px & 1) + 2 * (py & 1))) {}
};

/// By how many units of 2^-16 the shader's number is off, less the half that rounding a value at the vertices
/// to such units costs, in both components.
mpq_class error_at(const ExactPiece& piece, const AttributePlanes& planes, std::uint32_t triangle, int x,
                   int y, Interpolation how, int component) {
  const Corners uvs = floor_uvs(triangle);
  const InQuad quad(x, y);
  const std::size_t its = planes.piece_at(x, y);
  const QuadValues values = planes.values(its, quad.x, quad.y, planes.mask(its, quad.x, quad.y), uvs, how);
  const mpq_class exact = piece.value(x + 0.5, y + 0.5, uvs, component) * 65536;
  return abs(mpq_class(exact - values[quad.p][static_cast<std::size_t>(component)]));
}

}  // namespace

TEST_CASE("shader: perspective is within the unit's bound on a floor, affine is far off", "[property]") {
  double worst_affine = 0;
  double sum_affine = 0;
  std::uint64_t outside = 0;
  const std::uint64_t pixels = for_floor(
      [&](const ExactPiece& piece, const AttributePlanes& planes, std::uint32_t triangle, int x, int y) {
        for (int c = 0; c < 2; ++c) {
          // 3 units of 2^-24 of the rises from the unit, 1 for 1/w as float32; a half for its result, a half
          // for the values at the vertices.
          const mpq_class bound = piece.rises(floor_uvs(triangle), c) * mpq_class(4, 1 << 24) + 1;
          outside += error_at(piece, planes, triangle, x, y, Interpolation::kPerspective, c) > bound ? 1 : 0;
          const double affine =
              error_at(piece, planes, triangle, x, y, Interpolation::kAffine, c).get_d() / 65536;
          worst_affine = std::max(worst_affine, affine);
          sum_affine += affine;
        }
      });
  const double mean_affine = sum_affine / (2.0 * static_cast<double>(pixels));
  INFO(fmt::format("{} pixels; affine is {:.3f} off on average, {:.3f} at most, of a floor of 16 x 25",
                   pixels, mean_affine, worst_affine));
  CHECK(pixels > 8000);
  CHECK(outside == 0);
  CHECK(worst_affine > 5);
  CHECK(mean_affine > 1);
}

TEST_CASE("shader: derivatives within a quad are those of the perspective-correct function", "[property]") {
  std::uint64_t checked = 0;
  std::uint64_t wrong = 0;
  for_floor(
      [&](const ExactPiece& piece, const AttributePlanes& planes, std::uint32_t triangle, int x, int y) {
        const InQuad quad(x, y);
        const Corners uvs = floor_uvs(triangle);
        const std::size_t its = planes.piece_at(x, y);
        const std::uint8_t mask = planes.mask(its, quad.x, quad.y);
        if (mask != 15) return;
        const QuadValues values = planes.values(its, quad.x, quad.y, mask, uvs, Interpolation::kPerspective);
        for (int c = 0; c < 2; ++c) {
          const auto number = [&](std::size_t p) { return values[p][static_cast<std::size_t>(c)] / 65536.0; };
          const double right = number(quad.p | 1) - number(quad.p & ~std::size_t{1});
          const double down = number(quad.p | 2) - number(quad.p & ~std::size_t{2});
          // A difference over one pixel is the derivative somewhere within it: between those at both ends, as
          // the function is monotonous there and bends one way. The derivative of N / D is (N' D - N D') /
          // D^2.
          const auto derivative = [&](double px, double py, int axis) {
            double n = 0, d = 0, dn = 0, dd = 0;
            const auto e = piece.edges(px, py);
            const auto next = piece.edges(px + (axis == 0 ? 1 : 0), py + (axis == 1 ? 1 : 0));
            for (std::size_t i = 0; i < 3; ++i) {
              const double w = piece.corners[i].clip.w;
              const double v = piece.at_corner(i, uvs, c).get_d();
              const double step = mpq_class(next[i] - e[i]).get_d();
              n += e[i].get_d() / w * v;
              d += e[i].get_d() / w;
              dn += step / w * v;
              dd += step / w;
            }
            return (dn * d - n * dd) / (d * d);
          };
          const auto check = [&](double found, int axis) {
            const double px = axis == 0 ? quad.x + 0.5 : x + 0.5;
            const double py = axis == 1 ? quad.y + 0.5 : y + 0.5;
            const double begin = derivative(px, py, axis);
            const double end = derivative(px + (axis == 0 ? 1 : 0), py + (axis == 1 ? 1 : 0), axis);
            // Two values, each within one unit and 4 * 2^-24 of the rises.
            const double slack = 2 * (1 + piece.rises(uvs, c).get_d() * 0x1p-22) / 65536;
            ++checked;
            wrong += found < std::min(begin, end) - slack || found > std::max(begin, end) + slack ? 1 : 0;
          };
          check(right, 0);
          check(down, 1);
        }
      });
  CHECK(checked > 20000);
  CHECK(wrong == 0);
}

TEST_CASE("front end: weights of clipped corners give their positions, and the fan's", "[property]") {
  CAPTURE(seed());
  Random random(seed());
  const std::uint64_t count = samples(20'000);
  std::uint64_t cut = 0;
  std::uint64_t wrong = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    Frame frame = floor_frame();
    const auto any = [&] { return static_cast<float>(random.between(-3000, 3000)) / 1000; };
    for (glm::vec4& v : frame.vertices) v = {any(), any(), any(), any() + 1};
    const FrontEnd front_end(frame, frame.commands[1], DepthFormat::kNone, kFloorBits);
    const auto polygon = front_end.corners(0);
    cut += polygon.size > 3 ? 1 : 0;
    std::vector<ScreenTriangle> fan;
    FrontEndCounters counters;
    front_end.process(0, fan, counters);
    const auto positive = [](const FrontEnd::Corner& c) { return c.clip.w > 0; };
    const bool whole =
        polygon.size >= 3 && std::all_of(polygon.v.begin(), polygon.v.begin() + polygon.size, positive);
    wrong += fan.size() != (whole ? polygon.size - 2 : 0) ? 1 : 0;
    for (std::size_t k = 0; k < polygon.size; ++k) {
      glm::dvec4 sum(0);
      for (std::uint32_t s = 0; s < 3; ++s) {
        sum += polygon.v[k].weights[static_cast<int>(s)] * glm::dvec4(frame.vertices[frame.indices[s]]);
      }
      for (int c = 0; c < 4; ++c) wrong += std::abs(sum[c] - polygon.v[k].clip[c]) > 1e-12 ? 1 : 0;
    }
    for (std::size_t t = 0; t < fan.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec4& clip = polygon.v[k == 0 ? 0 : t + k].clip;
        const double x = (clip.x / clip.w + 1) * 160 / 2 * (1 << kFloorBits);
        const double y = (1 - clip.y / clip.w) * 120 / 2 * (1 << kFloorBits);
        wrong += std::abs(fan[t].v[k].x - x) > 0.501 || std::abs(fan[t].v[k].y - y) > 0.501 ? 1 : 0;
      }
    }
  }
  CHECK(cut > count / 10);
  CHECK(wrong == 0);
}
