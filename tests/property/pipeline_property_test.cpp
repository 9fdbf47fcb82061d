// The five units together: laws that hold for every frame, and the reference as judge.
#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <map>

#include "../frames.hpp"
#include "halfspace/core/functional.hpp"
#include "halfspace/reference/rasterizer.hpp"
#include "halfspace/scene/validate.hpp"
#include "random.hpp"

using namespace halfspace;
using namespace halfspace::testing;

namespace {

/// A uniform position on the grid of 1/256 pixel.
glm::dvec3 random_point(Random& random, int low, int high) {
  return {static_cast<double>(random.between(low * 256, high * 256)) / 256,
          static_cast<double>(random.between(low * 256, high * 256)) / 256,
          static_cast<double>(random.between(0, 1 << 20)) / (1 << 20)};
}

std::vector<glm::dvec3> window_triangles(Random& random, int size, int count) {
  std::vector<glm::dvec3> window;
  for (int n = 0; n < count; ++n) {
    const bool small = random.between(0, 1) == 0;
    const glm::dvec3 centre = random_point(random, 0, size);
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 v = random_point(random, small ? -6 : -size / 2, small ? 6 : size / 2);
      window.emplace_back(centre.x + v.x, centre.y + v.y, v.z);
    }
  }
  return window;
}

template <class Value>
std::vector<Value> rows(const TiledImage<Value>& image) {
  std::vector<Value> values;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      values.push_back(image.at(x, y));
    }
  }
  return values;
}

Surface run_surface(const Frame& frame, const Config& config = {}) {
  validate(frame);
  return run_functional(frame, config).surfaces.at(0);
}

/// Every fan triangle around `centre` over a ring of points.
std::vector<glm::dvec3> fan(const glm::dvec3& centre, const std::vector<glm::dvec3>& ring) {
  std::vector<glm::dvec3> window;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    window.insert(window.end(), {centre, ring[i], ring[(i + 1) % ring.size()]});
  }
  return window;
}

class QuadChecker final : public PacketObserver {
 public:
  [[nodiscard]] bool wants_quads() const override { return true; }
  void quad(const QuadEvent& event) override {
    ++quads;
    aligned = aligned && event.x % 2 == 0 && event.y % 2 == 0;
    subset = subset && (event.passed & ~event.mask) == 0 && event.mask != 0;
    ordered = ordered && std::pair(event.draw, event.triangle) >= last;
    last = {event.draw, event.triangle};
    const int visits = ++seen[{event.draw, event.triangle, event.x, event.y}];
    once = once && visits == 1;
    full += event.mask == 0xF ? 1 : 0;
    for (int i = 0; i < 4; ++i) {
      covered += event.mask >> i & 1;
      helper_depth =
          helper_depth || ((event.mask >> i & 1) == 0 && event.depth[static_cast<std::size_t>(i)] != 0);
    }
  }
  std::uint64_t quads = 0;
  std::uint64_t covered = 0;
  std::uint64_t full = 0;
  bool aligned = true;
  bool subset = true;
  bool ordered = true;
  bool once = true;
  bool helper_depth = false;

 private:
  std::pair<std::uint32_t, std::uint32_t> last;
  std::map<std::array<std::uint32_t, 4>, int> seen;
};

}  // namespace

TEST_CASE("a fan through pixel centres covers each sample exactly once") {
  // the ring is the border of a square; the spokes run through pixel centres in every direction
  Random random(seed());
  for (int n = 0; n < 20; ++n) {
    std::vector<glm::dvec3> ring;
    for (int i = 0; i < 32; ++i) ring.emplace_back(16.5 + i, 16.5, 0.5);
    for (int i = 0; i < 32; ++i) ring.emplace_back(48.5, 16.5 + i, 0.5);
    for (int i = 0; i < 32; ++i) ring.emplace_back(48.5 - i, 48.5, 0.5);
    for (int i = 0; i < 32; ++i) ring.emplace_back(16.5, 48.5 - i, 0.5);
    const glm::dvec3 centre(20.5 + static_cast<double>(random.between(0, 24)),
                            20.5 + static_cast<double>(random.between(0, 24)), 0.5);
    FrameBuilder builder(64);
    builder.draw(fan(centre, ring));
    const Surface surface = run_surface(builder.frame);
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) {
        REQUIRE(surface.fragments.at(x, y) == (x >= 16 && x < 48 && y >= 16 && y < 48 ? 1 : 0));
      }
    }
  }
}

