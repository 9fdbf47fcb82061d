// late_z.mode = late: where the shader discards nothing, the results of opaque, and where it discards all,
// those of no_write; whatever else the machine is.
#include <catch2/catch.hpp>

#include "../result_difference.hpp"
#include "../timing/random_machine.hpp"
#include "halfspace/machine/in_order.hpp"

namespace halfspace::testing {
namespace {

Config with(Config config, LateZ mode, int discard) {
  config.late_z.mode = mode;
  config.late_z.discard = discard;
  return config;
}

FrameResult run(const Frame& frame, const Config& config) {
  return run_in_order(frame, config, {.keep_visible = true}, nullptr);
}

/// Where codes or counts of survivors differ. What hi_z keeps from being evaluated may differ.
std::string depth_difference(const FrameResult& ours, const FrameResult& other) {
  std::string text;
  for (std::size_t i = 0; text.empty() && i < ours.surfaces.size(); ++i) {
    const Surface& a = ours.surfaces[i];
    const Surface& b = other.surfaces[i];
    text +=
        image_difference("codes", a.codes, b.codes) + image_difference("survivors", a.survivors, b.survivors);
  }
  return text;
}

}  // namespace

TEST_CASE("late_z: with no discard as opaque, with all discarded as no_write", "[property]") {
  Random random(seed());
  std::uint64_t late = 0;
  for (std::uint64_t left = samples(1'000'000) / 2000; left > 0; --left) {
    const Config config = random_config(random);
    const Frame frame = random_frame(random);
    INFO(difference_from_default(config));
    const FrameResult none = run(frame, with(config, LateZ::kLate, 0));
    REQUIRE(picture_difference(none, run(frame, with(config, LateZ::kOpaque, 0))) == "");
    REQUIRE(none.counters.early_z.discarded == 0);
    const FrameResult all = run(frame, with(config, LateZ::kLate, kWholeShare));
    REQUIRE(depth_difference(all, run(frame, with(config, LateZ::kNoWrite, 0))) == "");
    const FrameResult some = run(frame, with(config, LateZ::kLate, kWholeShare / 2));
    const EarlyZCounters& counters = some.counters.early_z;
    REQUIRE(counters.discarded + counters.written <= counters.survivors);
    late += all.counters.early_z.discarded;
  }
  CHECK(late > 1000);
}

}  // namespace halfspace::testing
