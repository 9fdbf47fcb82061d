// Inner coverage beside outer pixels, tier 3 of conservative rasterization: each pixel that is drawn against
// the definition of which squares a triangle holds.
#include "halfspace/units/inner_coverage.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "../line_frames.hpp"
#include "../result_difference.hpp"
#include "halfspace/config/config.hpp"
#include "halfspace/core/functional.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/reference/pixel_square.hpp"
#include "halfspace/scene/frame_builder.hpp"
#include "halfspace/stress/family.hpp"
#include "random.hpp"

using namespace halfspace;
using halfspace::testing::samples;
using halfspace::testing::seed;

namespace {

Config tier3_machine(int uncertainty, DepthInterpolator interpolator = DepthInterpolator::kBarycentric) {
  Config config;
  config.raster.conservative = Conservative::kOuter;
  config.raster.inner_coverage = true;
  config.raster.uncertainty = uncertainty;
  config.depth.interpolator = interpolator;
  validate(config);
  return config;
}

/// Holds the inner pixels of each quad against the definition.
class InnerJudge final : public PacketObserver {
 public:
  explicit InnerJudge(const Config& config) : config_(config) {}

  [[nodiscard]] bool wants_quads() const override { return true; }
  [[nodiscard]] bool wants_walk() const override { return true; }

  void set_up(const SetupEvent& event) override {
    if (event.verdict == SetupVerdict::kDrawn) {
      const std::array<ScreenVertex, 3>& v = event.screen->v;
      triangles_[{event.draw, event.triangle, event.screen->piece}] = {
          {{v[0].x, v[0].y}, {v[1].x, v[1].y}, {v[2].x, v[2].y}}};
    }
  }

  void quad(const QuadEvent& quad) override {
    const reference::GridTriangle& triangle = triangles_.at({quad.draw, quad.triangle, quad.piece});
    for (std::uint32_t i = 0; i < 4; ++i) {
      const bool covered = (quad.mask >> i & 1) != 0;
      const bool inner = (quad.inner >> i & 1) != 0;
      const reference::PixelSquare square = reference::pixel_square(
          quad.x + i % 2, quad.y + i / 2, config_.raster.sub_pixel_bits, config_.raster.uncertainty);
      wrong += inner != (covered && reference::fills(triangle, square)) ? 1 : 0;
      looked_at += covered ? 1 : 0;
      filled += inner ? 1 : 0;
    }
  }

  std::uint64_t looked_at = 0;
  std::uint64_t filled = 0;
  std::uint64_t wrong = 0;

 private:
  Config config_;
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint8_t>, reference::GridTriangle> triangles_;
};

/// Of one triangle of window coordinates on a target of `side` pixels.
std::uint64_t inner_pixels_of(const std::vector<glm::dvec3>& corners, const Config& config,
                              std::uint32_t side) {
  FrameBuilder builder(side);
  builder.draw(corners);
  InnerJudge judge(config);
  const FrameResult result = run_functional(builder.frame, config, {.observer = &judge});
  CHECK(judge.wrong == 0);
  CHECK(result.counters.early_z.inner == judge.filled);
  return judge.filled;
}

}  // namespace

TEST_CASE("inner coverage: each outer pixel of the adversarial families as the definition has it",
          "[property]") {
  const auto uncertainty = GENERATE(0, 1, 128);
  const auto interpolator = GENERATE(DepthInterpolator::kBarycentric, DepthInterpolator::kPlane);
  const Config config = tier3_machine(uncertainty, interpolator);
  const stress::Precision precision{.conservative = Conservative::kOuter, .uncertainty = uncertainty};
  const std::uint64_t wanted = std::max<std::uint64_t>(samples(1'200'000) / 90, 1);
  CAPTURE(seed(), uncertainty, static_cast<int>(interpolator));
  std::uint64_t covered = 0;
  std::uint64_t filled = 0;
  for (const stress::Family& family : stress::families()) {
    if (!stress::is_unclipped(family)) {
      continue;
    }
    CAPTURE(family.name);
    std::uint64_t looked_at = 0;
    for (std::uint64_t number = 0; looked_at < wanted; ++number) {
      const stress::Case made = stress::make_case(family, precision, seed(), number);
      InnerJudge judge(config);
      run_functional(made.frame, config, {.observer = &judge});
      CAPTURE(number);
      REQUIRE(judge.wrong == 0);
      looked_at += judge.looked_at + 1;  // some cases have no pixel
      covered += judge.looked_at;
      filled += judge.filled;
    }
  }
  CHECK(filled > 0);
  CHECK(filled < covered);
}