TEST_CASE("a jittered mesh has no gaps and no double covers") {
  const int bits = GENERATE(4, 6, 8);
  Random random(seed());
  constexpr int kCells = 128;
  const double cell = 1024.0 / kCells;
  const auto corner = [&](int x, int y, std::vector<glm::dvec3>& grid) {
    const bool border = x == 0 || y == 0 || x == kCells || y == kCells;
    const double jitter = border ? 0 : cell * 0.24;  // a quarter of a cell could fold a triangle over
    const auto offset = [&] { return jitter * static_cast<double>(random.between(-1000, 1000)) / 1000; };
    grid.emplace_back(x * cell + offset(), y * cell + offset(), 0.5);
  };
  std::vector<glm::dvec3> grid;
  for (int y = 0; y <= kCells; ++y) {
    for (int x = 0; x <= kCells; ++x) {
      corner(x, y, grid);
    }
  }
  std::vector<glm::dvec3> window;
  for (int y = 0; y < kCells; ++y) {
    for (int x = 0; x < kCells; ++x) {
      const std::size_t i = static_cast<std::size_t>(y * (kCells + 1) + x);
      const std::size_t below = i + kCells + 1;
      window.insert(window.end(),
                    {grid[i], grid[i + 1], grid[below], grid[i + 1], grid[below + 1], grid[below]});
    }
  }
  FrameBuilder builder(1024);
  builder.draw(window);
  Config config;
  config.raster.sub_pixel_bits = bits;
  const Surface surface = run_surface(builder.frame, config);
  const std::vector<std::uint16_t> counts = rows(surface.fragments);
  CHECK(std::count(counts.begin(), counts.end(), 0) == 0);
  CHECK(std::count_if(counts.begin(), counts.end(), [](std::uint16_t c) { return c > 1; }) == 0);
}

TEST_CASE("the image depends neither on vertex order, nor on draw order, tile size or skipped work") {
  Random random(seed());
  const DepthFormat format = GENERATE(DepthFormat::kUnorm16, DepthFormat::kUnorm24, DepthFormat::kFloat32);
  const std::vector<glm::dvec3> window = window_triangles(random, 128, 200);
  FrameBuilder builder(128, format);
  builder.draw(window);
  const Surface first = run_surface(builder.frame);
  const auto check = [&](const Surface& other) {
    CHECK(rows(other.codes) == rows(first.codes));
    CHECK(rows(other.fragments) == rows(first.fragments));
    CHECK(other.counters.quad_generator.quads == first.counters.quad_generator.quads);
    CHECK(other.counters.quad_generator.helpers == first.counters.quad_generator.helpers);
  };
  SECTION("vertices in any order") {
    std::vector<glm::dvec3> turned = window;
    for (std::size_t i = 0; i < turned.size(); i += 3) {
      std::shuffle(turned.begin() + static_cast<std::ptrdiff_t>(i),
                   turned.begin() + static_cast<std::ptrdiff_t>(i) + 3, std::mt19937_64(i));
    }
    FrameBuilder other(128, format);
    other.draw(turned);
    check(run_surface(other.frame));
  }
  SECTION("triangles in reverse, each a draw of its own") {
    FrameBuilder other(128, format);
    for (std::size_t i = window.size(); i > 0; i -= 3) {
      other.draw({window[i - 3], window[i - 2], window[i - 1]});
    }
    check(run_surface(other.frame));
  }
  SECTION("any machine") {
    for (const char* setting :
         {"tile_walker.tile_size=4", "tile_walker.tile_size=16", "block_walker.block_size=16",
          "block_walker.block_size=64", "block_walker.trivial_reject=false",
          "block_walker.sample_reject=true", "tile_walker.trivial_accept=false"}) {
      CAPTURE(setting);
      Config config;
      set_config(config, setting);
      validate(config);
      check(run_surface(builder.frame, config));
    }
  }
}

