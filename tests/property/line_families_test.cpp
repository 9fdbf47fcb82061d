// The families of thin lines of the stress campaign: both cores obey the definitions, and a rasterizer that
// takes one rule for another is found.
#include <algorithm>
#include <catch2/catch.hpp>
#include <string>

#include "halfspace/core/functional.hpp"
#include "halfspace/stress/campaign.hpp"
#include "halfspace/stress/line_families.hpp"
#include "random.hpp"

namespace halfspace::testing::line_family_tests {
namespace {

template <class Value>
std::vector<std::uint32_t> by_row(const TiledImage<Value>& image) {
  std::vector<std::uint32_t> values;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      values.push_back(image.at(x, y));
    }
  }
  return values;
}

/// A core, with lines of one rule drawn by another.
class CoreSubject final : public stress::Subject {
 public:
  CoreSubject(Core core, int sub_pixel_bits, LineRule rule = LineRule::kRectangular,
              LineRule taken_for = LineRule::kRectangular)
      : core_(core), rule_(rule), taken_for_(taken_for) {
    config_.raster.sub_pixel_bits = sub_pixel_bits;
  }

  [[nodiscard]] std::string name() const override { return "core"; }

  stress::Picture draw(const Frame& frame) override {
    Frame changed = frame;
    for (Command& command : changed.commands) {
      command.line_rule = command.line_rule == rule_ ? taken_for_ : command.line_rule;
    }
    const FrameResult result = run_functional(changed, config_, {.count_pixels = true, .core = core_});
    const Surface& surface = result.surfaces.at(0);
    return {.width = static_cast<std::uint32_t>(surface.codes.width()),
            .height = static_cast<std::uint32_t>(surface.codes.height()),
            .fragments = by_row(surface.fragments),
            .survivors = by_row(surface.survivors),
            .codes = by_row(surface.codes)};
  }

 private:
  Core core_;
  LineRule rule_;
  LineRule taken_for_;
  Config config_;
};

stress::CampaignState run(int sub_pixel_bits, std::uint64_t cases, stress::Subject& subject) {
  stress::CampaignPlan plan{.precision = {.sub_pixel_bits = sub_pixel_bits}, .seed = seed(), .cases = cases};
  for (const stress::Family& family : stress::line_families()) {
    plan.families.push_back(&family);
  }
  return stress::run_campaign(plan, subject, [](const stress::CampaignState&) {});
}

}  // namespace

TEST_CASE("line families: both cores obey the definitions", "[property]") {
  const int bits = GENERATE(4, 5, 8);
  const Core core = GENERATE(Core::kFast, Core::kReadable);
  CAPTURE(seed(), bits);
  CoreSubject subject(core, bits);
  const stress::CampaignState state =
      run(bits, std::max<std::uint64_t>(1, samples(4'000'000) / 1'000'000), subject);
  for (const stress::FamilyState& family : state.families) {
    INFO(family.family);
    CHECK(family.tally.samples > 0);
    CHECK(family.tally.triangles > 0);
    CHECK(family.tally.errors() == 0);
    CHECK(family.wrong.empty());
  }
}

TEST_CASE("line families: one rule taken for another is found", "[property]") {
  for (int rule = 1; rule <= 4; ++rule) {
    for (int other = 1; other <= 4; ++other) {
      if (rule == other) {
        continue;
      }
      CAPTURE(rule, other);
      CoreSubject subject(Core::kFast, 8, static_cast<LineRule>(rule), static_cast<LineRule>(other));
      CHECK(run(8, 12, subject).sum().errors() > 0);
    }
  }
}

}  // namespace halfspace::testing::line_family_tests
