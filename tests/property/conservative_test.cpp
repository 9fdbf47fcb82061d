// Conservative rasterization: the units against the definition of which pixels a triangle touches and fills.
#include "halfspace/numerics/conservative.hpp"

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cstdint>
#include <vector>

#include "../line_frames.hpp"
#include "../result_difference.hpp"
#include "../triangles.hpp"
#include "halfspace/config/config.hpp"
#include "halfspace/core/functional.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/reference/pixel_square.hpp"
#include "halfspace/reference/rasterizer.hpp"
#include "halfspace/scene/frame_builder.hpp"
#include "halfspace/stress/campaign.hpp"
#include "random.hpp"

using namespace halfspace;
using halfspace::testing::Random;
using halfspace::testing::samples;
using halfspace::testing::seed;
using halfspace::testing::TriangleSource;

namespace {

struct RationalPair {
  mpq_class x;
  mpq_class y;
};

/// The part of a convex polygon, or of a segment or point, where sign * (coordinate - limit) >= 0.
std::vector<RationalPair> cut_part(const std::vector<RationalPair>& in, bool along_x, int sign,
                                   std::int64_t limit) {
  const auto distance = [&](const RationalPair& p) {
    return mpq_class(sign * ((along_x ? p.x : p.y) - static_cast<long>(limit)));
  };
  std::vector<RationalPair> out;
  for (std::size_t i = 0; i < in.size(); ++i) {
    const RationalPair& here = in[i];
    const RationalPair& next = in[(i + 1) % in.size()];
    const mpq_class a = distance(here);
    const mpq_class b = distance(next);
    if (a >= 0) {
      out.push_back(here);
    }
    if ((a > 0 && b < 0) || (a < 0 && b > 0)) {
      const mpq_class t = a / (a - b);
      out.push_back({here.x + t * (next.x - here.x), here.y + t * (next.y - here.y)});
    }
  }
  return out;
}

/// Whether anything of the triangle is left when it is cut to the square.
bool is_left(const reference::GridTriangle& triangle, const reference::PixelSquare& square) {
  std::vector<RationalPair> polygon;
  for (const reference::GridPoint& p : triangle) {
    polygon.push_back({static_cast<long>(p.x), static_cast<long>(p.y)});
  }
  polygon = cut_part(polygon, true, 1, square.least.x);
  polygon = cut_part(polygon, true, -1, square.most.x);
  polygon = cut_part(polygon, false, 1, square.least.y);
  polygon = cut_part(polygon, false, -1, square.most.y);
  return !polygon.empty();
}

Config conservative_machine(Conservative mode, int uncertainty,
                            DepthInterpolator interpolator = DepthInterpolator::kBarycentric) {
  Config config;
  config.raster.conservative = mode;
  config.raster.uncertainty = uncertainty;
  config.depth.interpolator = interpolator;
  return config;
}

constexpr std::uint32_t kPictureSide = 16;

/// Fragments of each pixel of one triangle of window coordinates.
std::vector<std::uint32_t> fragments_of(const std::vector<glm::dvec3>& corners, const Config& config,
                                        std::vector<std::uint32_t>* codes = nullptr,
                                        std::uint32_t flags = 0) {
  FrameBuilder builder(kPictureSide);
  builder.draw(corners).flags |= flags;
  const FrameResult result = run_functional(builder.frame, config, {.count_pixels = true});
  std::vector<std::uint32_t> fragments;
  for (int y = 0; y < static_cast<int>(kPictureSide); ++y) {
    for (int x = 0; x < static_cast<int>(kPictureSide); ++x) {
      fragments.push_back(result.surfaces[0].fragments.at(x, y));
      if (codes != nullptr) {
        codes->push_back(result.surfaces[0].codes.at(x, y));
      }
    }
  }
  return fragments;
}

std::uint64_t total_of(const std::vector<std::uint32_t>& values) {
  std::uint64_t total = 0;
  for (const std::uint32_t value : values) {
    total += value;
  }
  return total;
}

/// The units, as a subject of the campaign.
class Machine final : public stress::Subject {
 public:
  explicit Machine(const Config& config) : config_(config) {}

