// The families of the stress campaign, and its judge. What they say is held against a subject that is the
// definition itself, and against subjects that break one law each.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "halfspace/numerics/error.hpp"
#include "halfspace/stress/campaign.hpp"
#include "halfspace/stress/campaign_state.hpp"
#include "halfspace/stress/homogeneous_oracle.hpp"
#include "halfspace/stress/reference_picture.hpp"
#include "halfspace/stress/reference_subject.hpp"
#include "halfspace/stress/wrong_rasterizer.hpp"
#include "random.hpp"

using namespace halfspace;
using namespace halfspace::stress;
using namespace halfspace::testing;

namespace {

/// The textbook rasterizer, which is exact, and something done to its picture.
class Textbook final : public Subject {
 public:
  using Change = std::function<void(Picture&)>;

  explicit Textbook(Change change = [](Picture&) {}) : change_(std::move(change)) {}

  [[nodiscard]] std::string name() const override { return "textbook"; }

  Picture draw(const Frame& frame) override {
    Picture picture = reference_picture(frame, {}, reference::method_of("exact"));
    change_(picture);
    return picture;
  }

 private:
  Change change_;
};

CampaignPlan plan_for(DepthFormat format, std::uint64_t cases) {
  CampaignPlan plan{.precision = {.format = format}, .seed = seed(), .cases = cases};
  for (const Family& family : families()) {
    plan.families.push_back(&family);
  }
  // Its depth is that of vertices before they are snapped, in double: see docs/guides/reference.md.
  plan.depth.bound = 1e9;
  return plan;
}

CampaignState run(const CampaignPlan& plan, Subject& subject) {
  return run_campaign(plan, subject, [](const CampaignState&) {});
}

CampaignPlan only(const char* family, std::uint64_t cases) {
  CampaignPlan plan = plan_for(DepthFormat::kUnorm24, cases);
  plan.families = {&family_of(family)};
  return plan;
}

}  // namespace