TEST_CASE("every quad leaves once, aligned and in API order, and the lanes add up") {
  const int tile_size = GENERATE(4, 8, 16);
  Random random(seed());
  FrameBuilder builder(128);
  for (int n = 0; n < 10; ++n) {
    builder.draw(window_triangles(random, 128, 30));
  }
  Config config;
  config.tile_walker.tile_size = tile_size;
  QuadChecker checker;
  const FrameResult result =
      run_functional(builder.frame, config, {.keep_visible = false, .observer = &checker});
  const QuadGeneratorCounters& counters = result.counters.quad_generator;
  CHECK((checker.aligned && checker.subset && checker.ordered && checker.once && !checker.helper_depth));
  CHECK(checker.quads == counters.quads);
  CHECK(checker.covered == counters.fragments);
  CHECK(checker.full == counters.quads_full);
  CHECK(counters.helpers == 4 * counters.quads - counters.fragments);
  std::uint64_t fragments = 0;
  std::uint64_t survivors = 0;
  for (const std::uint16_t count : rows(result.surfaces[0].fragments)) fragments += count;
  for (const std::uint16_t count : rows(result.surfaces[0].survivors)) survivors += count;
  CHECK(fragments == counters.fragments);
  CHECK(survivors == result.counters.early_z.survivors);
}

// Depths that the unit 2^-n leaves on their code are among them.
TEST_CASE("one unit of polygon offset moves every flat unorm depth by a code") {
  const auto [format, least] = GENERATE(std::pair{DepthFormat::kUnorm16, 0.5000152587890625},
                                        std::pair{DepthFormat::kUnorm24, 0.50390625});
  Random random(seed());
  for (int n = 0; n < 2000; ++n) {
    const double depth =
        n == 0 ? least : static_cast<float>(random.between(1000, (1 << 24) - 1000)) / 0x1p24f;
    CAPTURE(depth);
    const float units = n % 2 == 0 ? 1.0f : -1.0f;
    FrameBuilder builder(4, format);
    const std::vector<glm::dvec3> triangle{{0, 0, depth}, {8, 0, depth}, {0, 8, depth}};
    builder.draw(triangle).flags |= bits({Flag::kDepthTest, Flag::kDepthWrite});
    const std::uint32_t code = run_surface(builder.frame).codes.at(0, 0);
    Command& moved = builder.draw(triangle);
    moved.flags |= bits({Flag::kDepthTest, Flag::kDepthWrite, Flag::kPolygonOffset});
    moved.depth_func = DepthFunc::kAlways;
    moved.offset_units = units;
    const std::uint32_t after = run_surface(builder.frame).codes.at(0, 0);
    REQUIRE(std::int64_t{after} - code == (units > 0 ? 1 : -1));
  }
}