  [[nodiscard]] std::string name() const override { return "units"; }

  stress::Picture draw(const Frame& frame) override {
    Decisions decisions;
    const FrameResult result = run_functional(frame, config_, {.count_pixels = true, .observer = &decisions});
    const Surface& surface = result.surfaces.at(0);
    stress::Picture picture{.width = static_cast<std::uint32_t>(surface.codes.width()),
                            .height = static_cast<std::uint32_t>(surface.codes.height()),
                            .tile_size = config_.tile_walker.tile_size,
                            .decisions = std::move(decisions.all)};
    for (int y = 0; y < surface.codes.height(); ++y) {
      for (int x = 0; x < surface.codes.width(); ++x) {
        picture.fragments.push_back(surface.fragments.at(x, y));
        picture.survivors.push_back(surface.survivors.at(x, y));
        picture.codes.push_back(surface.codes.at(x, y));
      }
    }
    return picture;
  }

 private:
  class Decisions final : public PacketObserver {
   public:
    [[nodiscard]] bool wants_decisions() const override { return true; }
    void decision(const DecisionEvent& event) override { all.push_back(event); }
    std::vector<DecisionEvent> all;
  };

  Config config_;
};

}  // namespace

TEST_CASE("conservative: the oracle says what cutting the triangle to the square leaves", "[property]") {
  CAPTURE(seed());
  Random random(seed());
  const std::uint64_t count = samples(60'000) / 3;
  std::uint64_t touched = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    // Few places, so that sides, corners and vertices meet often; many are flat.
    const std::int64_t extent = random.between(0, 1) == 0 ? 4 : 24;
    reference::GridTriangle t;
    for (reference::GridPoint& p : t) {
      p = {random.between(-extent, extent), random.between(-extent, extent)};
    }
    const reference::GridPoint least{random.between(-4, 4), random.between(-4, 4)};
    const reference::PixelSquare square{
        .least = least, .most = {least.x + random.between(0, 6), least.y + random.between(0, 6)}};
    const bool expected = is_left(t, square);
    touched += expected ? 1 : 0;
    if (reference::touches(t, square) != expected) {
      CAPTURE(t[0].x, t[0].y, t[1].x, t[1].y, t[2].x, t[2].y, square.least.x, square.least.y, square.most.x,
              square.most.y);
      REQUIRE(reference::touches(t, square) == expected);
    }
  }
  CHECK(touched > count / 10);
  CHECK(touched < count - count / 10);
}

TEST_CASE("conservative: each pixel of the adversarial families as the definition has it", "[property]") {
  const auto mode = GENERATE(Conservative::kOuter, Conservative::kInner);
  const auto uncertainty = GENERATE(0, 1, 128);
  const auto interpolator = GENERATE(DepthInterpolator::kBarycentric, DepthInterpolator::kPlane);
  const auto format = GENERATE(DepthFormat::kUnorm24, DepthFormat::kFloat32);
  const Config config = conservative_machine(mode, uncertainty, interpolator);
  stress::CampaignPlan plan{.precision = {.format = format, .conservative = mode, .uncertainty = uncertainty},
                            .depth = {.interpolator = interpolator},
                            .seed = seed(),
                            .samples = samples(1'200'000) / 24};
  for (const stress::Family& family : stress::families()) {
    if (stress::is_unclipped(family)) {
      plan.families.push_back(&family);
    }
  }
  CHECK(plan.families.size() == 15);
  Machine subject(config);
  const stress::CampaignState state =
      stress::run_campaign(plan, subject, [](const stress::CampaignState&) {});
  CAPTURE(seed(), static_cast<int>(mode), uncertainty, static_cast<int>(interpolator),
          static_cast<int>(format));
  for (const stress::FamilyState& family : state.families) {
    CAPTURE(family.family, family.tally.missing, family.tally.extra, family.tally.out_of_range,
            family.tally.inexact);
    CHECK(family.tally.samples > 0);
    CHECK(family.tally.errors() == 0);
  }
}

