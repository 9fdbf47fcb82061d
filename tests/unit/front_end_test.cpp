// front_end: viewport, snapping, clipping, polygon offset and depth clamp follow the specification's
// formulas.
#include "halfspace/scene/front_end.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "../frames.hpp"
#include "../property/random.hpp"

using namespace halfspace;
using namespace halfspace::testing;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

struct Processed {
  std::vector<ScreenTriangle> triangles;
  FrontEndCounters counters;
};

/// One triangle of clip-space vertices through the front end of a 64 x 64 target.
Processed process(const std::array<glm::vec4, 3>& clip, std::uint32_t flags = 0,
                  DepthFormat format = DepthFormat::kUnorm24, const Command& state = {}) {
  FrameBuilder builder(64, format);
  Command& draw = builder.draw({{}, {}, {}});
  builder.frame.vertices.assign(clip.begin(), clip.end());
  draw.flags = flags;
  draw.depth_range = state.depth_range;
  draw.offset_factor = state.offset_factor;
  draw.offset_units = state.offset_units;
  draw.offset_clamp = state.offset_clamp;
  Processed result;
  FrontEnd(builder.frame, draw, format, 8).process(0, result.triangles, result.counters);
  return result;
}

double unorm24(const ScreenVertex& v) { return v.z / std::ldexp(16777215.0, 7); }

}  // namespace

TEST_CASE("front_end: divides, applies the viewport and the depth range") {
  Command state;
  state.depth_range = {0.25f, 0.75f};
  const Processed zero_to_one =
      process({{{0, 0, 0, 2}, {1, 0, 1, 2}, {0, 1, 2, 2}}}, 0, DepthFormat::kUnorm24, state);
  REQUIRE(zero_to_one.triangles.size() == 1);
  const auto& v = zero_to_one.triangles[0].v;
  CHECK((v[0].x == 32 * 256 && v[0].y == 32 * 256));  // (x / w + 1) * 64 / 2
  CHECK((v[1].x == 48 * 256 && v[2].y == 48 * 256));
  CHECK(unorm24(v[0]) == Approx(0.25));
  CHECK(unorm24(v[1]) == Approx(0.5));
  CHECK(unorm24(v[2]) == Approx(0.75));
  const Processed symmetric = process({{{0, 0, -2, 2}, {1, 0, 0, 2}, {0, 1, 2, 2}}},
                                      bits({Flag::kNdcZMinusOneToOne}), DepthFormat::kUnorm24, state);
  CHECK(unorm24(symmetric.triangles[0].v[0]) == Approx(0.25));
  CHECK(unorm24(symmetric.triangles[0].v[1]) == Approx(0.5));
  CHECK(unorm24(symmetric.triangles[0].v[2]) == Approx(0.75));
}

TEST_CASE("front_end: snaps to the nearest sub-pixel, halves to the even one") {
  // x / w + 1 times 32 pixels times 256: a clip x of k / 16384 lies on a half for odd k
  const auto snapped = [](float k) {
    return process({{{k / 16384 - 1, -1, 0, 1}, {1, -1, 0, 1}, {-1, 1, 0, 1}}}).triangles.at(0).v[0].x;
  };
  CHECK(snapped(1) == 0);
  CHECK(snapped(3) == 2);
  CHECK(snapped(5) == 2);
  CHECK(snapped(7) == 4);
  CHECK(snapped(2.5f) == 1);
  CHECK(snapped(-1) == 0);
  CHECK(snapped(-3) == -2);
}

TEST_CASE("front_end: cuts at the near plane where the depth says") {
  // the edge from w = 1, z = 1 to z = -1 leaves the volume z >= 0 half way
  const Processed p = process({{{0, 0, 1, 2}, {1, 0, 1, 2}, {0, 0, -1, 2}}});
  CHECK(p.counters.clipped == 1);
  REQUIRE(p.triangles.size() == 2);  // a corner cut off leaves a quadrangle
  int on_near = 0;
  for (const ScreenTriangle& t : p.triangles) {
    for (const ScreenVertex& v : t.v) {
      on_near += v.z == 0;
      CHECK(v.y == 32 * 256);
    }
  }
  CHECK(on_near >= 2);
  CHECK(p.triangles[0].v[2].x + p.triangles[1].v[2].x == 40 * 256 + 32 * 256);  // x / w = 0.25 and 0
}

TEST_CASE("front_end: counts what it drops") {
  SECTION("positions that are not finite") {
    for (const float bad : {kNan, kInf, -kInf}) {
      for (int i = 0; i < 12; ++i) {
        std::array<glm::vec4, 3> clip{{{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}}};
        clip[static_cast<std::size_t>(i / 4)][i % 4] = bad;
        const Processed p = process(clip);
        CHECK((p.counters.non_finite == 1 && p.triangles.empty()));
      }
    }
  }
  SECTION("nothing inside") {
    const Processed behind = process({{{0, 0, -1, 1}, {1, 0, -1, 1}, {0, 1, -2, 1}}});
    CHECK((behind.counters.clipped_away == 1 && behind.triangles.empty()));
    const Processed negative_w = process({{{0, 0, 0, -1}, {1, 0, 0, -1}, {0, 1, 0, -1}}});
    CHECK((negative_w.counters.clipped_away == 1 && negative_w.triangles.empty()));
  }
  SECTION("w of 0") {
    const Processed p = process({{{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}}});
    CHECK((p.counters.degenerate == 1 && p.triangles.empty()));
  }
}

