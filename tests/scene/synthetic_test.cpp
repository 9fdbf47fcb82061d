// Are the synthetic frames what their help says?
#include "halfspace/scene/synthetic.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "halfspace/config/config.hpp"
#include "halfspace/core/functional.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/numerics/split_mix.hpp"
#include "halfspace/scene/load.hpp"
#include "halfspace/scene/validate.hpp"

using namespace halfspace;
using Catch::Matchers::Contains;

namespace {

struct Corner {
  double x = 0;  ///< pixels
  double y = 0;
  double z = 0;
};
using Triangle = std::array<Corner, 3>;

/// A thousandth of a pixel: what clip space leaves of a position.
constexpr double kNear = 1e-3;

std::vector<Triangle> triangles_of(const Frame& frame) {
  const Command& draw = frame.commands.at(1);
  std::vector<Triangle> triangles(draw.index_count / 3);
  for (std::size_t i = 0; i < draw.index_count; ++i) {
    const glm::vec4 v = frame.vertices.at(draw.first_vertex + frame.indices.at(draw.first_index + i));
    CHECK(v.w == 1);
    triangles[i / 3][i % 3] = {(double{v.x} + 1) / 2 * frame.targets[0].width,
                               (double{v.y} + 1) / 2 * frame.targets[0].height, v.z};
  }
  return triangles;
}

double area(const Triangle& t) {
  return std::abs((t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[2].x - t[0].x) * (t[1].y - t[0].y)) / 2;
}

double nearest(const Triangle& t) { return std::min({t[0].z, t[1].z, t[2].z}); }
double farthest(const Triangle& t) { return std::max({t[0].z, t[1].z, t[2].z}); }

double longest_edge(const Triangle& t) {
  double longest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    longest = std::max(longest, std::hypot(t[i].x - t[(i + 1) % 3].x, t[i].y - t[(i + 1) % 3].y));
  }
  return longest;
}

/// Every area lies in [low, high], and their mean is that of a uniform distribution, within a tenth of the
/// range.
void check_areas(const std::vector<Triangle>& triangles, double low, double high) {
  double sum = 0;
  for (const Triangle& t : triangles) {
    REQUIRE(area(t) >= low * (1 - kNear));
    REQUIRE(area(t) <= high * (1 + kNear));
    sum += area(t);
  }
  CHECK(sum / static_cast<double>(triangles.size()) == Approx((low + high) / 2).margin((high - low) / 10));
}

/// Triangle i is nowhere nearer than triangle i - step.
void check_front_to_back(const std::vector<Triangle>& triangles, std::size_t step) {
  for (std::size_t i = step; i < triangles.size(); ++i) {
    REQUIRE(nearest(triangles[i]) > farthest(triangles[i - step]));
  }
}

void check_reversed(std::string_view forth, std::string_view back) {
  const std::vector<Triangle> a = triangles_of(synthetic_frame(forth));
  const std::vector<Triangle> b = triangles_of(synthetic_frame(back));
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      REQUIRE(a[i][k].x == b[b.size() - 1 - i][k].x);
      REQUIRE(a[i][k].y == b[b.size() - 1 - i][k].y);
      REQUIRE(a[i][k].z == b[b.size() - 1 - i][k].z);
    }
  }
}

std::uint64_t pixels_covered(const FrameResult& result) {
  std::uint64_t pixels = 0;
  const auto& fragments = result.surfaces.at(0).fragments;
  for (int y = 0; y < fragments.height(); ++y) {
    for (int x = 0; x < fragments.width(); ++x) {
      pixels += fragments.at(x, y) != 0 ? 1 : 0;
    }
  }
  return pixels;
}

}  // namespace

TEST_CASE("splitmix64 gives the numbers of its authors") {
  SplitMix64 random(1234567);
  for (const std::uint64_t number : {6457827717110365317u, 3203168211198807973u, 9817491932198370423u}) {
    CHECK(random.next() == number);
  }
}

