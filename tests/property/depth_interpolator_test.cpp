// Depth of the units against exact rational arithmetic.
#include "halfspace/units/depth_interpolator.hpp"

#include <bit>
#include <catch2/catch.hpp>

#include "../triangles.hpp"
#include "halfspace/reference/exact_depth.hpp"
#include "random.hpp"

using namespace halfspace;
using namespace halfspace::testing;

namespace {

constexpr int kSize = 64;

/// The value that a vertex depth stands for.
mpq_class vertex_value(DepthFormat format, std::uint32_t z) {
  if (format == DepthFormat::kFloat32) {
    return reference::float_value(std::bit_cast<float>(z));
  }
  return mpq_class(z) / (mpq_class(1u << vertex_depth_fraction(format)) * max_unorm_code(format));
}

mpq_class ulps_off(DepthFormat format, std::uint32_t code, const mpq_class& exact) {
  return format == DepthFormat::kFloat32 ? reference::ulps_off_float(std::bit_cast<float>(code), exact)
                                         : reference::ulps_off_unorm(code, exact, unorm_bits(format));
}

/// A vertex depth: anything, or an end, or for floats any exponent down to the subnormal ones.
std::uint32_t random_depth(TriangleSource& source, DepthFormat format) {
  const int kind = source.integer(0, 5);
  if (format == DepthFormat::kFloat32) {
    const int one = 0x3F800000;
    return static_cast<std::uint32_t>(kind == 0   ? 0
                                      : kind == 1 ? one
                                      : kind == 2 ? source.integer(0x3F000000, one)
                                                  : source.integer(0, one));
  }
  const int most = static_cast<int>(max_unorm_code(format) << vertex_depth_fraction(format));
  return static_cast<std::uint32_t>(kind == 0 ? 0 : kind == 1 ? most : source.integer(0, most));
}

/// Any triangle, with depths of the format.
ScreenTriangle random_triangle(TriangleSource& source, DepthFormat format) {
  ScreenTriangle t = source.next();
  for (ScreenVertex& v : t.v) {
    v.z = random_depth(source, format);
  }
  return t;
}

}  // namespace

TEST_CASE("barycentric depth is within one unit of the last place, and inside the range of the vertices") {
  const DepthFormat format = GENERATE(DepthFormat::kUnorm16, DepthFormat::kUnorm24, DepthFormat::kFloat32);
  const int bits = GENERATE(4, 8);
  const std::uint64_t start = seed() + static_cast<std::uint64_t>(bits);
  CAPTURE(start, bits, static_cast<int>(format));
  TriangleSource source(start, kSize, bits);
  SetupState state = open_state(kSize, bits);
  state.depth_format = format;
  mpq_class worst = 0;
  int samples = 0;
  for (int n = 0; n < 1500; ++n) {
    const ScreenTriangle t = random_triangle(source, format);
    SetupTriangle triangle;
    if (setup(t, state, triangle) != SetupVerdict::kDrawn) {
      continue;
    }
    const std::uint32_t least = stored_code(format, std::min({t.v[0].z, t.v[1].z, t.v[2].z}));
    const std::uint32_t most = stored_code(format, std::max({t.v[0].z, t.v[1].z, t.v[2].z}));
    const std::array<mpq_class, 3> z{vertex_value(format, t.v[0].z), vertex_value(format, t.v[1].z),
                                     vertex_value(format, t.v[2].z)};
    for (int k = 0; k < 40; ++k) {
      const int x = source.integer(triangle.bounds.x_first, triangle.bounds.x_last);
      const int y = source.integer(triangle.bounds.y_first, triangle.bounds.y_last);
      const reference::GridPoint sample = reference::pixel_centre(x, y, bits);
      if (!reference::covers(grid(t), sample, reference::TieRule::kTopLeft)) {
        continue;
      }
      std::array<std::int64_t, 3> e{};
      for (std::size_t i = 0; i < 3; ++i) {
        const Edge& edge = triangle.edge[i];
        e[i] =
            edge.c + triangle.depth.bias[i] + ((std::int64_t{edge.a} * x + std::int64_t{edge.b} * y) << bits);
      }
      const std::uint32_t code =
          format == DepthFormat::kFloat32
              ? barycentric_float(triangle.depth, e[1], e[2])
              : barycentric_unorm(triangle.depth, vertex_depth_fraction(format), e[1], e[2]);
      const mpq_class off = ulps_off(format, code, reference::exact_depth(grid(t), z, sample));
      worst = std::max(worst, off);
      ++samples;
      REQUIRE(off <= 1);
      REQUIRE(code >= least);
      REQUIRE(code <= most);
    }
  }
  REQUIRE(samples > 3000);
  // docs/numerics.md derives these bounds
  CHECK(worst.get_d() < (format == DepthFormat::kUnorm16 ? 0.501 : 0.58));
}