TEST_CASE("front_end: keeps every vertex inside the guard band, whatever comes") {
  Random random(seed());
  const int limit = 32767 * 256;
  for (int n = 0; n < 20000; ++n) {
    std::array<glm::vec4, 3> clip;
    for (glm::vec4& v : clip) {
      for (int i = 0; i < 4; ++i) {
        const auto mantissa = static_cast<float>(random.between(-1000, 1000)) / 500;
        v[i] = std::ldexp(mantissa, static_cast<int>(random.between(0, 3) == 0 ? random.between(-140, 126)
                                                                               : random.between(-2, 14)));
      }
    }
    const bool clamp = random.between(0, 1) == 0;
    const bool offset = random.between(0, 1) == 0;
    Command state;
    state.offset_factor = 1e30f;
    state.offset_units = -1e30f;
    const Processed p =
        process(clip, (clamp ? bits({Flag::kDepthClamp}) : 0) | (offset ? bits({Flag::kPolygonOffset}) : 0),
                DepthFormat::kUnorm24, state);
    for (const ScreenTriangle& t : p.triangles) {
      for (const ScreenVertex& v : t.v) {
        REQUIRE(std::abs(v.x) <= limit);
        REQUIRE(std::abs(v.y) <= limit);
        REQUIRE(std::abs(v.z) <= std::int64_t{1} << (kVertexDepthBits + kVertexDepthRange));
      }
    }
    REQUIRE(p.counters.emitted == p.triangles.size());
  }
}

TEST_CASE("front_end: polygon offset is factor * slope + units * r, within its clamp") {
  // depth rises by 1/64 a pixel in x and 1/128 in y: the slope is the larger
  const std::array<glm::vec4, 3> plane{{{-1, -1, 0.125f, 1}, {0, -1, 0.625f, 1}, {-1, 0, 0.375f, 1}}};
  Command state;
  state.offset_factor = 2;
  state.offset_units = 8;
  const auto offset = [&](DepthFormat format) {
    const ScreenTriangle t = process(plane, bits({Flag::kPolygonOffset}), format, state).triangles.at(0);
    CHECK(t.v[0].z == vertex_depth_code(format, 0.125));  // it is added to fragments
    return format == DepthFormat::kFloat32
               ? std::bit_cast<float>(static_cast<std::uint32_t>(t.offset))
               : t.offset / std::ldexp(max_unorm_code(format), vertex_depth_fraction(format));
  };
  CHECK(offset(DepthFormat::kUnorm24) == Approx(2.0 / 64 + 8.0 / 16777215).epsilon(1e-8));
  CHECK(offset(DepthFormat::kUnorm16) == Approx(2.0 / 64 + 8.0 / 65535).epsilon(1e-8));
  // float32: r = 2^(e - 23) of the largest depth, 0.625, whose e is -1
  CHECK(offset(DepthFormat::kFloat32) == static_cast<float>(2.0 / 64 + 8 * std::ldexp(1, -24)));
  state.offset_clamp = 0.01f;
  CHECK(offset(DepthFormat::kUnorm24) == Approx(0.01).epsilon(1e-6));
  state.offset_clamp = -0.01f;
  state.offset_factor = -2;
  CHECK(offset(DepthFormat::kUnorm24) == Approx(-0.01).epsilon(1e-6));
}

TEST_CASE("front_end: the slope of polygon offset is that of the snapped triangle") {
  // 20 pixels long and a tenth of a pixel wide; depth rises across it. Snapping makes it 26/256 of a pixel.
  const float wide = 0.1f / 32;
  const std::array<glm::vec4, 3> needle{{{0, 0, 0.25f, 1}, {0, 20.0f / 32, 0.25f, 1}, {wide, 0, 0.375f, 1}}};
  Command state;
  state.offset_factor = 1;
  state.offset_clamp = 0;
  const ScreenTriangle t =
      process(needle, bits({Flag::kPolygonOffset}), DepthFormat::kUnorm24, state).triangles.at(0);
  REQUIRE(t.v[2].x - t.v[0].x == 26);
  CHECK(t.offset / std::ldexp(16777215.0, 7) == Approx(0.125 * 256 / 26).epsilon(1e-8));
}

TEST_CASE("front_end: with depth clamp vertices keep depths beyond the range, and their place") {
  const Processed p =
      process({{{-1, -1, -1, 1}, {1, -1, 2, 1}, {-1, 1, -32767, 1}}}, bits({Flag::kDepthClamp}));
  REQUIRE(p.triangles.size() == 1);
  CHECK(p.counters.clipped == 0);
  CHECK(p.counters.far_depth == 0);
  const auto& v = p.triangles[0].v;
  CHECK(unorm24(v[0]) == -1);
  CHECK(unorm24(v[1]) == 2);
  CHECK(unorm24(v[2]) == -32767);
}