TEST_CASE("every synthetic frame is valid, inside its screen, on the grid, and the same each time") {
  std::set<std::string_view> names;
  for (const SyntheticInfo& info : synthetic_frames()) {
    CAPTURE(info.name);
    CHECK(names.insert(info.name).second);
    const Frame frame = synthetic_frame(info.name);
    CHECK_NOTHROW(validate(frame));
    CHECK(frame.name == info.name);
    const Target& target = frame.targets.at(0);
    CHECK(target.depth_format == DepthFormat::kUnorm24);
    REQUIRE(frame.commands.size() == 2);
    CHECK(frame.commands[0].kind == CommandKind::kClear);
    CHECK(frame.commands[0].clear_depth == 1);
    CHECK(frame.commands[1].depth_func == DepthFunc::kLess);
    CHECK(frame.commands[1].has(Flag::kDepthTest));
    CHECK(frame.commands[1].has(Flag::kDepthWrite));
    for (const Triangle& triangle : triangles_of(frame)) {
      for (const Corner& c : triangle) {
        REQUIRE((c.x >= 0 && c.x <= target.width));
        REQUIRE((c.y >= 0 && c.y <= target.height));
        REQUIRE((c.z >= 0 && c.z < 1));
        REQUIRE(std::abs(c.x * 256 - std::round(c.x * 256)) < 256 * kNear);
        REQUIRE(std::abs(c.y * 256 - std::round(c.y * 256)) < 256 * kNear);
      }
    }
    const Frame again = load("synthetic:" + std::string(info.name));
    CHECK(again.vertices == frame.vertices);
    CHECK(again.indices == frame.indices);
    CHECK(again.meta == frame.meta);
    CHECK(synthetic_help().find(std::string(info.name)) != std::string::npos);
  }
}

TEST_CASE("one_triangle covers half of 512x512") {
  const Frame frame = synthetic_frame("one_triangle");
  CHECK(frame.targets[0].width == 512);
  CHECK(frame.targets[0].height == 512);
  const std::vector<Triangle> triangles = triangles_of(frame);
  REQUIRE(triangles.size() == 1);
  CHECK(area(triangles[0]) == 131072);
  // The diagonal meets 512 pixel centres, and is a right edge of the triangle: none of them is inside.
  const FrameResult result = run_functional(frame, Config{});
  CHECK(result.counters.quad_generator.fragments == 512 * 511 / 2);
}

TEST_CASE("random_122: 1,000 triangles of mean area 122") {
  const Frame frame = synthetic_frame("random_122");
  CHECK(frame.targets[0].width == 512);
  CHECK(frame.targets[0].height == 512);
  const std::vector<Triangle> triangles = triangles_of(frame);
  REQUIRE(triangles.size() == 1000);
  double sum = 0;
  for (const Triangle& t : triangles) {
    sum += area(t);
  }
  CHECK(sum / 1000 == Approx(122).epsilon(0.02));
}

