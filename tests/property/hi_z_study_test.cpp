// What the study of hi_z counts is what the machine does: a burst that is stopped does not come to die.
#include <catch2/catch.hpp>
#include <set>

#include "halfspace/machine/in_order.hpp"
#include "halfspace/timing/recurrence/run_recurrence.hpp"
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
  std::uint64_t by_time = 0;
  for (std::uint64_t run = 0; run < samples(400'000) / 2000; ++run) {
    CAPTURE(seed(), run);
    Config config = random_config(random);
    config.hi_z.enabled = true;
    config.tile_walker.order = TileOrder::kRaster;
    config.z_cache.parts = 1;
    config.z_cache.fast_clear = true;  // a drawn clear is no draw of the frame, and may not be told apart
    CAPTURE(difference_from_default(config));
    const Frame frame = random.between(0, 1) == 0 ? depth_stack(random) : hard_frame(random);
    const std::vector<whatif::HiZChoice> choices{
        {.bits = config.hi_z.bits, .lag = config.hi_z.lag},
        {.bits = 32, .lag = 1},
        {.bits = config.hi_z.bits, .lag = config.hi_z.lag, .timed = true},
        {.bits = config.hi_z.bits, .lag = std::nullopt}};
    const whatif::HiZKills kills = whatif::count_hi_z_kills(frame, config, choices);
    const std::uint64_t with = dead_bursts(frame, config);
    CHECK(kills.choices[2] == kills.choices[0]);
    CHECK(kills.cycles[2] == run_recurrence(frame, config).cycles.cycles);
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
    by_time += kills.choices[3];
  }
  CHECK(stopped > 100);
  CHECK(by_time > 100);
}

TEST_CASE("hi_z study: by time a block sees an update from the cycle on in which it is ready", "[timing]") {
  Config config;
  config.hi_z.enabled = true;
  config.hi_z.lag = 1024;  // by order nothing is seen, so nothing is rejected before the last block
  config.setup.interval = 1;
  std::set<std::int64_t> after;  // the update was ready; below 0: before
  for (int between = 0; between < 60; ++between) {
    FrameBuilder builder(128);
    builder.draw({{0, 0, 0.25}, {32, 0, 0.25}, {0, 32, 0.25}});  // its first burst covers the first tile
    std::vector<glm::dvec3> dropped;                             // a cycle each
    for (int i = 0; i < between; ++i) {
      dropped.insert(dropped.end(), {{64, 64, 0.5}, {64.25, 64, 0.5}, {64, 64.25, 0.5}});
    }
    if (between != 0) {
      builder.draw(dropped);
    }
    builder.draw({{0, 0, 0.75}, {6, 0, 0.75}, {0, 6, 0.75}});
    const PacketTimes times =
        run_recurrence(builder.frame, config, {.watch = {}, .stalls = {}, .packet_times = true}).times;
    const std::uint64_t beats = 16 / static_cast<std::uint64_t>(config.early_z.quads_per_cycle);
    const std::uint64_t ready = times.b.front() + beats - 1 + 6;
    const bool seen = ready <= times.hi_z.back();
    CAPTURE(between, ready, times.hi_z.back());
    const whatif::HiZKills kills =
        whatif::count_hi_z_kills(builder.frame, config, {{.bits = 32, .lag = std::nullopt}});
    CHECK(kills.dead == 1);
    CHECK(kills.choices[0] == (seen ? 1 : 0));
    after.insert(static_cast<std::int64_t>(times.hi_z.back()) - static_cast<std::int64_t>(ready));
  }
  CHECK(after.contains(-1));
  CHECK(after.contains(0));
}

}  // namespace halfspace::testing
