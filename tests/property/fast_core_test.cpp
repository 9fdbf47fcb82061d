// The fast core against the units: the same result of every frame, on every machine that it covers.
#include <hwy/targets.h>

#include <catch2/catch.hpp>

#include "../result_difference.hpp"
#include "../timing/random_machine.hpp"
#include "../timing/record_difference.hpp"
#include "halfspace/core/functional.hpp"
#include "halfspace/fast/fast_core.hpp"
#include "halfspace/machine/in_order.hpp"
#include "halfspace/timing/recurrence/run_recurrence.hpp"
#include "hard_frames.hpp"

namespace halfspace::testing {
namespace {

/// A frame counts as so many samples.
constexpr std::uint64_t kFrameSamples = 2000;
std::uint64_t frames() { return samples(10'000'000) / kFrameSamples; }

/// Where what the fast core makes differs from what the units make; `stalls` null: without time.
std::string core_difference(const Frame& frame, const Config& config, const Watch& watch,
                            const StallPlan* stalls) {
  if (stalls == nullptr) {
    fast::FastCore core(config, watch);
    core.run(frame);
    return result_difference(core.take(), run_in_order(frame, config, watch, nullptr));
  }
  EngineOptions options{.watch = watch, .stalls = *stalls, .packet_times = true};
  options.watch.core = Core::kFast;
  const TimedResult ours = run_recurrence(frame, config, options);
  options.watch.core = Core::kReadable;
  const TimedResult other = run_recurrence(frame, config, options);
  return result_difference(ours.frame, other.frame) + difference(ours.times, other.times) +
         difference(ours.cycles, other.cycles);
}

/// Frames and machines at random, `runs` of them, on every instruction set in turn: difference(frame, config,
/// random) must be empty.
template <class Difference>
void compare_cores(std::uint64_t runs, const Difference& difference) {
  Random random(seed());
  const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
  std::uint64_t covered = 0;
  for (std::uint64_t run = 0; run < runs; ++run) {
    const std::int64_t target = targets[run / 2 % targets.size()];
    CAPTURE(seed(), run, hwy::TargetName(target));
    Config config = random_config(random);
    while (run % 2 == 0 && !fast::gap(config, {}, nullptr).empty()) {  // every other machine is covered
      config = random_config(random);
    }
    const Frame frame = hard_frame(random);
    if (!fast::gap(config, {}, nullptr).empty()) {
      continue;
    }
    ++covered;
    INFO(difference_from_default(config));
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    REQUIRE(difference(frame, config, random) == "");
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  CHECK(covered > runs / 4);
}

Watch random_watch(Random& random) {
  return {.keep_visible = random.between(0, 1) == 0,
          .count_pixels = random.between(0, 3) != 0,
          .keep_sums = random.between(0, 3) == 0,
          .threads = pick(random, {1, 1, 2, 3, 8})};
}

}  // namespace

TEST_CASE("fast core: what the units make of random frames on random machines", "[property]") {
  compare_cores(frames(), [](const Frame& frame, const Config& config, Random& random) {
    return core_difference(frame, config, random_watch(random), nullptr);
  });
}

TEST_CASE("fast core: what the units make of depths outside [0, 1]", "[property]") {
  Random random(seed() + 7);
  for (std::uint64_t run = 0; run < frames() / 5; ++run) {
    CAPTURE(seed(), run);
    Config config = random_config(random);
    while (!fast::gap(config, {}, nullptr).empty()) {
      config = random_config(random);
    }
    INFO(difference_from_default(config));
    REQUIRE(core_difference(unrestricted_frame(random), config, random_watch(random), nullptr) == "");
  }
}

TEST_CASE("fast core: time as the units have it, of random frames on random machines", "[property]") {
  compare_cores(frames() / 5, [](const Frame& frame, const Config& config, Random& random) {
    const StallPlan stalls = random.between(0, 1) == 0 ? StallPlan{} : random_stalls(random);
    return core_difference(frame, config, random_watch(random), &stalls);
  });
}

TEST_CASE("fast core: records as the units make them, of random frames on random machines", "[property]") {
  compare_cores(frames() / 5, [](const Frame& frame, const Config& config, Random& /*random*/) {
    return record_difference(frame, config);
  });
}

TEST_CASE("fast core: planes that touch in a sample, their first vertices far away", "[property]") {
  Random random(seed() + 3);
  const Config config;
  const Watch watch{.keep_visible = true};
  for (std::uint64_t run = 0; run < frames(); ++run) {
    CAPTURE(seed(), run);
    const Frame frame = touching_planes(random);
    REQUIRE(core_difference(frame, config, watch, nullptr) == "");
  }
}

TEST_CASE("fast core: slivers so steep that a pixel's step in depth passes 64 bits", "[property]") {
  Random random(seed() + 5);
  for (std::uint64_t run = 0; run < frames() / 10; ++run) {
    CAPTURE(seed(), run);
    Config config;
    config.raster.sub_pixel_bits = static_cast<int>(random.between(7, 8));
    const Frame frame = steep_slivers(random);
    REQUIRE(core_difference(frame, config, {.keep_visible = true}, nullptr) == "");
  }
}

TEST_CASE("fast core: windows that a scissor cuts out, in every size of tile and block", "[property]") {
  Random random(seed() + 4);
  for (std::uint64_t run = 0; run < frames() / 10; ++run) {
    CAPTURE(seed(), run);
    Config config;
    config.tile_walker.tile_size = pick(random, {4, 8});
    config.block_walker.block_size = config.tile_walker.tile_size * pick(random, {2, 4, 8});
    const Watch watch{.keep_visible = true};
    const Frame frame = scissored(random);
    REQUIRE(core_difference(frame, config, watch, nullptr) == "");
  }
}

TEST_CASE("fast core: memory of the frame before leaves no trace", "[property]") {
  Random random(seed() + 1);
  const Config config;
  const Watch watch{.keep_visible = true, .keep_sums = GENERATE(false, true), .threads = 2};
  fast::FastCore core(config, watch);
  for (std::uint64_t run = 0; run < frames() / 20; ++run) {
    CAPTURE(seed(), run);
    const Frame frame = hard_frame(random);
    core.run(frame);
    core.run(frame);
    REQUIRE(result_difference(core.take(), run_in_order(frame, config, watch, nullptr)) == "");
    core.run(hard_frame(random));  // is not taken
  }
}

TEST_CASE("fast core: a run that it does not cover is refused or left to the units", "[property]") {
  Random random(seed() + 2);
  const Frame frame = hard_frame(random);
  Config config;
  CHECK(run_functional(frame, config).core == Core::kFast);
  CHECK(run_functional(frame, config, {.core = Core::kReadable}).core == Core::kReadable);
  config.tile_walker.tile_size = 16;
  CHECK(run_functional(frame, config).core == Core::kReadable);
  CHECK_THROWS_WITH(
      run_functional(frame, config, {.core = Core::kFast}),
      Catch::Contains("tile_walker.tile_size = 16") && Catch::Contains("legal: auto, readable"));
}

}  // namespace halfspace::testing
