// What the study of hi_z counts is what the machine does: a burst that is stopped does not come to die.
#include <catch2/catch.hpp>

#include "halfspace/machine/in_order.hpp"
#include "halfspace/whatif/hi_z_study.hpp"
#include "hard_frames.hpp"

namespace halfspace::testing {
namespace {

std::uint64_t dead_bursts(const Frame& frame, const Config& config) {
  return run_in_order(frame, config, {}, nullptr).counters.early_z.tiles_killed;
}

}  // namespace

TEST_CASE("hi_z study: counts the bursts that no longer die", "[property]") {
  Random random(seed());
  std::uint64_t stopped = 0;
  for (std::uint64_t run = 0; run < samples(400'000) / 2000; ++run) {
    CAPTURE(seed(), run);
    Config config = random_config(random);
    config.hi_z.enabled = true;
    config.z_cache.parts = 1;
    config.z_cache.fast_clear = true;  // a drawn clear is no draw of the frame, and may not be told apart
    CAPTURE(difference_from_default(config));
    const Frame frame = random.between(0, 1) == 0 ? depth_stack(random) : hard_frame(random);
    const std::vector<whatif::HiZChoice> choices{{.bits = config.hi_z.bits, .lag = config.hi_z.lag},
                                                 {.bits = 32, .lag = 1}};
    const whatif::HiZKills kills = whatif::count_hi_z_kills(frame, config, choices);
    const std::uint64_t with = dead_bursts(frame, config);
    config.hi_z.enabled = false;
    const std::uint64_t without = dead_bursts(frame, config);
    CHECK(kills.dead == without);
    CHECK(kills.choices[0] == without - with);
    CHECK(kills.oracle_samples <= kills.dead);
    CHECK(kills.oracle_plane <= kills.oracle_samples);
    for (const std::uint64_t choice : kills.choices) {
      CHECK(choice <= kills.oracle_plane);
    }
    stopped += kills.choices[0];
  }
  CHECK(stopped > 100);
}

}  // namespace halfspace::testing