// The sides of the clip volume: what they cut off is outside the viewport.
TEST_CASE("nothing is drawn outside the viewport") {
  const auto drawn = [](const glm::vec4& viewport, FillRuleKey rule, reference::TieRule tie_rule,
                        std::uint32_t flags = 0) {
    FrameBuilder builder(64);
    Command& draw = builder.draw({{-500, -500, 0.5}, {900, -500, 0.5}, {-500, 900, 0.5}});
    draw.viewport = viewport;
    draw.flags |= flags;
    Config config;
    config.setup.fill_rule = rule;
    const std::vector<std::uint16_t> ours = rows(run_surface(builder.frame, config).fragments);
    REQUIRE(ours == reference::rasterize(builder.frame, {.rule = tie_rule}).at(0).fragments);
    PixelRect rect{.x_first = 64, .y_first = 64, .x_last = -1, .y_last = -1};
    int count = 0;
    for (int i = 0; i < 64 * 64; ++i) {
      if (ours[static_cast<std::size_t>(i)] != 0) {
        ++count;
        rect = {.x_first = std::min(rect.x_first, i % 64),
                .y_first = std::min(rect.y_first, i / 64),
                .x_last = std::max(rect.x_last, i % 64),
                .y_last = std::max(rect.y_last, i / 64)};
      }
    }
    CHECK(count == (rect.x_last - rect.x_first + 1) * (rect.y_last - rect.y_first + 1));
    return std::array{rect.x_first, rect.y_first, rect.x_last, rect.y_last};
  };
  const auto by_top_left = [&](const glm::vec4& viewport) {
    return drawn(viewport, FillRuleKey::kTopLeft, reference::TieRule::kTopLeft);
  };
  CHECK(by_top_left({0, 0, 32, 32}) == std::array{0, 0, 31, 31});
  CHECK(by_top_left({16, 48, 32, -32}) == std::array{16, 16, 47, 47});
  CHECK(by_top_left({8.25f, 8.75f, 16, 16}) == std::array{8, 9, 23, 24});
  CHECK(by_top_left({-1e9f, -1e9f, 2e9f, 2e9f}) == std::array{0, 0, 63, 63});
  // A centre on the border is in at the sides that the rule names.
  const glm::vec4 on_centres{8.5f, 8.5f, 16, 16};
  CHECK(by_top_left(on_centres) == std::array{8, 8, 23, 23});
  CHECK(drawn(on_centres, FillRuleKey::kBottomLeft, reference::TieRule::kBottomLeft) ==
        std::array{8, 9, 23, 24});
  CHECK(drawn(on_centres, FillRuleKey::kTopRight, reference::TieRule::kTopRight) == std::array{9, 8, 24, 23});
  CHECK(drawn(on_centres, FillRuleKey::kBottomRight, reference::TieRule::kBottomRight) ==
        std::array{9, 9, 24, 24});
  CHECK(drawn(on_centres, FillRuleKey::kNormalSign, reference::TieRule::kNormalSign) ==
        std::array{8, 8, 23, 23});
  // The draw's own rule, where the machine has none.
  CHECK(drawn(on_centres, FillRuleKey::kDraw, reference::TieRule::kTopLeft) == std::array{8, 8, 23, 23});
  CHECK(drawn(on_centres, FillRuleKey::kDraw, reference::TieRule::kBottomLeft,
              bits({Flag::kBottomLeftRule})) == std::array{8, 9, 23, 24});
}

TEST_CASE("every state of a draw gives what the reference gives") {
  const std::uint64_t start = seed();
  for (std::uint64_t n = 0; n < 300; ++n) {
    CAPTURE(start, n);
    Random random(start + n);
    const std::array formats{DepthFormat::kUnorm16, DepthFormat::kUnorm24, DepthFormat::kFloat32};
    FrameBuilder builder(64, formats[n % 3]);
    for (int d = 0; d < 4; ++d) {
      if (random.between(0, 3) == 0) {
        builder.clear(static_cast<float>(random.between(0, 8)) / 8).scissor = {
            static_cast<std::int32_t>(random.between(-9, 64)),
            static_cast<std::int32_t>(random.between(-9, 64)),
            static_cast<std::int32_t>(random.between(0, 80)),
            static_cast<std::int32_t>(random.between(0, 80))};
      }
      Command& draw = builder.draw(window_triangles(random, 64, 20));
      draw.depth_func = static_cast<DepthFunc>(random.between(0, 7));
      const bool test = random.between(0, 4) != 0;
      draw.flags = test ? bits({Flag::kDepthTest}) : 0;
      for (const Flag flag :
           {Flag::kDepthWrite, Flag::kFrontPositiveArea, Flag::kBottomLeftRule, Flag::kShaderDiscards,
            Flag::kEarlyTestsForced, Flag::kCullBack, Flag::kDepthClamp}) {
        const bool wanted =
            random.between(0, flag == Flag::kCullBack ? 3 : 1) == 0 && (flag != Flag::kDepthWrite || test);
        draw.flags |= wanted ? bits({flag}) : 0;
      }
      if (random.between(0, 1) == 0) {
        draw.scissor = {static_cast<std::int32_t>(random.between(-9, 64)),
                        static_cast<std::int32_t>(random.between(-9, 64)),
                        static_cast<std::int32_t>(random.between(0, 80)),
                        static_cast<std::int32_t>(random.between(0, 80))};
      }
      if (random.between(0, 2) == 0) {
        draw.viewport = {8, 72, 64, -64};  // moved and turned over, still on the grid
        draw.depth_range = {0.25f, 0.75f};
      } else if (random.between(0, 2) == 0) {
        // On the grid too, its borders on centres and between them.
        draw.viewport = {
            static_cast<float>(random.between(-8, 40)) / 2, static_cast<float>(random.between(-8, 40)) / 2,
            static_cast<float>(64 << random.between(0, 1)), static_cast<float>(64 << random.between(0, 1))};
      }
    }
    const bool opaque = n % 2 == 0;
    Config config;
    config.late_z.mode = opaque ? LateZ::kOpaque : LateZ::kNoWrite;
    // Half of the frames have the rules of their draws, the others one of the five.
    std::optional<reference::TieRule> rule;
    if (random.between(0, 1) == 0) {
      const reference::TieRuleInfo& info =
          reference::kTieRules[static_cast<std::size_t>(random.between(0, 4))];
      rule = info.rule;
      set_config(config, "setup.fill_rule", std::string(info.name));
    }
    const Surface ours = run_surface(builder.frame, config);
    const reference::Surface theirs =
        reference::rasterize(
            builder.frame,
            {.rule = rule, .late_z = opaque ? reference::LateZ::kOpaque : reference::LateZ::kNoWrite})
            .at(0);

    REQUIRE(rows(ours.fragments) == theirs.fragments);
    CHECK(ours.counters.quad_generator.quads == theirs.counters.quads);
    CHECK(ours.counters.quad_generator.helpers == theirs.counters.helper_fragments);
    // Positions are on the grid, so both interpolate the same plane and differ by rounding: a code of the
    // format, or a few units of float32 where the reference's double plane cancels. Where a test was that
    // close, survivors may differ.
    const std::vector<std::uint32_t> codes = rows(ours.codes);
    const std::vector<std::uint16_t> survivors = rows(ours.survivors);
    int apart = 0;
    for (std::size_t i = 0; i < codes.size(); ++i) {
      const double difference =
          std::abs(static_cast<double>(depth_of_code(ours.format, codes[i])) - theirs.depth[i]);
      apart += difference > 1.1 / 65535 || survivors[i] != theirs.survivors[i] ? 1 : 0;
    }
    CHECK(apart <= 2);
  }
}

