// The textbook rasterizer on frames whose result is a formula.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <numeric>
#include <vector>

#include "halfspace/numerics/error.hpp"
#include "halfspace/reference/clip.hpp"
#include "halfspace/reference/rasterizer.hpp"
#include "halfspace/reference/window.hpp"
#include "random.hpp"

namespace {

using halfspace::Command;
using halfspace::CommandKind;
using halfspace::Flag;
using halfspace::Frame;
using halfspace::Target;
using halfspace::reference::Counters;
using halfspace::reference::LateZ;
using halfspace::reference::Options;
using halfspace::reference::Surface;
using halfspace::testing::Random;
using halfspace::testing::seed;

constexpr std::uint32_t kLess = 1, kLessOrEqual = 3;  // numbers of the frame format
constexpr std::uint32_t kUnorm16 = 1, kUnorm24 = 2, kFloat32 = 4;

std::uint32_t bits(std::initializer_list<Flag> flags) {
  std::uint32_t result = 0;
  for (const Flag flag : flags) result |= static_cast<std::uint32_t>(flag);
  return result;
}

/// One target of width x height.
Frame empty_frame(std::uint32_t width, std::uint32_t height, std::uint32_t format = kFloat32) {
  Frame frame;
  Target target;
  target.width = width;
  target.height = height;
  target.depth_format = static_cast<halfspace::DepthFormat>(format);
  target.depth_surface = 0;
  frame.targets.push_back(target);
  return frame;
}

/// A draw of the given vertices, three a triangle, with a viewport over the whole target; returned to be
/// adjusted.
Command& add_draw(Frame& frame, const std::vector<glm::vec4>& vertices,
                  std::uint32_t flags = bits({Flag::kDepthTest, Flag::kDepthWrite})) {
  Command draw;
  draw.kind = CommandKind::kDraw;
  draw.flags = flags;
  draw.depth_func = static_cast<halfspace::DepthFunc>(kLess);
  draw.viewport = {0, 0, static_cast<float>(frame.targets[0].width),
                   static_cast<float>(frame.targets[0].height)};
  draw.first_index = static_cast<std::uint32_t>(frame.indices.size());
  draw.index_count = static_cast<std::uint32_t>(vertices.size());
  draw.first_vertex = static_cast<std::uint32_t>(frame.vertices.size());
  draw.vertex_count = draw.index_count;
  for (std::uint32_t i = 0; i < draw.index_count; ++i) frame.indices.push_back(i);
  frame.vertices.insert(frame.vertices.end(), vertices.begin(), vertices.end());
  frame.commands.push_back(draw);
  return frame.commands.back();
}

/// Two triangles over the rectangle of normalised device coordinates, clockwise on the screen, at one depth.
std::vector<glm::vec4> rectangle(float x0, float y0, float x1, float y1, float z) {
  return {{x0, y0, z, 1}, {x1, y0, z, 1}, {x1, y1, z, 1}, {x0, y0, z, 1}, {x1, y1, z, 1}, {x0, y1, z, 1}};
}

std::vector<glm::vec4> screen(float z) { return rectangle(-1, -1, 1, 1, z); }

Surface only_surface(const Frame& frame, LateZ late_z = LateZ::kOpaque) {
  Options options;
  options.late_z = late_z;
  const std::vector<Surface> surfaces = rasterize(frame, options);
  REQUIRE(surfaces.size() == 1);
  return surfaces[0];
}

}  // namespace

TEST_CASE("Two triangles over the screen cover each pixel once", "[property][rasterizer]") {
  Frame frame = empty_frame(16, 16);
  add_draw(frame, screen(0.25f));
  const Surface s = only_surface(frame);
  CHECK(s.fragments == std::vector<std::uint16_t>(256, 1));
  CHECK(s.survivors == s.fragments);
  CHECK(s.depth == std::vector<float>(256, 0.25f));
  // 64 blocks; the 8 on the diagonal belong to both triangles, each with 4 pixels of which one triangle has 3
  // (top-left: the diagonal's samples go to the triangle for which it is a left edge) and the other 1.
  CHECK(s.counters.quads == 64 + 8);
  CHECK(s.counters.helper_fragments == 4 * (64 + 8) - 256);
  CHECK(s.counters.drawn == 2);
}