TEST_CASE("inner coverage: what is counted by hand") {
  // The triangle (0, 0), (16, 0), (0, 16): pixel (x, y) is inside where x + y <= 14; with a sub-pixel of
  // uncertainty those on the sides are not inside for sure.
  const std::vector<glm::dvec3> corners{{0, 0, 0.5}, {16, 0, 0.5}, {0, 16, 0.5}};
  CHECK(inner_pixels_of(corners, tier3_machine(0), 16) == 15 * 16 / 2);
  CHECK(inner_pixels_of(corners, tier3_machine(1), 16) == 12 * 13 / 2);
  // Without area: a point, a segment with its vertices in any order, and one of two equal vertices.
  CHECK(inner_pixels_of({{3.5, 3.5, 0}, {3.5, 3.5, 0}, {3.5, 3.5, 0}}, tier3_machine(0), 16) == 0);
  CHECK(inner_pixels_of({{3.5, 3.5, 0}, {12.5, 3.5, 0}, {7.25, 3.5, 0}}, tier3_machine(0), 16) == 0);
  CHECK(inner_pixels_of({{3.5, 3.5, 0}, {12.5, 3.5, 0}, {12.5, 3.5, 0}}, tier3_machine(0), 16) == 0);
  CHECK(inner_pixels_of({{12.5, 3.5, 0}, {12.5, 3.5, 0}, {3.5, 3.5, 0}}, tier3_machine(0), 16) == 0);
  // On a target without depth.
  FrameBuilder builder(16, DepthFormat::kNone);
  builder.frame.targets[0].depth_surface = kNoSurface;
  builder.frame.commands.clear();
  builder.draw(corners);
  CHECK(run_functional(builder.frame, tier3_machine(0), {}).counters.early_z.inner == 15 * 16 / 2);
}

TEST_CASE("inner coverage: nothing else changes, and lines have none") {
  CAPTURE(seed());
  halfspace::testing::Random random(seed());
  Config off = tier3_machine(1);
  off.raster.inner_coverage = false;
  for (std::uint64_t i = 0; i < std::max<std::uint64_t>(samples(30'000) / 1000, 1); ++i) {
    Frame frame = halfspace::testing::random_lines(random, false);
    FrameResult on = run_functional(frame, tier3_machine(1), {});
    std::uint64_t filled = 0;
    for (std::size_t draw = 0; draw < on.draws.size(); ++draw) {
      filled += on.draws[draw].counters.early_z.inner;
      on.draws[draw].counters.early_z.inner = 0;
    }
    CHECK(on.counters.early_z.inner == filled);
    on.counters.early_z.inner = 0;
    for (Surface& surface : on.surfaces) {
      surface.counters.early_z.inner = 0;
    }
    CHECK(halfspace::testing::result_difference(on, run_functional(frame, off, {})) == "");
    for (Command& command : frame.commands) {
      command.polygon_mode = command.fills_triangles() ? PolygonMode::kLine : command.polygon_mode;
    }
    CHECK(run_functional(frame, tier3_machine(1), {}).counters.early_z.inner == 0);
  }
}

TEST_CASE("inner coverage: without outer pixels it is refused by name") {
  for (const Conservative mode : {Conservative::kOff, Conservative::kInner}) {
    Config config = tier3_machine(1);
    config.raster.conservative = mode;
    CHECK_THROWS_WITH(validate(config), Catch::Contains("'raster.inner_coverage' is 1; legal: false where "
                                                        "'raster.conservative' is not outer"));
  }
}
