// Depth of the units against exact rational arithmetic.
#include "halfspace/units/depth_barycentric.hpp"

#include <bit>
#include <catch2/catch.hpp>

#include "../triangles.hpp"
#include "halfspace/reference/exact_depth.hpp"
#include "halfspace/units/depth_plane.hpp"
#include "halfspace/units/z_test.hpp"
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

/// The code at one covered sample, as its tile gives it.
std::uint32_t code_at(const SetupTriangle& triangle, const EarlyZState& state, int x, int y) {
  constexpr int kTile = 16;  // of the sizes the one with the largest error
  const int corner_x = x / kTile * kTile;
  const int corner_y = y / kTile * kTile;
  QuadBurst burst;
  burst.coverage.tile_x = static_cast<std::uint16_t>(x / kTile);
  burst.coverage.tile_y = static_cast<std::uint16_t>(y / kTile);
  for (std::size_t i = 0; i < 2; ++i) {
    const Edge& edge = triangle.edge[i + 1];
    burst.coverage.e[i] = edge.c + ((std::int64_t{edge.a} * corner_x + std::int64_t{edge.b} * corner_y)
                                    << state.sub_pixel_bits);
  }
  const int bit = (y - corner_y) * kTile + (x - corner_x);
  burst.coverage.mask.word[static_cast<std::size_t>(bit / 64)] = std::uint64_t{1} << (bit % 64);
  TileCodes<kTile> codes{};
  interpolate_tile<kTile>(triangle, burst, state, codes);
  return codes[static_cast<std::size_t>(bit)];
}

EarlyZState plane_state(DepthFormat format, int sub_pixel_bits) {
  return {.test = true,
          .format = format,
          .interpolator = DepthInterpolator::kPlane,
          .sub_pixel_bits = sub_pixel_bits};
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

TEST_CASE("depth is within one unit of the last place, and inside the range of the vertices") {
  const auto interpolator = GENERATE(DepthInterpolator::kPlane, DepthInterpolator::kBarycentric);
  const DepthFormat format = GENERATE(DepthFormat::kUnorm16, DepthFormat::kUnorm24, DepthFormat::kFloat32);
  const int bits = GENERATE(4, 8);
  const int size = GENERATE(64, 16384);
  const std::uint64_t start = seed() + static_cast<std::uint64_t>(bits);
  CAPTURE(start, bits, size, static_cast<int>(format), static_cast<int>(interpolator));
  TriangleSource source(start, size, bits);
  SetupState state = open_state(size, bits);
  state.depth_format = format;
  state.interpolator = interpolator;
  EarlyZState early_z = plane_state(format, bits);
  early_z.interpolator = interpolator;
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
    // The words of the plane have a last place of their own, which counts near 0.
    const bool has_floor = interpolator == DepthInterpolator::kPlane && format == DepthFormat::kFloat32;
    const mpq_class largest = std::max({z[0], z[1], z[2]});
    const mpq_class floor = largest / mpq_class(std::uint64_t{1} << 56);
    for (int k = 0; k < 40; ++k) {
      const int x = source.integer(triangle.bounds.x_first, triangle.bounds.x_last);
      const int y = source.integer(triangle.bounds.y_first, triangle.bounds.y_last);
      const reference::GridPoint sample = reference::pixel_centre(x, y, bits);
      if (!reference::covers(grid(t), sample, reference::TieRule::kTopLeft)) {
        continue;
      }
      const std::uint32_t code = code_at(triangle, early_z, x, y);
      const mpq_class exact = reference::exact_depth(grid(t), z, sample);
      const mpq_class off = ulps_off(format, code, exact);
      ++samples;
      if (has_floor && exact < mpq_class(largest) / (mpq_class(1u << 31) * 2)) {
        REQUIRE(abs(vertex_value(format, code) - exact) < floor);
      } else {
        worst = std::max(worst, off);
        REQUIRE(off <= 1);
      }
      REQUIRE(code >= least);
      REQUIRE(code <= most);
    }
  }
  REQUIRE(samples > 2000);
  // docs/numerics.md derives these bounds
  const double bound = format == DepthFormat::kUnorm16                   ? 0.501
                       : interpolator == DepthInterpolator::kBarycentric ? 0.58
                       : format == DepthFormat::kUnorm24                 ? 0.69
                                                                         : 0.75;
  CHECK(worst.get_d() < bound);
}