TEST_CASE("A surface that nothing touches is 1", "[property][rasterizer]") {
  for (const std::uint32_t format : {kUnorm16, kUnorm24, kFloat32}) {
    CHECK(only_surface(empty_frame(3, 5, format)).depth == std::vector<float>(15, 1.0f));
  }
}

TEST_CASE("A clear fills its rectangle, and only that", "[property][rasterizer]") {
  Frame frame = empty_frame(4, 4);
  Command clear;
  clear.kind = CommandKind::kClear;
  clear.flags = bits({Flag::kClearDepth});
  clear.clear_depth = 0.5f;
  clear.scissor = {1, 2, 2, 100};
  frame.commands.push_back(clear);
  CHECK(only_surface(frame).depth ==
        std::vector<float>{1, 1, 1, 1, 1, 1, 1, 1, 1, 0.5f, 0.5f, 1, 1, 0.5f, 0.5f, 1});
  frame.commands[0].flags = bits({Flag::kClearColor});
  CHECK(only_surface(frame).depth == std::vector<float>(16, 1.0f));
}

TEST_CASE("The scissor cuts, in pixels of the target", "[property][rasterizer]") {
  Frame frame = empty_frame(8, 8);
  add_draw(frame, screen(0)).scissor = {-3, 5, 6, 2};
  const Surface s = only_surface(frame);
  for (std::size_t y = 0; y < 8; ++y) {
    for (std::size_t x = 0; x < 8; ++x) {
      CAPTURE(x, y);
      CHECK(s.fragments[y * 8 + x] == (x < 3 && y >= 5 && y < 7 ? 1 : 0));
    }
  }
}

TEST_CASE("All eight depth functions, in the three orders", "[property][rasterizer]") {
  // Stored 0.5; what comes is nearer, equal, farther. The order of the functions is that of the frame format.
  constexpr std::array<std::array<bool, 3>, 8> kPasses = {{{false, false, false},
                                                           {true, false, false},
                                                           {false, true, false},
                                                           {true, true, false},
                                                           {false, false, true},
                                                           {true, false, true},
                                                           {false, true, true},
                                                           {true, true, true}}};
  constexpr std::array<float, 3> kIncoming = {0.25f, 0.5f, 0.75f};
  for (std::uint32_t func = 0; func < 8; ++func) {
    for (std::size_t i = 0; i < 3; ++i) {
      Frame frame = empty_frame(4, 4);
      add_draw(frame, screen(0.5f));
      add_draw(frame, screen(kIncoming[i])).depth_func = static_cast<halfspace::DepthFunc>(func);
      CAPTURE(func, i);
      const Surface s = only_surface(frame);
      CHECK(s.depth == std::vector<float>(16, kPasses[func][i] ? kIncoming[i] : 0.5f));
      CHECK(s.counters.depth_passed == (kPasses[func][i] ? 32u : 16u));
      CHECK(s.fragments == std::vector<std::uint16_t>(16, 2));
    }
  }
}

TEST_CASE("Without a test everything passes; without a write nothing changes", "[property][rasterizer]") {
  Frame frame = empty_frame(4, 4);
  add_draw(frame, screen(0.5f));
  add_draw(frame, screen(0.9f), 0).depth_func = static_cast<halfspace::DepthFunc>(0);
  add_draw(frame, screen(0.1f), bits({Flag::kDepthTest}));
  const Surface s = only_surface(frame);
  CHECK(s.survivors == std::vector<std::uint16_t>(16, 3));
  CHECK(s.depth == std::vector<float>(16, 0.5f));
}

TEST_CASE("Draws whose shader may change the outcome write only when taken as opaque",
          "[property][rasterizer]") {
  for (const Flag late :
       {Flag::kShaderDiscards, Flag::kShaderWritesDepth, Flag::kShaderSideEffects, Flag::kAlphaToCoverage}) {
    for (const bool forced : {false, true}) {
      Frame frame = empty_frame(2, 2);
      Command& draw = add_draw(frame, screen(0.5f), bits({Flag::kDepthTest, Flag::kDepthWrite, late}));
      if (forced) draw.flags |= bits({Flag::kEarlyTestsForced});
      CHECK(only_surface(frame, LateZ::kOpaque).depth[0] == 0.5f);
      CHECK(only_surface(frame, LateZ::kNoWrite).depth[0] == (forced ? 0.5f : 1.0f));
      CHECK(only_surface(frame, LateZ::kNoWrite).counters.depth_passed == 4);
    }
  }
}