TEST_CASE("conservative: inner pixels are covered ones, and these are outer ones", "[property]") {
  CAPTURE(seed());
  TriangleSource source(seed(), kPictureSide, 8);
  const std::uint64_t count = samples(30'000) / 100;
  for (std::uint64_t i = 0; i < count; ++i) {
    const ScreenTriangle t = source.next();
    std::vector<glm::dvec3> corners;
    for (const ScreenVertex& v : t.v) {
      corners.emplace_back(v.x / 256.0, v.y / 256.0, 0.5);
    }
    const std::vector<std::uint32_t> outer =
        fragments_of(corners, conservative_machine(Conservative::kOuter, 1));
    const std::vector<std::uint32_t> centre =
        fragments_of(corners, conservative_machine(Conservative::kOff, 1));
    const std::vector<std::uint32_t> inner =
        fragments_of(corners, conservative_machine(Conservative::kInner, 1));
    for (std::size_t at = 0; at < outer.size(); ++at) {
      CHECK(inner[at] <= centre[at]);
      CHECK(centre[at] <= outer[at]);
    }
  }
}

TEST_CASE("conservative: the reference exact has the same pixels, and depths next to the units'",
          "[property]") {
  CAPTURE(seed());
  TriangleSource source(seed() + 1, kPictureSide, 8);
  const auto mode = GENERATE(Conservative::kOuter, Conservative::kInner);
  const std::uint64_t count = samples(60'000) / 200;
  for (std::uint64_t i = 0; i < count; ++i) {
    FrameBuilder builder(kPictureSide);
    std::vector<glm::dvec3> corners;
    for (const ScreenVertex& v : source.next().v) {
      corners.emplace_back(v.x / 256.0, v.y / 256.0, static_cast<double>(corners.size()) / 4);
    }
    builder.draw(corners);
    const Config config = conservative_machine(mode, 1, DepthInterpolator::kPlane);
    const FrameResult ours = run_functional(builder.frame, config, {.count_pixels = true});
    reference::Options options;
    options.pixels = mode == Conservative::kOuter ? reference::Pixels::kTouched : reference::Pixels::kFilled;
    options.uncertainty = 1;
    options.guard_band = 1e9;  // none is cut in pieces, as the units do not
    const std::vector<reference::Surface> theirs = reference::rasterize(builder.frame, options);
    std::size_t different = 0;
    std::size_t far = 0;
    for (std::size_t at = 0; at < theirs[0].fragments.size(); ++at) {
      const auto x = static_cast<int>(at % kPictureSide);
      const auto y = static_cast<int>(at / kPictureSide);
      different += theirs[0].fragments[at] == ours.surfaces[0].fragments.at(x, y) ? 0 : 1;
      const std::int64_t off = std::int64_t{theirs[0].codes[at]} - ours.surfaces[0].codes.at(x, y);
      far += std::abs(off) > 1 ? 1 : 0;
    }
    CAPTURE(i);
    REQUIRE(different == 0);
    CHECK(far == 0);  // vertices are on the grid, so both have the same plane
  }
}

TEST_CASE("conservative: what has no area") {
  const Config outer = conservative_machine(Conservative::kOuter, 1);
  const auto pixels = [&](const std::vector<glm::dvec3>& corners) {
    return total_of(fragments_of(corners, outer));
  };
  // A point inside a pixel, on a side, on a corner.
  CHECK(pixels({{3.5, 3.5, 0}, {3.5, 3.5, 0}, {3.5, 3.5, 0}}) == 1);
  CHECK(pixels({{4, 3.5, 0}, {4, 3.5, 0}, {4, 3.5, 0}}) == 2);
  CHECK(pixels({{4, 4, 0}, {4, 4, 0}, {4, 4, 0}}) == 4);
  // A segment, with its vertices in any order, and twice the same: ten pixels along a row.
  CHECK(pixels({{3.5, 3.5, 0}, {12.5, 3.5, 0}, {7.25, 3.5, 0}}) == 10);
  CHECK(pixels({{7.25, 3.5, 0}, {12.5, 3.5, 0}, {3.5, 3.5, 0}}) == 10);
  CHECK(pixels({{3.5, 3.5, 0}, {12.5, 3.5, 0}, {12.5, 3.5, 0}}) == 10);
  // Nothing for centres, or for inner pixels.
  for (const Conservative mode : {Conservative::kOff, Conservative::kInner}) {
    CHECK(total_of(fragments_of({{3.5, 3.5, 0}, {12.5, 3.5, 0}, {7.25, 3.5, 0}},
                                conservative_machine(mode, 1))) == 0);
  }
  // It has the depth of its first vertex, and faces back.
  std::vector<std::uint32_t> codes;
  const std::vector<std::uint32_t> fragments =
      fragments_of({{12.5, 3.5, 0.25}, {3.5, 3.5, 0.5}, {7.25, 3.5, 0.75}}, outer, &codes);
  for (std::size_t at = 0; at < codes.size(); ++at) {
    CHECK(codes[at] == (fragments[at] == 0 ? 0xFFFFFFu : 0x400000u));
  }
  const auto back = static_cast<std::uint32_t>(Flag::kCullBack);
  const auto front = static_cast<std::uint32_t>(Flag::kCullFront);
  CHECK(total_of(fragments_of({{3.5, 3.5, 0}, {12.5, 3.5, 0}, {7.25, 3.5, 0}}, outer, nullptr, back)) == 0);
  CHECK(total_of(fragments_of({{3.5, 3.5, 0}, {12.5, 3.5, 0}, {7.25, 3.5, 0}}, outer, nullptr, front)) == 10);
}

TEST_CASE("conservative: a square that a triangle fills to its sides") {
  // The triangle (0, 0), (16, 0), (0, 16): pixel (x, y) is inside where x + y <= 14, touched where x + y
  // <= 16.
  const std::vector<glm::dvec3> corners{{0, 0, 0.5}, {16, 0, 0.5}, {0, 16, 0.5}};
  CHECK(total_of(fragments_of(corners, conservative_machine(Conservative::kInner, 0))) == 15 * 16 / 2);
  CHECK(total_of(fragments_of(corners, conservative_machine(Conservative::kOuter, 0))) == 16 * 17 / 2 + 15);
  // With a sub-pixel of uncertainty the pixels on the sides are not inside for sure.
  CHECK(total_of(fragments_of(corners, conservative_machine(Conservative::kInner, 1))) == 12 * 13 / 2);
  // With half a pixel, those whose corner is within half a pixel of the long side are touched: x + y <= 17.
  CHECK(total_of(fragments_of(corners, conservative_machine(Conservative::kOuter, 128))) ==
        16 * 17 / 2 + 15 + 14);
}

TEST_CASE("conservative: lines and points are drawn by their centres") {
  CAPTURE(seed());
  Random random(seed());
  const std::uint64_t count = samples(30'000) / 1000;
  for (std::uint64_t i = 0; i < count; ++i) {
    Frame frame = testing::random_lines(random, false);
    for (Command& command : frame.commands) {
      if (command.fills_triangles()) {
        command.polygon_mode = PolygonMode::kLine;
      }
    }
    const FrameResult off = run_functional(frame, conservative_machine(Conservative::kOff, 1));
    const FrameResult on = run_functional(frame, conservative_machine(Conservative::kOuter, 1));
    CHECK(testing::result_difference(on, off) == "");
  }
}

TEST_CASE("conservative: what it does not go with is refused by name") {
  Config config = conservative_machine(Conservative::kInner, 9);
  config.raster.sub_pixel_bits = 4;
  CHECK_THROWS_WITH(validate(config),
                    Catch::Contains("'raster.uncertainty' is 9; legal: at most half a pixel (8)"));
  config.raster.uncertainty = 8;
  CHECK_NOTHROW(validate(config));
}