TEST_CASE("barycentric depth just below a power of two does not wrap") {
  // 2A is a power of two, so the reciprocal has all its bits set, and the depth is 1 - 2^-30
  const int leg = 1 << 22;  // 2^14 pixels
  const std::uint32_t one = std::bit_cast<std::uint32_t>(1.0f);
  const std::uint32_t less = std::bit_cast<std::uint32_t>(1.0f - 1.0f / 256);
  const ScreenTriangle t{
      {ScreenVertex{127, 127, one}, ScreenVertex{127 + leg, 127, less}, ScreenVertex{127, 127 + leg, less}},
      0};
  SetupState state = open_state(kSize);
  state.depth_format = DepthFormat::kFloat32;
  SetupTriangle triangle;
  REQUIRE(setup(t, state, triangle) == SetupVerdict::kDrawn);
  const mpq_class exact =
      reference::exact_depth(grid(t),
                             {vertex_value(state.depth_format, one), vertex_value(state.depth_format, less),
                              vertex_value(state.depth_format, less)},
                             reference::pixel_centre(0, 0, 8));
  const auto e = [&](std::size_t i) { return triangle.edge[i].c + triangle.depth.bias[i]; };
  REQUIRE(ulps_off(state.depth_format, barycentric_float(triangle.depth, e(1), e(2)), exact) <= 1);
}

TEST_CASE("the plane is exact where its gradients are whole, and stays inside the range everywhere") {
  SECTION("a slope of 4 codes a pixel in x and 3 in y") {
    SetupState state = open_state(kSize);
    state.interpolator = DepthInterpolator::kPlane;
    const auto vertex = [](int x, int y) {
      return ScreenVertex{x * 256 + 128, y * 256 + 128,
                          static_cast<std::uint32_t>(1000 + 4 * x + 3 * y) << 7};
    };
    SetupTriangle triangle;
    REQUIRE(setup({{vertex(0, 0), vertex(63, 5), vertex(9, 60)}, 0}, state, triangle) ==
            SetupVerdict::kDrawn);
    for (int y = 5; y < 40; ++y) {
      for (int x = 9; x < 20; ++x) {
        REQUIRE(plane_code(triangle.depth, DepthFormat::kUnorm24, x, y) ==
                static_cast<std::uint32_t>(1000 + 4 * x + 3 * y));
      }
    }
  }
  SECTION("any triangle") {
    const DepthFormat format = GENERATE(DepthFormat::kUnorm16, DepthFormat::kUnorm24, DepthFormat::kFloat32);
    TriangleSource source(seed(), 16384, 8);
    SetupState state = open_state(16384);
    state.depth_format = format;
    state.interpolator = DepthInterpolator::kPlane;
    for (int n = 0; n < 3000; ++n) {
      const ScreenTriangle t = random_triangle(source, format);
      SetupTriangle triangle;
      if (setup(t, state, triangle) != SetupVerdict::kDrawn) {
        continue;
      }
      for (const int x : {0, triangle.bounds.x_first, triangle.bounds.x_last, 16383}) {
        for (const int y : {0, triangle.bounds.y_first, triangle.bounds.y_last, 16383}) {
          const std::uint32_t code = plane_code(triangle.depth, format, x, y);
          REQUIRE(code >= stored_code(format, std::min({t.v[0].z, t.v[1].z, t.v[2].z})));
          REQUIRE(code <= stored_code(format, std::max({t.v[0].z, t.v[1].z, t.v[2].z})));
        }
      }
    }
  }
}