TEST_CASE(
    "the lists on 1920x1080 are as long as their divisor says, and of the size that they are named for") {
  struct Expected {
    const char* name;
    std::size_t customary;  ///< triangles, before the division
  };
  for (const Expected& e :
       {Expected{"tiny_rand", 1'000'000}, Expected{"tiny_grid", 1'000'000}, Expected{"medium", 100'000},
        Expected{"large_ftb", 2000}, Expected{"large_btf", 2000}, Expected{"sliver", 20'000},
        Expected{"fill_ftb", 128}, Expected{"fill_btf", 128}, Expected{"mesh_bunny", 18'700},
        Expected{"mesh_crowd", 810'880}}) {
    CAPTURE(e.name);
    const auto all = synthetic_frames();
    const auto info = std::ranges::find(all, e.name, &SyntheticInfo::name);
    REQUIRE(info != all.end());
    const Frame frame = synthetic_frame(e.name);
    CHECK(frame.targets[0].width == 1920);
    CHECK(frame.targets[0].height == 1080);
    CHECK(frame.commands[1].index_count / 3 * static_cast<std::size_t>(info->divisor) == e.customary);
  }
  check_areas(triangles_of(synthetic_frame("tiny_rand")), 1, 2);
  check_areas(triangles_of(synthetic_frame("medium")), 50, 150);
  check_areas(triangles_of(synthetic_frame("large_ftb")), 30'000, 70'000);
}

TEST_CASE("front to back and back to front are the same triangles in opposite order") {
  check_front_to_back(triangles_of(synthetic_frame("large_ftb")), 1);
  check_front_to_back(triangles_of(synthetic_frame("fill_ftb")), 2);
  check_reversed("large_ftb", "large_btf");
  check_reversed("fill_ftb", "fill_btf");
}

TEST_CASE("sliver: 1000 pixels long and less than one wide, in all directions") {
  int steep = 0;
  const std::vector<Triangle> triangles = triangles_of(synthetic_frame("sliver"));
  for (const Triangle& t : triangles) {
    const double length = longest_edge(t);
    const double width = 2 * area(t) / length;
    REQUIRE(length == Approx(1000).margin(0.02));
    REQUIRE(width > 0.1 - 2.0 / 256);
    REQUIRE(width < 0.9 + 2.0 / 256);
    const auto [left, right] = std::minmax({t[0].x, t[1].x, t[2].x});
    const auto [top, bottom] = std::minmax({t[0].y, t[1].y, t[2].y});
    steep += bottom - top > right - left ? 1 : 0;
  }
  const auto count = static_cast<double>(triangles.size());
  CHECK(steep == Approx(count / 2).margin(4 * std::sqrt(count) / 2));  // of 4 standard deviations
}

TEST_CASE("tiny_grid covers its rows without a gap and without overdraw") {
  const FrameResult grid = run_functional(synthetic_frame("tiny_grid"), Config{});
  const std::uint64_t fragments = grid.counters.quad_generator.fragments;
  CHECK(pixels_covered(grid) == fragments);
  CHECK(static_cast<double>(fragments) == Approx(1920 * 10 * 2.16).epsilon(0.01));
  CHECK(fragments == grid.counters.early_z.survivors);
}

TEST_CASE("fill covers every pixel in each layer", "[exhaustive]") {
  const FrameResult front = run_functional(synthetic_frame("fill_ftb"), Config{});
  const FrameResult back = run_functional(synthetic_frame("fill_btf"), Config{});
  CHECK(front.counters.quad_generator.fragments == 4u * 1920 * 1080);
  CHECK(front.counters.early_z.survivors == 1u * 1920 * 1080);
  CHECK(back.counters.quad_generator.fragments == 4u * 1920 * 1080);
  CHECK(back.counters.early_z.survivors == 4u * 1920 * 1080);
}

TEST_CASE("a short list is the same as ever, to the last bit: results and recordings refer to it") {
  const auto hash = [](std::uint64_t value, const void* data, std::size_t size) {  // FNV-1a
    for (std::size_t i = 0; i < size; ++i) {
      value = (value ^ static_cast<const unsigned char*>(data)[i]) * 0x100000001b3u;
    }
    return value;
  };
  const std::pair<const char*, std::uint64_t> known[] = {
      {"one_triangle", 0x6fb38b598fd94d37}, {"random_122", 0x468be80f3879ecae},
      {"tiny_rand", 0x6af7f636cf98c595},    {"tiny_grid", 0x7180d2df470aef9b},
      {"medium", 0x410694040cdfe21d},       {"large_ftb", 0x2c59912d8287b75a},
      {"large_btf", 0x786515c5d7f2fb9a},    {"sliver", 0x7e439039aae18bd3},
      {"fill_ftb", 0xe4067878f469a664},     {"fill_btf", 0x1ae9483acacf6605},
  };
  for (const auto& [name, value] : known) {
    CAPTURE(name);
    const Frame frame = synthetic_frame(name);
    std::uint64_t found = 0xcbf29ce484222325u;
    found = hash(found, frame.vertices.data(), frame.vertices.size() * sizeof(glm::vec4));
    found = hash(found, frame.indices.data(), frame.indices.size() * sizeof(std::uint32_t));
    found = hash(found, frame.meta.data(), frame.meta.size());
    CHECK(found == value);
  }
}

TEST_CASE("a full list is of customary length, inside the screen, and begins as the short one does",
          "[exhaustive]") {
  for (const SyntheticInfo& info : synthetic_frames()) {
    CAPTURE(info.name);
    const std::string name = std::string(info.name) + ":full";
    const Frame small = synthetic_frame(info.name);
    const Frame full = load("synthetic:" + name);
    CHECK(full.name == name);
    CHECK(full.commands.at(1).index_count ==
          small.commands.at(1).index_count * static_cast<std::size_t>(info.divisor));
    CHECK(full.meta.find("\"divisor\":1,") != std::string::npos);
    CHECK((info.divisor == 1 || full.meta.find(info.full_help) != std::string::npos));
    CHECK(std::ranges::all_of(full.vertices, [](const glm::vec4& v) {
      return v.x >= -1 && v.x <= 1 && v.y >= -1 && v.y <= 1 && v.z >= 0 && v.z < 1 && v.w == 1;
    }));
    // Depth slabs are thinner where there are more of them.
    const bool ordered = info.name.ends_with("_ftb") || info.name.ends_with("_btf");
    for (std::size_t i = 0; !ordered && i < small.vertices.size(); ++i) {
      REQUIRE(small.vertices[i] == full.vertices[i]);
    }
  }
  check_front_to_back(triangles_of(synthetic_frame("large_ftb:full")), 1);
  check_front_to_back(triangles_of(synthetic_frame("fill_ftb:full")), 2);
  check_reversed("large_ftb:full", "large_btf:full");
}

TEST_CASE("the meshes are closed surfaces: their areas, with signs, add up to nothing") {
  for (const char* name : {"mesh_bunny:full", "mesh_crowd:full"}) {
    CAPTURE(name);
    const std::vector<Triangle> triangles = triangles_of(synthetic_frame(name));
    double sum = 0;
    double magnitude = 0;
    for (const Triangle& t : triangles) {
      const double signed_area =
          ((t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[2].x - t[0].x) * (t[1].y - t[0].y)) / 2;
      sum += signed_area;
      magnitude += std::abs(signed_area);
    }
    CHECK(std::abs(sum) < 1e-3 * magnitude);
  }
}

TEST_CASE("a synthetic frame has float32 depth where that is asked for, and the same triangles") {
  const Frame fixed = synthetic_frame("medium");
  const Frame real = synthetic_frame("medium", DepthFormat::kFloat32);
  CHECK(real.targets.at(0).depth_format == DepthFormat::kFloat32);
  CHECK(real.vertices == fixed.vertices);
}

TEST_CASE("an unknown synthetic frame is an error that names the legal ones") {
  CHECK_THROWS_AS(load("synthetic:tiny"), InputError);
  CHECK_THROWS_WITH(load("synthetic:tiny"), Contains("synthetic:tiny: no such frame") &&
                                                Contains("tiny_rand, tiny_grid") && Contains("fill_btf") &&
                                                !Contains("\n"));
  CHECK_THROWS_WITH(load("synthetic:tiny:full"), Contains("synthetic:tiny:full: no such frame"));
  for (const char* suffix : {"", "Full", "full ", "full:full", "50"}) {
    const std::string name = "synthetic:medium:" + std::string(suffix);
    CHECK_THROWS_WITH(load(name), Contains(name + ": what follows the name is \"" + suffix + "\"; legal: ") &&
                                      Contains("synthetic:medium or synthetic:medium:full"));
  }
  CHECK_THROWS_WITH(load("synthetic:"), Contains("synthetic:: ") && Contains("one_triangle"));
}
