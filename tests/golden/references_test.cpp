// The reference rasterizers on frames of real programs: the exact ones cover as the units do.
#include <catch2/catch.hpp>
#include <span>

#include "captured_frame.hpp"
#include "halfspace/core/functional.hpp"
#include "halfspace/reference/rasterizer.hpp"

namespace halfspace::testing {
namespace {

/// How many pixels two surfaces cover a different number of times.
int pixels_apart(const Surface& units, const reference::Surface& other) {
  int apart = 0;
  for (int y = 0; y < units.codes.height(); ++y) {
    for (int x = 0; x < units.codes.width(); ++x) {
      const auto at = static_cast<std::size_t>(y) * other.width + static_cast<std::size_t>(x);
      apart += units.fragments.at(x, y) != other.fragments.at(at) ? 1 : 0;
    }
  }
  return apart;
}

/// Pixels of all surfaces that `method` covers another number of times than the units.
int pixels_apart(const Frame& frame, const FrameResult& units, std::string_view method,
                 std::optional<reference::TieRule> rule = std::nullopt) {
  const reference::Options options{.method = method, .rule = rule};
  int apart = 0;
  for (const reference::Surface& surface : reference::rasterize(frame, options)) {
    apart += pixels_apart(units.surfaces.at(surface.index), surface);
  }
  return apart;
}

constexpr std::array kExact = {"exact", "barycentric", "scanline", "incremental"};

void check_references(const std::string& name) {
  const Frame frame = captured_frame(name);
  const FrameResult units = run_functional(frame, {});
  for (const char* method : kExact) {
    CAPTURE(name, method);
    CHECK(pixels_apart(frame, units, method) == 0);
  }
  // The others are near.
  const auto fragments = static_cast<double>(units.counters.quad_generator.fragments);
  for (const char* method : {"float_epsilon", "homogeneous", "clip_everything"}) {
    CAPTURE(name, method);
    CHECK(pixels_apart(frame, units, method) <= 0.001 * fragments);
  }
}

/// By each fill rule in all draws: both cores, and all of `methods`.
void check_rules(const std::string& name, std::span<const char* const> methods) {
  const Frame frame = captured_frame(name);
  for (const auto& [rule, rule_name] : reference::kTieRules) {
    Config config;
    set_config(config, "setup.fill_rule", rule_name);
    for (const Core core : {Core::kFast, Core::kReadable}) {
      const FrameResult units = run_functional(frame, config, {.core = core});
      for (const char* method : methods) {
        CAPTURE(name, rule_name, core, method);
        CHECK(pixels_apart(frame, units, method, rule) == 0);
      }
    }
  }
}

}  // namespace

TEST_CASE("references: fill rules", "[golden]") {
  check_rules("vkcube", kExact);
  check_rules("cc0_truck", std::span(kExact).first(1));
}
TEST_CASE("references: every fill rule on every frame", "[golden][slow]") {
  for (const char* name : {"vkcube", "cc0_truck", "glmark2_ideas", "glmark2_shadow", "stk_snowmountain",
                           "openarena_gl2", "warzone2100_vulkan"}) {
    check_rules(name, kExact);
  }
}

TEST_CASE("references: vkcube", "[golden]") { check_references("vkcube"); }
TEST_CASE("references: cc0_truck", "[golden]") { check_references("cc0_truck"); }
TEST_CASE("references: glmark2_ideas", "[golden]") { check_references("glmark2_ideas"); }
TEST_CASE("references: glmark2_shadow", "[golden]") { check_references("glmark2_shadow"); }
TEST_CASE("references: stk_snowmountain", "[golden]") { check_references("stk_snowmountain"); }
TEST_CASE("references: openarena_gl2", "[golden]") { check_references("openarena_gl2"); }
TEST_CASE("references: warzone2100_vulkan", "[golden]") { check_references("warzone2100_vulkan"); }

}  // namespace halfspace::testing