TEST_CASE("Culling follows the winding on the screen", "[property][rasterizer]") {
  for (const bool mirrored : {false, true}) {
    for (const bool front_positive : {false, true}) {
      for (const Flag cull : {Flag::kCullFront, Flag::kCullBack}) {
        Frame frame = empty_frame(8, 8);
        Command& draw = add_draw(frame, screen(0));
        draw.flags |= bits({cull}) | (front_positive ? bits({Flag::kFrontPositiveArea}) : 0u);
        if (mirrored) {  // a viewport upside down turns clockwise into counter-clockwise
          draw.viewport.y = 8;
          draw.viewport.w = -8;
        }
        const bool front = front_positive == !mirrored;
        const bool culled = front == (cull == Flag::kCullFront);
        CAPTURE(mirrored, front_positive, front);
        CHECK(only_surface(frame).counters.culled == (culled ? 2u : 0u));
        CHECK(only_surface(frame).counters.drawn == (culled ? 0u : 2u));
      }
    }
  }
}

TEST_CASE("The near and far plane cut where depth leaves its range", "[property][rasterizer]") {
  // Depth grows from left to right, from -0.5 to 1.5: the range 0 to 1 is the middle half of the screen.
  std::vector<glm::vec4> ramp = screen(0);
  for (glm::vec4& v : ramp) v.z = v.x < 0 ? -0.5f : 1.5f;
  for (const bool clamp : {false, true}) {
    Frame frame = empty_frame(16, 4);
    add_draw(frame, ramp,
             bits({Flag::kDepthTest, Flag::kDepthWrite}) | (clamp ? bits({Flag::kDepthClamp}) : 0u))
        .depth_func = static_cast<halfspace::DepthFunc>(kLessOrEqual);
    const Surface s = only_surface(frame);
    for (std::size_t x = 0; x < 16; ++x) {
      CAPTURE(clamp, x);
      const bool inside = x >= 4 && x < 12;
      CHECK(s.fragments[16 + x] == (inside || clamp ? 1 : 0));
      const double expected = -0.5 + (static_cast<double>(x) + 0.5) / 8;
      CHECK(s.depth[16 + x] == Approx(inside || clamp ? std::clamp(expected, 0.0, 1.0) : 1.0).margin(1e-7));
    }
  }
}

TEST_CASE("The clip volume of OpenGL reaches from -1 to 1", "[property][rasterizer]") {
  Frame frame = empty_frame(2, 2);
  add_draw(frame, screen(-1), bits({Flag::kDepthTest, Flag::kDepthWrite, Flag::kNdcZMinusOneToOne}))
      .depth_range = {0.25f, 0.75f};
  CHECK(only_surface(frame).depth[0] == 0.25f);
  frame.commands[0].flags = bits({Flag::kDepthTest, Flag::kDepthWrite});
  CHECK(only_surface(frame).counters.clipped_away == 2);
}

TEST_CASE("A triangle behind the eye is cut at it", "[property][rasterizer]") {
  // A floor one unit below the eye that runs from behind it to far in front (w is the distance, z/w the depth
  // of a near plane at 0.1 and a far one at infinity): it covers the pixels below the horizon, each once.
  const auto project = [](float x, float y, float distance) {
    return glm::vec4{x, y, distance - 0.1f, distance};
  };
  Frame frame = empty_frame(32, 32);
  const glm::vec4 a = project(-1e6f, 1, -50), b = project(1e6f, 1, -50), c = project(1e6f, 1, 1e6f),
                  d = project(-1e6f, 1, 1e6f);
  add_draw(frame, {a, b, c, a, c, d});
  const Surface s = only_surface(frame);
  for (std::size_t y = 0; y < 32; ++y) {
    CAPTURE(y);
    CHECK(std::accumulate(s.fragments.begin() + static_cast<std::ptrdiff_t>(y * 32),
                          s.fragments.begin() + static_cast<std::ptrdiff_t>(y * 32 + 32),
                          0) == (y < 16 ? 0 : 32));
  }
}