TEST_CASE("stress: every family obeys its law with the textbook rasterizer", "[property]") {
  const auto format = GENERATE(DepthFormat::kUnorm16, DepthFormat::kUnorm24, DepthFormat::kFloat32);
  CAPTURE(seed(), name(format));
  Textbook textbook;
  const CampaignState state = run(plan_for(format, samples(1'500'000) / 100'000), textbook);
  for (const FamilyState& family : state.families) {
    CAPTURE(family.family, family.next);
    CHECK(family.tally.samples > 0);
    if (family.family !=
        "extreme_w") {  // it drops what clipping leaves with a vertex at w = 0: its page, Limits
      CHECK(family.tally.missing == 0);
    }
    CHECK(family.tally.extra == 0);
    CHECK(family.tally.failed == 0);
    CHECK(family.tally.mistested == 0);
  }
}

TEST_CASE("stress: meshes tile the target by the definition", "[property]") {
  CAPTURE(seed());
  for (const int bits : {4, 6, 8}) {
    for (std::uint64_t index = 0; index < samples(1'500'000) / 100'000; ++index) {
      CAPTURE(bits, index);
      Case made = make_case(family_of("mesh"), {.sub_pixel_bits = bits}, seed(), index);
      REQUIRE(made.partition);
      for (const std::int32_t count : expected_fragments(made, {.sub_pixel_bits = bits})) {
        REQUIRE(count == 1);
      }
    }
  }
}

TEST_CASE("stress: homogeneous coverage is the definition's where w is 1", "[property]") {
  CAPTURE(seed());
  Random random(seed());
  std::uint64_t certain = 0;
  for (std::uint64_t n = 0; n < samples(400'000) / 10'000; ++n) {
    reference::GridTriangle grid;
    std::array<glm::vec4, 3> clip{};
    for (std::size_t i = 0; i < 3; ++i) {
      grid[i] = {random.between(-4096, 8192), random.between(-4096, 8192)};
      clip[i] = {static_cast<double>(grid[i].x) / 2048 - 1, static_cast<double>(grid[i].y) / 2048 - 1, 0.5,
                 1};
    }
    const HomogeneousTriangle exact(clip, 16, 8);
    for (std::uint32_t y = 0; y < 16; ++y) {
      for (std::uint32_t x = 0; x < 16; ++x) {
        const Certainty certainty = exact.covers(x, y);
        if (certainty != Certainty::kUncertain) {
          ++certain;
          const bool covered =
              reference::covers(grid, reference::pixel_centre(x, y, 8), reference::TieRule::kTopLeft);
          REQUIRE(covered == (certainty == Certainty::kInside));
        }
      }
    }
  }
  CHECK(certain > 0);
}

TEST_CASE("stress: a scene of a report finds its suspect, and nothing in exact rasterizers", "[property]") {
  CAPTURE(seed());
  const auto suspect_of = [](const Family& scene) {
    const auto& textbook = reference::methods();
    const bool is_textbook =
        std::ranges::any_of(textbook, [&](const auto& method) { return method.name == scene.suspect; });
    return is_textbook ? reference_subject(scene.suspect, Precision{})
                       : wrong_subject(wrong_rasterizer(scene.suspect), Precision{});
  };
  CHECK(reports().size() >= 12);
  for (const Family& scene : reports()) {
    CAPTURE(scene.name);
    CHECK(scene.report.starts_with("https://"));
    CampaignPlan plan = only(scene.name.data(), 32);
    plan.depth.bound = 1;
    CHECK(run(plan, *suspect_of(scene)).sum().errors() > 0);
    for (const char* name : {"exact", "barycentric", "scanline", "incremental"}) {
      CAPTURE(name);
      const Tally right = run(plan, *reference_subject(name, plan.precision)).sum();
      CHECK(right.errors() == 0);
      CHECK(right.samples + right.tested > 0);
    }
  }
}

TEST_CASE("stress: scenes of reports are the same at every precision", "[property]") {
  CAPTURE(seed());
  for (const int bits : {4, 6, 8}) {
    for (const DepthFormat format : {DepthFormat::kUnorm16, DepthFormat::kUnorm24, DepthFormat::kFloat32}) {
      CampaignPlan plan{.precision = {.sub_pixel_bits = bits, .format = format},
                        .depth = {.bound = 1},
                        .seed = seed(),
                        .cases = 8};
      for (const Family& scene : reports()) {
        plan.families.push_back(&scene);
      }
      for (const FamilyState& scene : run(plan, *reference_subject("exact", plan.precision)).families) {
        CAPTURE(bits, name(format), scene.family);
        CHECK(scene.tally.errors() == 0);
      }
    }
  }
}

TEST_CASE("stress: the judge finds a picture that breaks a law", "[property]") {
  const auto errors = [](const char* family, const Textbook::Change& change) {
    Textbook wrong(change);
    return run(only(family, 20), wrong).sum();
  };
  const auto first = [](Picture& picture) { ++picture.fragments[0]; };
  CHECK(errors("sliver", first).extra == 20);
  CHECK(errors("mesh", first).extra == 20);
  CHECK(errors("mesh", [](Picture& picture) { picture.fragments.back() = 0; }).missing == 20);
  CHECK(errors("fan", [](Picture& picture) {
          for (std::uint32_t& count : picture.fragments) ++count;
        }).extra >= 20);
  CHECK(errors("depth_stack", [](Picture& picture) { ++picture.survivors[7]; }).mistested == 20);
  bool odd = false;
  CHECK(errors("permuted", [&](Picture& picture) {
          picture.codes[5] ^= odd ? 1 : 0;
          odd = !odd;
        }).moved == 20);
  CHECK(errors("sub_pixel", [](Picture&) { throw InputError("no picture"); }).failed == 20);
  CHECK(errors("sub_pixel", [](Picture& picture) { picture.fragments.pop_back(); }).failed == 20);
}

TEST_CASE("stress: an unsound verdict about a tile is found") {
  // The one tile of the target both rejected and accepted: the half of it that is wrong, or both.
  Textbook both([](Picture& picture) {
    picture.tile_size = 16;
    for (std::uint32_t triangle = 0; triangle < 100; ++triangle) {
      picture.decisions.push_back({.triangle = triangle, .verdict = TileVerdict::kReject});
      picture.decisions.push_back({.triangle = triangle, .verdict = TileVerdict::kAccept});
    }
  });
  const Tally tally = run(only("on_samples", 5), both).sum();
  CHECK(tally.decisions == 1000);
  CHECK(tally.unsound >= 500);
}

TEST_CASE("stress: a depth one code off, or outside of its vertices, is found") {
  Textbook off([](Picture& picture) {
    for (std::uint32_t& code : picture.codes) code += code < 0xFFFFFF ? 1 : 0;
  });
  Textbook far([](Picture& picture) {
    for (std::uint32_t& code : picture.codes) code = 0xFFFFFF;
  });
  CampaignPlan plan = only("grid_depth", 20);
  plan.depth.bound.reset();
  CHECK(run(plan, off).sum().inexact > 20);
  CHECK(run(plan, far).sum().out_of_range > 20);
}

TEST_CASE("stress: a campaign that is cut off goes on where it was") {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("halfspace_stress_" + std::to_string(seed()));
  std::filesystem::remove_all(folder);
  Textbook textbook;
  CampaignPlan whole = plan_for(DepthFormat::kUnorm24, 6);
  const CampaignState at_once = run(whole, textbook);

  CampaignPlan part = plan_for(DepthFormat::kUnorm24, 4);
  part.folder = folder;
  CHECK(run(part, textbook).sum().cases == 4 * families().size());
  part.cases = 6;
  CampaignState twice = run(part, textbook);
  CHECK(twice.sittings == 2);
  twice.sittings = at_once.sittings;
  twice.seconds = at_once.seconds;
  CHECK(to_json(twice) == to_json(at_once));

  part.seed += 1;
  CHECK_THROWS_WITH(run(part, textbook), Catch::Contains("the campaign's seed is"));
  std::filesystem::remove_all(folder);
}

TEST_CASE("stress: every rasterizer that is wrong on purpose is found", "[property][exhaustive]") {
  CAPTURE(seed());
  CampaignPlan plan = plan_for(DepthFormat::kUnorm24, 8);
  plan.depth.bound = 1;
  CampaignPlan scenes = plan;
  scenes.families.clear();
  for (const Family& scene : reports()) {
    scenes.families.push_back(&scene);
  }
  for (const WrongRasterizer& wrong : wrong_rasterizers()) {
    CAPTURE(wrong.name);
    const auto subject = wrong_subject(wrong, plan.precision);
    const bool by_families = run(plan, *subject).sum().errors() > 0;
    CHECK((by_families || run(scenes, *subject).sum().errors() > 0));
  }
  CHECK_THROWS_WITH(wrong_rasterizer("right"),
                    Catch::Contains("wrong rasterizer is 'right'; it must be one of"));
}

TEST_CASE("stress: errors name what is legal") {
  CHECK_THROWS_WITH(family_of("slivers"), Catch::Contains("family is 'slivers'; it must be one of sliver,"));
  CHECK_THROWS_WITH(library_subject("/nowhere/lib.so", 8),
                    Catch::Contains("/nowhere/lib.so cannot be loaded"));
  CHECK_THROWS_WITH(files_subject("/nowhere"), Catch::Contains("/nowhere is not a folder"));
}