TEST_CASE("frames of any clip-space triangles agree with the reference up to the snapping of cuts") {
  const std::uint64_t start = seed();
  std::uint64_t pixels = 0;
  std::uint64_t apart = 0;
  for (std::uint64_t n = 0; n < 200; ++n) {
    Random random(start + n);
    const bool is_float = n % 2 != 0;
    FrameBuilder builder(64, is_float ? DepthFormat::kFloat32 : DepthFormat::kUnorm24);
    Command& draw = builder.draw(std::vector<glm::dvec3>(24));
    for (glm::vec4& v : builder.frame.vertices) {
      const auto coordinate = [&](int most) {
        return static_cast<float>(random.between(-most * 256, most * 256)) / 256;
      };
      v = {coordinate(4), coordinate(4), coordinate(3), coordinate(3)};
      v.x = random.between(0, 60) == 0 ? std::numeric_limits<float>::quiet_NaN() : v.x;
    }
    draw.flags |= random.between(0, 1) == 0 ? bits({Flag::kDepthClamp}) : 0;
    draw.flags |= random.between(0, 1) == 0 ? bits({Flag::kNdcZMinusOneToOne}) : 0;
    // With depth clamp the largest z, and with it the unit of a float32 offset, is as large as the guard band
    // lets it be, and the reference has another one.
    if (random.between(0, 1) == 0 && !(is_float && draw.has(Flag::kDepthClamp))) {
      draw.flags |= bits({Flag::kPolygonOffset});
      draw.offset_factor = 0.5f;
      draw.offset_units = 100;
    }
    const Surface ours = run_surface(builder.frame);
    const reference::Surface theirs = reference::rasterize(builder.frame, {}).at(0);
    REQUIRE(ours.counters.front_end.non_finite == theirs.counters.non_finite);
    const std::vector<std::uint16_t> fragments = rows(ours.fragments);
    const std::vector<std::uint32_t> codes = rows(ours.codes);
    for (std::size_t i = 0; i < codes.size(); ++i) {
      const double difference =
          std::abs(static_cast<double>(depth_of_code(ours.format, codes[i])) - theirs.depth[i]);
      ++pixels;
      apart += fragments[i] != theirs.fragments[i] || difference > 2e-3 ? 1 : 0;
    }
  }
  CAPTURE(start, pixels, apart);
  CHECK(static_cast<double>(apart) < 1e-4 * static_cast<double>(pixels));
}
