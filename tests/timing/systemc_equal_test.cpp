// Two implementations of docs/timing.md, with nothing in common but the units: every packet of both moves in
// the same cycle, every cycle of every stage has the same reason, and both give the image of the functional
// run.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <iostream>
#include <sstream>
#include <string>

#include "../line_frames.hpp"
#include "../property/hard_frames.hpp"
#include "differences.hpp"
#include "halfspace/core/functional.hpp"
#include "halfspace/scene/ptf.hpp"
#include "halfspace/scene/validate.hpp"
#include "halfspace/timing/recurrence/run_recurrence.hpp"
#include "halfspace/timing/systemc/run_systemc.hpp"
#include "random_machine.hpp"

using namespace halfspace;
using namespace halfspace::testing;

namespace {

/// Runs the frame by all three engines; empty where nothing differs.
std::string compare(const Frame& frame, const Config& config, const StallPlan& stalls) {
  Events functional_events;
  const FrameResult functional = run_functional(
      frame, config, {.keep_visible = true, .keep_sums = true, .observer = &functional_events});

  const auto options = [&](Events& events) {
    return EngineOptions{.watch = {.keep_visible = true, .keep_sums = true, .observer = &events},
                         .stalls = stalls,
                         .packet_times = true};
  };
  Events events;
  const TimedResult systemc = run_systemc(frame, config, options(events));
  Events recurrence_events;
  const TimedResult recurrence = run_recurrence(frame, config, options(recurrence_events));

  return difference(systemc.frame, functional) + difference(recurrence.frame, functional) +
         difference(events, functional_events) + difference(recurrence_events, functional_events) +
         difference(systemc.times, recurrence.times) + difference(systemc.cycles, recurrence.cycles) +
         difference("cycle of quad", events.cycles, recurrence_events.cycles);
}

std::uint64_t cases() {
  const char* text = std::getenv("HALFSPACE_CASES");
  return text != nullptr ? std::stoull(text) : 300;
}

}  // namespace

TEST_CASE("systemc equals recurrence on vkcube", "[timing]") {
  const Frame frame = read_ptf(HALFSPACE_SCENES "/vkcube.ptf.xz");
  CHECK(compare(frame, {}, {}) == "");
}

TEST_CASE("systemc runs a process for what it does, and hardly more", "[timing]") {
  const Frame frame = read_ptf(HALFSPACE_SCENES "/vkcube.ptf.xz");
  for (const char* machine : {"baseline", "small", "wide", "shallow", "slow_memory"}) {
    const Config config = read_config(std::string(HALFSPACE_CONFIGS "/") + machine + ".toml");
    std::uint64_t activations = 0;
    EngineOptions options;
    options.packet_times = true;
    const TimedResult run = run_systemc(frame, config, options, {.vcd = {}, .activations = &activations});
    std::uint64_t actions = run.times.decide.size();  // of the source
    PacketTimes::lists([&](const char*, auto list) { actions += (run.times.*list).size(); });
    const EarlyZCounters& early_z = run.frame.counters.early_z;
    const std::uint64_t written = early_z.z_evicted + run.frame.flushed_lines;
    actions += early_z.z_misses + 3 * written;  // a write is seen, begins and ends
    CAPTURE(machine, activations, actions);
    CHECK(10 * activations <= 11 * actions);
  }
}

TEST_CASE("systemc equals recurrence on lines and points", "[timing]") {
  const std::uint64_t first = seed();
  for (std::uint64_t n = 0; n < cases() / 3; ++n) {
    Random random(first + 100 + n);
    const Config config = random_config(random);
    const Frame frame = random_lines(random, takes_thin_lines(config));
    const StallPlan stalls = random_stalls(random);
    validate(frame);
    CAPTURE(first, n);
    REQUIRE(compare(frame, config, stalls) == "");
  }
}

TEST_CASE("systemc equals recurrence with depths outside [0, 1]", "[timing]") {
  const std::uint64_t first = seed();
  for (std::uint64_t n = 0; n < cases() / 3; ++n) {
    Random random(first + n);
    const Config config = random_config(random);  // of one sample: several refuse depths far outside
    CAPTURE(first + n, difference_from_default(config));
    REQUIRE(compare(unrestricted_frame(random), config, random_stalls(random)) == "");
  }
}

TEST_CASE("systemc equals recurrence on random machines", "[timing]") {
  const std::uint64_t first = seed();
  std::cout << "seed " << first << ", " << cases() << " cases\n";
  for (std::uint64_t n = 0; n < cases(); ++n) {
    Random random(first + n);
    const Config config = random_sampled_config(random);
    const Frame frame = random_frame(random);
    const StallPlan stalls = random_stalls(random);
    validate(config);
    validate(frame);
    const std::string found = compare(frame, config, stalls);
    if (!found.empty()) {
      FAIL("HALFSPACE_SEED=" << first + n << " HALFSPACE_CASES=1\n"
                             << difference_from_default(config) << "systemc against the other:\n"
                             << found);
    }
  }
}

TEST_CASE("systemc equals recurrence with the interpolator", "[timing]") {
  const std::uint64_t first = seed();
  std::uint64_t waits = 0;
  std::uint64_t killed = 0;
  for (std::uint64_t n = 0; n < cases(); ++n) {
    Random random(first + 1000 + n);
    Config config = random_sampled_config(random);
    draw_interpolator(random, config);
    const bool lines = n % 8 == 0 && sample_pattern(config).is_centre();
    const Frame frame = lines ? random_lines(random, takes_thin_lines(config)) : random_frame(random);
    StallPlan stalls = random_stalls(random);
    if (random.between(0, 1) == 0) {
      stalls.rate[static_cast<std::size_t>(StallPoint::kInterpolator)] = random_rate(random);
    }
    validate(frame);
    CAPTURE(first, n, difference_from_default(config));
    REQUIRE(compare(frame, config, stalls) == "");
    EngineOptions options;
    options.stalls = stalls;
    const TimedResult run = run_recurrence(frame, config, options);
    const auto stage = static_cast<std::size_t>(Stage::kInterpolator);
    waits += run.cycles.stats.stage[stage].stall[stall::kInterpolatorNoCredit];
    killed += run.frame.counters.interpolator.quads_killed;
    REQUIRE(run.cycles.stats.packets[static_cast<std::size_t>(Link::kInterpolator)] ==
            run.frame.counters.interpolator.attributes);
  }
  CHECK(waits != 0);
  CHECK(killed != 0);
}