// Depth clamp lets vertices leave [0, 1]; fragments are kept in it.
TEST_CASE("depth of triangles that leave [0, 1] is right inside of it") {
  const auto interpolator = GENERATE(DepthInterpolator::kPlane, DepthInterpolator::kBarycentric);
  const DepthFormat format = GENERATE(DepthFormat::kUnorm16, DepthFormat::kUnorm24, DepthFormat::kFloat32);
  CAPTURE(seed(), static_cast<int>(format), static_cast<int>(interpolator));
  TriangleSource source(seed(), kSize, 8);
  SetupState state = open_state(kSize);
  state.depth_format = format;
  state.interpolator = interpolator;
  EarlyZState early_z = plane_state(format, 8);
  early_z.interpolator = interpolator;
  int inside = 0;
  for (int n = 0; n < 6000; ++n) {
    ScreenTriangle t = source.next();
    std::array<mpq_class, 3> z;
    mpq_class largest = 1;
    for (std::size_t i = 0; i < 3; ++i) {
      const double depth = std::ldexp(source.integer(-(1 << 24), 1 << 24), source.integer(-26, -10));
      t.v[i].z = vertex_depth_code(format, depth);
      z[i] = format == DepthFormat::kFloat32
                 ? mpq_class(static_cast<float>(depth))
                 : mpq_class(t.v[i].z) /
                       (mpq_class(1u << vertex_depth_fraction(format)) * max_unorm_code(format));
      largest = std::max(largest, mpq_class(abs(z[i])));
    }
    SetupTriangle triangle;
    if (setup(t, state, triangle) != SetupVerdict::kDrawn) {
      continue;
    }
    for (int k = 0; k < 20; ++k) {
      const int x = source.integer(triangle.bounds.x_first, triangle.bounds.x_last);
      const int y = source.integer(triangle.bounds.y_first, triangle.bounds.y_last);
      const reference::GridPoint sample = reference::pixel_centre(x, y, 8);
      if (!reference::covers(grid(t), sample, reference::TieRule::kTopLeft)) {
        continue;
      }
      const mpq_class depth = reference::exact_depth(grid(t), z, sample);
      const mpq_class exact = std::clamp<mpq_class>(depth, 0, 1);
      inside += depth == exact ? 1 : 0;
      const std::uint32_t code = code_at(triangle, early_z, x, y);
      // docs/numerics.md: a unit of the last place, and what is absolute beside it
      const mpq_class lost = interpolator == DepthInterpolator::kBarycentric ? mpq_class(largest / (1 << 26))
                             : format == DepthFormat::kFloat32
                                 ? mpq_class(largest / mpq_class(std::uint64_t{1} << 56))
                                 : mpq_class(0);
      const mpq_class unit = format == DepthFormat::kFloat32 ? mpq_class(exact / (1 << 23))
                                                             : mpq_class(1) / max_unorm_code(format);
      const mpq_class got = format == DepthFormat::kFloat32
                                ? reference::float_value(std::bit_cast<float>(code))
                                : reference::unorm_value(code, unorm_bits(format));
      REQUIRE(abs(got - exact) <= unit + lost);
    }
  }
  REQUIRE(inside > 500);
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
  state.interpolator = DepthInterpolator::kBarycentric;
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

TEST_CASE("sums of plane depth about the end of a short word do not wrap") {
  const ScreenTriangle witness{{ScreenVertex{11148, 6784, 2147483646}, ScreenVertex{12734, 6784, 2147483646},
                                ScreenVertex{7628, 15130, 0}},
                               0};
  SetupState state = open_state(kSize);
  state.limits.most = 0xFFFFFF;
  SetupTriangle triangle;
  REQUIRE(setup(witness, state, triangle) == SetupVerdict::kDrawn);
  CHECK(code_at(triangle, plane_state(DepthFormat::kUnorm24, 8), 46, 26) == 0xFFFFFF);

  TriangleSource source(seed(), kSize, 8);
  CAPTURE(seed());
  int drawn = 0;
  while (drawn < 2000) {
    ScreenTriangle t = source.next();
    for (ScreenVertex& v : t.v) {  // in the last code's upper half, or beyond 1: the last code
      v.z = kShortWordEnd + source.integer(-64, 127);
    }
    if (setup(t, state, triangle) == SetupVerdict::kDrawn) {
      ++drawn;
      const PixelRect& box = triangle.bounds;
      const int x = source.integer(box.x_first, box.x_last);
      const int y = source.integer(box.y_first, box.y_last);
      if (reference::covers(grid(t), reference::pixel_centre(x, y, 8), reference::TieRule::kTopLeft)) {
        REQUIRE(code_at(triangle, plane_state(DepthFormat::kUnorm24, 8), x, y) == 0xFFFFFF);
      }
    }
  }
}

TEST_CASE("the plane is exact where its gradients are whole") {
  SetupState state = open_state(kSize);
  state.interpolator = DepthInterpolator::kPlane;
  const auto vertex = [](int x, int y) {
    return ScreenVertex{x * 256 + 128, y * 256 + 128, static_cast<std::uint32_t>(1000 + 4 * x + 3 * y) << 7};
  };
  SetupTriangle triangle;
  REQUIRE(setup({{vertex(0, 0), vertex(63, 5), vertex(9, 60)}, 0}, state, triangle) == SetupVerdict::kDrawn);
  for (int y = 5; y < 40; ++y) {
    for (int x = 9; x < 20; ++x) {
      REQUIRE(code_at(triangle, plane_state(DepthFormat::kUnorm24, 8), x, y) ==
              static_cast<std::uint32_t>(1000 + 4 * x + 3 * y));
    }
  }
}

// The quotient comes from a double wherever that is near enough.
TEST_CASE("gradients of a plane are the quotients cut towards zero") {
  Random random(seed());
  for (int n = 0; n < 200000; ++n) {
    const auto any = [&](int bits) {
      const std::int64_t limit = std::int64_t{1} << random.between(0, bits);
      return random.between(-limit, limit);
    };
    const std::int64_t area2 = random.between(1, std::int64_t{1} << random.between(0, 48));
    const std::array<ScreenVertex, 3> v{ScreenVertex{}, ScreenVertex{.z = random.between(0, INT32_MAX)},
                                        ScreenVertex{.z = random.between(0, INT32_MAX)}};
    std::array<Edge, 3> edge{};
    for (Edge& e : edge) {
      e = {.a = static_cast<std::int32_t>(any(24)), .b = static_cast<std::int32_t>(any(24))};
    }
    DepthEquation equation;
    make_depth_equation(v, 0, edge, area2, DepthFormat::kUnorm24, {}, DepthInterpolator::kPlane, equation);
    const PlaneEquation& plane = equation.plane;
    const auto exact = [&](std::int64_t step1, std::int64_t step2) {
      const mpz_class numerator = mpz_class(v[1].z) * step1 + mpz_class(v[2].z) * step2;
      mpz_class quotient;
      mpz_tdiv_q(quotient.get_mpz_t(), mpz_class(numerator << kGradientFraction).get_mpz_t(),
                 mpz_class(area2).get_mpz_t());
      return quotient;
    };
    constexpr std::uint64_t kLow = (std::uint64_t{1} << 62) - 1;
    const auto low_bits = [](const mpz_class& value) {
      return mpz_class(value & mpz_class((mpz_class(1) << 62) - 1)).get_ui();
    };
    CAPTURE(area2, v[1].z, v[2].z, edge[1].a, edge[2].a, edge[1].b, edge[2].b);
    REQUIRE((static_cast<std::uint64_t>(plane.dx) & kLow) == low_bits(exact(edge[1].a, edge[2].a)));
    REQUIRE((static_cast<std::uint64_t>(plane.dy) & kLow) == low_bits(exact(edge[1].b, edge[2].b)));
  }
}