TEST_CASE("Vertices far outside the window are cut by the guard band without a trace",
          "[property][rasterizer]") {
  // Clipping in double is exact to 2^-53 of the distance between the vertices, so that the cut lies where it
  // should up to here; with vertices 1e20 screens apart it would be off by 1e4 screens.
  for (const float reach : {2.0f, 31.0f, 33.0f, 1e4f, 1e9f}) {
    Frame frame = empty_frame(64, 48);
    add_draw(frame, rectangle(-reach, -reach, reach, reach, 0.5f));
    const Surface s = only_surface(frame);
    CAPTURE(reach);
    CHECK(std::all_of(s.fragments.begin(), s.fragments.end(), [](std::uint16_t n) { return n == 1; }));
    CHECK(std::all_of(s.depth.begin(), s.depth.end(), [](float z) { return z == 0.5f; }));
    CHECK(s.counters.drawn == 2);
  }
}

TEST_CASE("What clipping leaves is on the 16-bit window, at any viewport", "[property][rasterizer]") {
  using halfspace::reference::Homogeneous;
  using halfspace::reference::Polygon;
  CAPTURE(seed());
  Random random(seed());
  constexpr double kLimit = 32767;
  int left = 0;
  for (int round = 0; round < 500; ++round) {
    Command draw;
    draw.viewport = {random.between(-8000, 8000), random.between(-8000, 8000), random.between(1, 16384),
                     random.between(-16384, -1)};
    Polygon polygon;
    for (int i = 0; i < 3; ++i) {
      const auto coordinate = [&] { return static_cast<double>(random.between(-100000, 100000)) / 1000; };
      polygon.push_back({coordinate(), coordinate(), 0.5, coordinate() / 10 + 10});
    }
    const auto planes = halfspace::reference::guard_band_planes(32, kLimit, draw.viewport.x, draw.viewport.y,
                                                                draw.viewport.z, draw.viewport.w);
    for (const Homogeneous& v : halfspace::reference::clip(polygon, planes)) {
      if (v.w == 0) continue;
      ++left;
      const halfspace::reference::WindowVertex window = to_window(v, draw);
      CAPTURE(round, v.x, v.y, v.w);
      // A thousandth of a pixel for the cut itself, which divides by w after it was made.
      REQUIRE(std::max(std::abs(window.x), std::abs(window.y)) <= kLimit + 0.001);
    }
  }
  REQUIRE(left > 500);
}

TEST_CASE("Infinities, NaN and w <= 0 drop the triangle and are counted", "[property][rasterizer]") {
  const float infinity = std::numeric_limits<float>::infinity();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (int component = 0; component < 4; ++component) {
    for (const float value : {infinity, -infinity, nan}) {
      Frame frame = empty_frame(4, 4);
      std::vector<glm::vec4> vertices = screen(0.5f);
      vertices[1][component] = value;
      add_draw(frame, vertices);
      const Counters c = only_surface(frame).counters;
      CHECK(c.non_finite == 1);
      CHECK(c.drawn == 1);
    }
  }
  Frame frame = empty_frame(4, 4);
  add_draw(frame, {{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}, {-1, -1, 0, -1}, {1, -1, 0, -1}, {1, 1, 0, -1}});
  CHECK(only_surface(frame).counters.clipped_away == 2);
}

TEST_CASE("Depth is rounded to the nearest code of its format", "[property][rasterizer]") {
  CAPTURE(seed());
  Random random(seed());
  for (int round = 0; round < 200; ++round) {
    const float z = std::ldexp(static_cast<float>(random.between(0, 1 << 24)), -24);
    for (const std::uint32_t format : {kUnorm16, kUnorm24, kFloat32}) {
      Frame frame = empty_frame(2, 2, format);
      add_draw(frame, screen(z)).depth_func = static_cast<halfspace::DepthFunc>(kLessOrEqual);
      const double step = format == kUnorm16 ? 1.0 / 65535 : format == kUnorm24 ? 1.0 / 16777215 : 0;
      CAPTURE(round, z, format);
      CHECK(std::abs(static_cast<double>(only_surface(frame).depth[0]) - z) <= step * 0.5001 + 0x1p-25);
    }
  }
}

