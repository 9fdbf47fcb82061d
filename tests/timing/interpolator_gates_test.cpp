// The gates of the interpolator behind early_z, each alone: a packet moves in the cycle that the formula of
// docs/units/interpolator.md names. Numbers are written out.
#include <catch2/catch.hpp>
#include <cstdint>
#include <vector>

#include "halfspace/timing/recurrence/core.hpp"
#include "halfspace/timing/recurrence/cycle_probe.hpp"

namespace halfspace::testing::interpolator_gates {
namespace {

/// A machine with the interpolator, that is given bursts by hand; all else is as deep as it can be.
class Rig {
 public:
  explicit Rig(const Config& config)
      : probe_(capacities(config), &times),
        memory_(recurrence_memory<InterpolatingMachine>(config, 1000)),
        core_(memory_, NoStalls{}, probe_) {
    probe_.draw(0, core_.progress());
  }

  /// A triangle of one burst. `live`: which of its quads ask for attributes.
  void burst(int quads, std::uint64_t live, bool late = false, std::uint32_t late_done = 0) {
    core_.drawn();
    core_.block(0, 1);
    core_.job({.quads = quads, .late_done = late_done, .late = late, .live = live});
    core_.block_done();
    core_.walked(0);
  }
  void fast_clear(std::uint64_t cycles) { core_.fast_clear(cycles); }
  std::uint64_t flush() { return core_.flush({}, 128); }
  FrameCycles finish() {
    probe_.drained(core_.progress());
    const std::uint64_t cycles = flush();
    return probe_.finish(cycles, core_.progress());
  }

  PacketTimes times;

 private:
  CycleProbe<true> probe_;
  RecurrenceMemory<InterpolatingMachine> memory_;
  RecurrenceCore<InterpolatingMachine, NoStalls, CycleProbe<true>> core_;
};

Config machine_with(int attributes, int bits = 24) {
  Config config;
  config.setup.queue = config.setup.fifo = 64;
  config.early_z.fifo = 64;
  config.interpolator.enabled = true;
  config.interpolator.attributes = attributes;
  config.interpolator.bits = bits;
  config.interpolator.fifo = 64;
  return config;
}

}  // namespace

TEST_CASE("timing gates: latency of the interpolator", "[timing]") {
  for (const auto& [bits, latency] : {std::pair{8, 26u}, {16, 30u}, {24, 34u}}) {
    Rig rig(machine_with(3, bits));
    rig.burst(1, 1);
    const std::uint64_t taken = rig.times.b.at(0) + 2;
    CHECK(rig.times.y == std::vector<std::uint64_t>{taken});
    CHECK(rig.times.s ==
          std::vector<std::uint64_t>{taken + latency, taken + latency + 1, taken + latency + 2});
  }
}

TEST_CASE("timing gates: a quad with one attribute a cycle", "[timing]") {
  Rig rig(machine_with(5));
  for (int n = 0; n < 40; ++n) {
    rig.burst(16, 0xFFFF);
  }
  CHECK(rig.times.y.at(39) - rig.times.y.at(29) == 10 * 16 * 5);
  CHECK(rig.times.s.size() == 40u * 16 * 5);
  CHECK(rig.times.s.back() - rig.times.s.front() == 40u * 16 * 5 - 1);
}

TEST_CASE("timing gates: a beat of which nothing passed takes a cycle", "[timing]") {
  Config config = machine_with(2);
  config.early_z.quads_per_cycle = 2;
  Rig rig(config);
  for (int n = 0; n < 40; ++n) {
    rig.burst(7, 0b1000011);  // beats of 2, 0, 0, 1 quads: 4 + 1 + 1 + 2 cycles
  }
  CHECK(rig.times.y.at(39) - rig.times.y.at(29) == 10 * 8);
  CHECK(rig.times.s.size() == 40u * 3 * 2);
  // quads 0, 0, 1, 1, then two dead beats, then quad 6
  const std::uint64_t first = rig.times.s.at(0);
  CHECK(rig.times.s.at(3) == first + 3);
  CHECK(rig.times.s.at(4) == first + 6);
  CHECK(rig.times.s.at(5) == first + 7);

  Rig dead(config);
  for (int n = 0; n < 40; ++n) {
    dead.burst(7, 0);
  }
  CHECK(dead.times.s.empty());
  CHECK(dead.times.y.at(39) - dead.times.y.at(29) == 10 * 4);  // as fast as z_test tests
}

TEST_CASE("timing gates: the interpolator waits for its FIFO", "[timing]") {
  Config config = machine_with(1, 8);
  config.interpolator.fifo = 2;
  Rig rig(config);
  for (int n = 0; n < 40; ++n) {
    rig.burst(1, 1);
  }
  // start(n) = s(n - 2) + 1 and s = start + 26: two quads in 27 cycles
  CHECK(rig.times.s.at(39) - rig.times.s.at(19) == 10 * 27);
  const CycleStats stats = rig.finish().stats;
  const StageCycles& stage = stats.stage[static_cast<std::size_t>(Stage::kInterpolator)];
  CHECK(stage.busy == 40);
  CHECK(stage.stall[stall::kInterpolatorNoCredit] == rig.times.s.at(39) - 26 - rig.times.y.at(0) - 39);
  CHECK(stats.packets[static_cast<std::size_t>(Link::kInterpolator)] == 40);

  config.interpolator.fifo = 27;
  Rig full_rate(config);
  for (int n = 0; n < 100; ++n) {
    full_rate.burst(4, 0xF);
  }
  CHECK(full_rate.times.s.at(399) - full_rate.times.s.at(199) == 200);
}

TEST_CASE("timing gates: bursts wait in early_z until the interpolator has them", "[timing]") {
  Config config = machine_with(8);
  config.early_z.fifo = 2;
  Rig rig(config);
  for (int n = 0; n < 40; ++n) {
    rig.burst(1, 1);
  }
  CHECK(rig.times.b.at(39) ==
        rig.times.y.at(37) + 8);  // the cycle after the last attribute of burst 37 began
}

TEST_CASE("timing gates: a clear waits for the last quad of the interpolator", "[timing]") {
  Rig rig(machine_with(1));
  rig.burst(1, 1);
  const std::uint64_t last = rig.times.s.at(0);
  rig.fast_clear(100);
  rig.burst(1, 1);
  CHECK(rig.times.decide.at(1) == last + 1 + 100 + 4);
}

TEST_CASE("timing gates: the shader answers when it has the last attribute of the burst", "[timing]") {
  Config config = machine_with(4);
  config.late_z.mode = LateZ::kLate;
  config.late_z.latency = 50;
  Rig rig(config);
  rig.burst(1, 1, true);
  rig.burst(1, 1, true, 1);
  // s of the fourth attribute, 50 cycles in the shader from the cycle after, a cycle for the late write
  CHECK(rig.times.b.at(1) == rig.times.s.at(3) + 1 + 50 + 1);
}

TEST_CASE("timing gates: a frame ends with the last quad of the interpolator", "[timing]") {
  Config config = machine_with(8);
  config.z_cache.lines = 4;
  Rig rig(config);
  rig.burst(16, 0xFFFF);
  rig.burst(1, 0);
  const FrameCycles cycles = rig.finish();
  const std::uint64_t last = rig.times.s.at(127);
  CHECK(cycles.cycles == last + 1 + 128);  // the flush looks at a line a cycle
  CHECK(cycles.draws.at(0).end == last);
}

}  // namespace halfspace::testing::interpolator_gates