// One that is too far for a vertex depth: the plane's value at each sample, in one piece or another.
TEST_CASE("front_end: a triangle too far outside is resolved sample by sample") {
  const DepthFormat format = GENERATE(DepthFormat::kUnorm24, DepthFormat::kFloat32);
  const float far = GENERATE(40000.0f, -3e6f, 6e7f, 0x1p66f);
  const Processed p = process({{{-1, -1, 0.5f, 1}, {1, -1, far, 1}, {-1, 1, -3 * far, 1}}},
                              bits({Flag::kDepthClamp}), format);
  CHECK(p.counters.far_depth == 1);
  CHECK(p.counters.emitted == p.triangles.size());
  std::array<int, 64 * 64> pieces{};
  int inside = 0;
  for (const ScreenTriangle& t : p.triangles) {
    REQUIRE((t.v[0].x == 0 && t.v[0].y == 0 && t.v[1].x == 64 * 256 && t.v[2].y == 64 * 256));
    REQUIRE((t.v[0].z == t.v[1].z && t.v[0].z == t.v[2].z && t.offset == 0));
    for (int y = t.within.y_first; y <= t.within.y_last; ++y) {
      for (int x = t.within.x_first; x <= t.within.x_last; ++x) {
        const double u = (x + 0.5) / 64;
        const double w = (y + 0.5) / 64;
        if (u + w > 1) {
          continue;  // not covered
        }
        ++pieces.at(static_cast<std::size_t>(y * 64 + x));
        const double z = std::clamp(0.5 * (1 - u - w) + far * (u - 3 * w), 0.0, 1.0);
        inside += z > 0 && z < 1 ? 1 : 0;
        const double got = format == DepthFormat::kFloat32
                               ? std::bit_cast<float>(static_cast<std::uint32_t>(t.v[0].z))
                               : unorm24(t.v[0]);
        REQUIRE(got == Approx(z).margin(1e-7));
      }
    }
  }
  CHECK(inside > 10);
  CHECK(std::ranges::count(pieces, 1) == 64 * 65 / 2);
  CHECK(std::ranges::count(pieces, 0) == 64 * 63 / 2);
}

// Far vertices and an offset that takes them into [0, 1] again: the sums are vertex depths like others.
TEST_CASE("front_end: far vertices that polygon offset brings near are one piece") {
  Command state;
  state.offset_units = 32768.3F * 16777215.0F;
  const Processed p = process({{{-1, -1, -32768, 1}, {1, -1, -32768, 1}, {-1, 1, -32768.25f, 1}}},
                              bits({Flag::kDepthClamp, Flag::kPolygonOffset}), DepthFormat::kUnorm24, state);
  REQUIRE(p.triangles.size() == 1);
  CHECK(p.counters.far_depth == 0);
  CHECK(p.triangles[0].offset == 0);
  const double offset = static_cast<double>(state.offset_units) / 16777215.0;
  CHECK(unorm24(p.triangles[0].v[0]) == Approx(offset - 32768).margin(1e-6));
  CHECK(unorm24(p.triangles[0].v[2]) == Approx(offset - 32768.25).margin(1e-6));
}

// Vertices at 0, so that centres of pixels lie where depth is 0 or next to it.
TEST_CASE("front_end: float32 depth next to 0 is resolved sample by sample, the rest left as it is") {
  // 0 along y = 15.5 pixels: a row of centres; next to 0 on it
  const float tiny = GENERATE(0.0f, 1e-30f);
  const float y = 2 * 15.5f / 64 - 1;
  const Processed p = process({{{-1, y, 0, 1}, {1, y, tiny, 1}, {-1, 1, 1, 1}}}, 0, DepthFormat::kFloat32);
  CHECK(p.counters.tiny_depth == 1);
  CHECK(p.counters.emitted == p.triangles.size());
  int flat = 0;
  std::array<int, 64 * 64> pieces{};
  for (const ScreenTriangle& t : p.triangles) {
    REQUIRE((t.v[0].x == 0 && t.v[1].x == 64 * 256 && t.v[2].y == 64 * 256));
    for (int row = t.within.y_first; row <= t.within.y_last; ++row) {
      for (int x = t.within.x_first; x <= t.within.x_last; ++x) {
        ++pieces.at(static_cast<std::size_t>(row * 64 + x));
        if (row == 15) {
          ++flat;
          const float z = std::bit_cast<float>(static_cast<std::uint32_t>(t.v[0].z));
          REQUIRE((t.v[0].z == t.v[1].z && t.v[0].z == t.v[2].z));
          REQUIRE(z == Approx(tiny * (x + 0.5) / 64).epsilon(1e-6));
        } else {
          REQUIRE(t.v[2].z == std::bit_cast<std::uint32_t>(1.0f));
        }
      }
    }
  }
  CHECK(flat == 64);
  CHECK(std::ranges::count(pieces, 1) == 64 * (64 - 15));
}