TEST_CASE("Polygon offset is m * factor + r * units, clamped", "[property][rasterizer]") {
  // Depth from 0.25 on the left to 0.5 on the right of 16 pixels: m = 1/64, and the largest depth 0.5 makes
  // the float32 step 2^-24.
  std::vector<glm::vec4> ramp = screen(0);
  for (glm::vec4& v : ramp) v.z = v.x < 0 ? 0.25f : 0.5f;
  const auto offset_of = [&](std::uint32_t format, float factor, float units, float clamp) {
    Frame plain = empty_frame(16, 16, format);
    add_draw(plain, ramp);
    Frame moved = plain;
    moved.commands[0].flags |= bits({Flag::kPolygonOffset});
    moved.commands[0].offset_factor = factor;
    moved.commands[0].offset_units = units;
    moved.commands[0].offset_clamp = clamp;
    return static_cast<double>(only_surface(moved).depth[0]) -
           static_cast<double>(only_surface(plain).depth[0]);
  };
  CHECK(offset_of(kFloat32, 2, 0, 0) == Approx(2.0 / 64).margin(1e-7));
  CHECK(offset_of(kFloat32, -2, 0, 0) == Approx(-2.0 / 64).margin(1e-7));
  CHECK(offset_of(kFloat32, 0, 4096, 0) == Approx(4096 * 0x1p-24).margin(1e-7));
  CHECK(offset_of(kUnorm24, 0, 4096, 0) == Approx(4096 * 0x1p-24).margin(2e-7));
  CHECK(offset_of(kUnorm16, 0, 64, 0) == Approx(64 * 0x1p-16).margin(2e-5));
  CHECK(offset_of(kFloat32, 2, 0, 0.01f) == Approx(0.01).margin(1e-7));
  CHECK(offset_of(kFloat32, -2, 0, -0.01f) == Approx(-0.01).margin(1e-7));
}

TEST_CASE("Fragments of a pixel stop counting at 65535", "[property][rasterizer]") {
  Frame frame = empty_frame(1, 1);
  std::vector<glm::vec4> many;
  for (int i = 0; i < 66000; ++i) many.insert(many.end(), {{-4, -4, 0, 1}, {4, -4, 0, 1}, {0, 4, 0, 1}});
  add_draw(frame, many, 0);
  const Surface s = only_surface(frame);
  CHECK(s.fragments[0] == 65535);
  CHECK(s.counters.covered_fragments == 66000);
}

TEST_CASE("Every triangle has one fate, and quads hold all fragments", "[property][rasterizer]") {
  CAPTURE(seed());
  Random random(seed());
  for (int round = 0; round < 100; ++round) {
    Frame frame = empty_frame(33, 17, round % 2 == 0 ? kUnorm24 : kFloat32);
    std::vector<glm::vec4> vertices;
    for (int i = 0; i < 60; ++i) {
      glm::vec4 v;
      for (int k = 0; k < 4; ++k) v[k] = static_cast<float>(random.between(-60, 60)) / 20;
      vertices.push_back(v);
    }
    add_draw(frame, vertices).flags |= bits({round % 3 == 0 ? Flag::kCullBack : Flag::kBlend});
    Options options;
    options.subpixel_bits = static_cast<int>(random.between(4, 8));
    const Surface s = rasterize(frame, options)[0];
    const Counters& c = s.counters;
    CAPTURE(round, options.subpixel_bits);
    CHECK(c.triangles == 20);
    CHECK(c.non_finite + c.clipped_away + c.degenerate + c.culled + c.drawn == c.triangles);
    CHECK(c.covered_fragments + c.helper_fragments == 4 * c.quads);
    CHECK(c.covered_fragments == std::accumulate(s.fragments.begin(), s.fragments.end(), std::uint64_t{0}));
    CHECK(c.depth_passed == std::accumulate(s.survivors.begin(), s.survivors.end(), std::uint64_t{0}));
  }
}

TEST_CASE("A frame that contradicts itself is an input error", "[property][rasterizer]") {
  const auto fails = [](const Frame& frame, const Options& options = {}) {
    CHECK_THROWS_AS(rasterize(frame, options), halfspace::InputError);
  };
  Frame frame = empty_frame(2, 2);
  add_draw(frame, screen(0));
  for (const int subpixel_bits : {3, 9}) {
    Options options;
    options.subpixel_bits = subpixel_bits;
    fails(frame, options);
  }
  Frame bad = frame;
  bad.commands[0].target = 1;
  fails(bad);
  bad = frame;
  bad.commands[0].index_count = 9;
  fails(bad);
  bad = frame;
  bad.indices[3] = 6;
  fails(bad);
  bad = frame;
  bad.commands[0].viewport.x = std::numeric_limits<float>::quiet_NaN();
  fails(bad);
  bad = frame;
  bad.targets.push_back(bad.targets[0]);
  bad.targets[1].width = 3;
  fails(bad);
}
