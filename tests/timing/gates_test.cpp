// Every gate of the timing contract alone: a packet moves in the cycle that the formula of the unit's page
// names, not one earlier and not one later; and every unit alone reaches the rate of its formula. Numbers are
// those of docs/units, written out.
#include <catch2/catch.hpp>
#include <memory>

#include "halfspace/timing/recurrence/core.hpp"
#include "halfspace/timing/recurrence/cycle_probe.hpp"

using namespace halfspace;

namespace {

/// A machine that is given packets by hand. Its FIFOs are as deep as they can be unless a test says
/// otherwise.
class Rig {
 public:
  explicit Rig(const Config& config)
      : probe_(capacities(config), &times),
        memory_(recurrence_memory(config, 1000)),
        core_(memory_, NoStalls{}, probe_),
        lines_(static_cast<std::uint32_t>(config.z_cache.lines)) {
    probe_.draw(0, core_.progress());
  }

  void dropped(int count = 1) {
    for (int i = 0; i < count; ++i) {
      core_.dropped();
    }
  }
  /// A triangle whose jobs have so many quads each, a block each that comes after `empty` without a tile.
  void triangle(std::uint32_t empty, const std::vector<int>& quads, std::uint32_t empty_after = 0) {
    core_.drawn();
    for (const int q : quads) {
      block(empty, {q});
    }
    core_.walked(empty_after);
  }
  void drawn() { core_.drawn(); }
  void walked(std::uint32_t empty_after) { core_.walked(empty_after); }
  void block(std::uint32_t empty, const std::vector<int>& quads) {
    core_.block(empty, static_cast<int>(quads.size()));
    for (const int q : quads) {
      core_.job({.quads = q});
    }
    core_.block_done();
  }
  /// A triangle with one burst that misses.
  void miss(int quads, const std::vector<ZMiss>& misses) {
    core_.drawn();
    core_.block(0, 1);
    core_.job({.quads = quads, .misses = misses});
    core_.block_done();
    core_.walked(0);
  }
  void fast_clear(std::uint64_t cycles) { core_.fast_clear(cycles); }
  std::uint64_t flush(const std::vector<ZFlush>& dirty) { return core_.flush(dirty, lines_); }

  PacketTimes times;

 private:
  CycleProbe<true> probe_;
  RecurrenceMemory<OneMachine> memory_;
  RecurrenceCore<OneMachine, NoStalls, CycleProbe<true>> core_;
  std::uint32_t lines_;
};

Config deep() {
  Config config;
  config.depth.interpolator = DepthInterpolator::kBarycentric;  // a division of 18 cycles
  config.setup.queue = config.setup.fifo = config.tile_walker.fifo = config.quad_generator.fifo = 64;
  config.block_walker.fifo = 8;
  config.edge_evaluator.fifo = 32;
  config.early_z.pending = config.early_z.fifo = 64;
  config.z_cache.misses_in_flight = config.z_cache.write_buffers = 64;
  return config;
}

ZMiss fetch(std::uint32_t line) { return {.line = line, .bytes = 256, .fetch = true}; }

ZMiss evict(std::uint32_t line, std::uint32_t victim) {
  return {
      .line = line, .victim = victim, .bytes = 256, .victim_bytes = 256, .fetch = true, .write_back = true};
}

/// Cycles from packet n - count to packet n, far from the start.
std::uint64_t span(const std::vector<std::uint64_t>& times, std::size_t count) {
  return times.back() - times[times.size() - 1 - count];
}

}  // namespace

TEST_CASE("timing gates: latency of each unit", "[timing]") {
  Rig rig(deep());
  rig.triangle(0, {4});
  CHECK(rig.times.decide.at(0) == 4);
  CHECK(rig.times.accept.at(0) == 4 + 18);
  CHECK(rig.times.block.at(0) == 22 + 1);  // the first step is in the cycle after the load
  CHECK(rig.times.emit.at(0) == 23 + 2);
  CHECK(rig.times.e.at(0) == 25 + 3);
  CHECK(rig.times.g.at(0) == 28 + 3);  // two pipeline registers and the output register
  CHECK(rig.times.f.at(0) == 31 + 2);
  CHECK(rig.times.b.at(0) == 33 + 17);
  CHECK(rig.times.y.at(0) == 50 + 2);
}

TEST_CASE("timing gates: the division for the plane", "[timing]") {
  Config config = deep();
  config.depth.interpolator = DepthInterpolator::kPlane;
  Rig rig(config);
  rig.triangle(0, {4});
  CHECK(rig.times.accept.at(0) == 4 + 35);
}

TEST_CASE("timing gates: pipeline registers of the interpolator", "[timing]") {
  for (const int registers : {12, 13, 32}) {
    Config config = deep();
    config.depth.latency = registers;
    Rig rig(config);
    rig.triangle(0, {4});
    CHECK(rig.times.b.at(0) == rig.times.f.at(0) + static_cast<std::uint64_t>(registers) + 5);
  }
}

TEST_CASE("timing gates: pipeline registers of the edge evaluator", "[timing]") {
  for (const int stages : {1, 2, 3}) {
    Config config = deep();
    config.edge_evaluator.pipe_stages = stages;
    Rig rig(config);
    rig.triangle(0, {4});
    CHECK(rig.times.g.at(0) == rig.times.e.at(0) + static_cast<std::uint64_t>(stages) + 1);
  }
}

TEST_CASE("timing gates: a full queue stops setup until a decision", "[timing]") {
  Config config = deep();
  config.setup.queue = 2;
  Rig rig(config);
  rig.dropped(100);
  // cull(n) = decide(n - 2) + 1 and decide = cull + 4: two triangles in 5 cycles
  CHECK(span(rig.times.decide, 20) == 50);
  Config enough = deep();
  enough.setup.queue = 5;
  Rig full_rate(enough);
  full_rate.dropped(100);
  CHECK(span(full_rate.times.decide, 20) == 20);
}

TEST_CASE("timing gates: setup waits for its FIFO, and drops without it", "[timing]") {
  Config config = deep();
  config.setup.fifo = 2;
  Rig rig(config);
  rig.triangle(999, {0});  // the walker is busy until 22 + 1000
  rig.triangle(0, {0});
  rig.triangle(0, {0});
  rig.dropped();
  const std::vector<std::uint64_t>& decide = rig.times.decide;
  CHECK(decide.at(0) == 4);
  CHECK(decide.at(1) == 5);  // two triangles fit
  CHECK(rig.times.accept.at(0) == 22);
  CHECK(decide.at(2) == 22 + 1);  // the slot of the first, in the cycle after it left
  CHECK(rig.times.accept.at(1) == 1022);
  rig.triangle(0, {0});
  CHECK(decide.at(3) == 24);  // dropped: needs no slot
  CHECK(decide.at(4) == 1022 + 1);
}

TEST_CASE("timing gates: the divider takes a drawn triangle every so many cycles", "[timing]") {
  for (const int interval : {1, 2, 4, 8, 16}) {
    Config config = deep();
    config.setup.interval = interval;
    Rig rig(config);
    rig.triangle(0, {0});
    rig.dropped();
    rig.triangle(0, {0});
    const auto wait = static_cast<std::uint64_t>(interval);
    CHECK(rig.times.decide.at(1) == 5);  // a dropped one does not wait
    CHECK(rig.times.decide.at(2) == 4 + std::max<std::uint64_t>(wait, 2));
  }
}

TEST_CASE("timing gates: a triangle is loaded in the last step of the one before", "[timing]") {
  Rig rig(deep());
  rig.triangle(9, {4, 4}, 5);
  rig.triangle(0, {4});
  CHECK(rig.times.block.at(0) == 22 + 10);
  CHECK(rig.times.block.at(1) == 22 + 20);
  CHECK(rig.times.accept.at(1) == 22 + 25);
  CHECK(rig.times.block.at(2) == 22 + 26);
}

TEST_CASE("timing gates: every step of the block walker waits for a credit", "[timing]") {
  Config config = deep();
  config.block_walker.fifo = 2;
  Rig rig(config);
  rig.drawn();
  rig.block(0, {0, 0, 0, 0});
  rig.block(0, {0});
  rig.block(5, {0});
  rig.walked(3);
  rig.triangle(0, {0});
  CHECK(rig.times.block.at(0) == 23);
  CHECK(rig.times.block.at(1) == 24);
  CHECK(rig.times.emit.at(3) == 28);            // the first block leaves with its last tile
  CHECK(rig.times.block.at(2) == 29 + 5);       // blocks without a tile wait too
  CHECK(rig.times.accept.at(1) == 29 + 5 + 3);  // a slot is free long since
}

TEST_CASE("timing gates: the tiles of a block follow each other", "[timing]") {
  Rig rig(deep());
  rig.drawn();
  rig.block(0, {0, 0, 0});
  rig.block(0, {0});
  CHECK(rig.times.emit == std::vector<std::uint64_t>{25, 26, 27, 28});
}

TEST_CASE("timing gates: the tile walker waits for its FIFO", "[timing]") {
  Config config = deep();
  config.tile_walker.fifo = 2;
  Rig rig(config);
  rig.triangle(0, {0, 0, 0});
  CHECK(rig.times.emit.at(1) == 26);
  CHECK(rig.times.e.at(0) == 28);
  CHECK(rig.times.emit.at(2) == 29);  // not in 28, when the slot is being freed
}

TEST_CASE("timing gates: the edge evaluator waits for its FIFO", "[timing]") {
  Config config = deep();
  config.edge_evaluator.fifo = 2;
  Rig rig(config);
  rig.triangle(0, {64, 64, 64, 64});
  CHECK(rig.times.e.at(1) == 29);
  CHECK(rig.times.g.at(0) == 31);
  CHECK(rig.times.e.at(2) == 32);
}

TEST_CASE("timing gates: the quad generator waits for a whole burst of its FIFO", "[timing]") {
  Config config = deep();
  config.quad_generator.fifo = 2;
  config.early_z.pending = 2;
  Rig rig(config);
  rig.triangle(0, {16, 16, 0, 16});  // 4 beats each, and an empty coverage
  CHECK(rig.times.g.at(0) == 31);
  CHECK(rig.times.g.at(1) == 35);
  CHECK(rig.times.f.at(0) == 33);
  CHECK(rig.times.g.at(2) == 39);  // the first burst left with its last beat in 36
  CHECK(rig.times.g.at(3) == 40);  // the empty coverage took a cycle and no slot
}

TEST_CASE("timing gates: the pending store takes a burst when one has been tested", "[timing]") {
  Config config = deep();
  config.early_z.pending = 2;
  config.early_z.quads_per_cycle = 1;
  Rig rig(config);
  rig.triangle(0, {16, 4, 4});
  CHECK(rig.times.f.at(0) == 33);
  CHECK(rig.times.b.at(0) == 50);  // 16 quads, one a cycle: until 65
  CHECK(rig.times.f.at(1) == 37);
  CHECK(rig.times.f.at(2) == 66);
  CHECK(rig.times.b.at(1) == 66);
}

TEST_CASE("timing gates: the test waits for the sink", "[timing]") {
  Config config = deep();
  config.early_z.fifo = 2;
  Rig rig(config);
  rig.triangle(0, {4, 4, 4});
  CHECK(rig.times.b.at(1) == 51);
  CHECK(rig.times.y.at(0) == 52);
  CHECK(rig.times.b.at(2) == 53);
}

TEST_CASE("timing gates: a fetched line arrives after latency and transfer", "[timing]") {
  Config config = deep();
  config.memory.latency = 50;
  config.memory.read_bytes = 64;
  Rig rig(config);
  rig.miss(4, {fetch(1)});
  CHECK(rig.times.f.at(0) == 33);
  // requested in 34, the first data in 84, the last in 87
  CHECK(rig.times.b.at(0) == 88);
  rig.triangle(0, {4});
  CHECK(rig.times.b.at(1) == 89);  // in order
}

TEST_CASE("timing gates: lines made from the clear value are resolved one a cycle", "[timing]") {
  Rig rig(deep());
  rig.miss(4, {{.line = 1, .bytes = 256}});
  CHECK(rig.times.f.at(0) == 33);
  CHECK(rig.times.b.at(0) == 50);
  rig.miss(4, {{.line = 2, .bytes = 256}, {.line = 3, .bytes = 256}, {.line = 4, .bytes = 256}});
  CHECK(rig.times.f.at(1) == 34);  // while the line before is resolved; its own in 32, 36, 37
  CHECK(rig.times.b.at(1) == 51);
  rig.triangle(0, {4});
  CHECK(rig.times.f.at(2) == 37);
}

TEST_CASE("timing gates: a cleared line that was replaced is resolved when it is out", "[timing]") {
  Config config = deep();
  config.memory.latency = 50;
  Rig rig(config);
  rig.miss(4, {{.line = 1, .victim = 7, .bytes = 256, .victim_bytes = 256, .fetch = true}});
  rig.miss(4, {{.line = 7, .bytes = 256}});
  CHECK(rig.times.b.at(0) == 88);
  CHECK(rig.times.b.at(1) == 90);  // resolved in 89
}

TEST_CASE("timing gates: a request waits for a fill buffer", "[timing]") {
  Config config = deep();
  config.z_cache.misses_in_flight = 1;
  config.memory.latency = 50;
  Rig rig(config);
  rig.miss(4, {fetch(1)});
  rig.miss(4, {fetch(2)});
  CHECK(rig.times.b.at(0) == 88);
  CHECK(rig.times.b.at(1) == 89 + 50 + 4);  // requested in 89
}

TEST_CASE("timing gates: a line that left may be asked for when it is in memory", "[timing]") {
  Config config = deep();
  config.memory.latency = 50;
  config.memory.write_bytes = 8;  // 32 cycles a line
  Rig rig(config);
  rig.miss(4, {evict(1, 7)});
  rig.miss(4, {fetch(7)});
  CHECK(rig.times.b.at(0) == 88);
  // written from 89 to 120, requested in 121, there in 121 + 50 + 3
  CHECK(rig.times.b.at(1) == 175);
  SECTION("a clean one when it is out of the cache") {
    Rig clean(config);
    clean.miss(4, {{.line = 1, .victim = 7, .bytes = 256, .victim_bytes = 256, .fetch = true}});
    clean.miss(4, {fetch(7)});
    CHECK(clean.times.b.at(1) == 89 + 50 + 4);
  }
}

TEST_CASE("timing gates: a dirty victim waits for a slot of the write buffer", "[timing]") {
  Config config = deep();
  config.memory.latency = 1;
  config.memory.read_bytes = 256;
  config.memory.write_bytes = 8;
  config.z_cache.write_buffers = 2;
  Rig rig(config);
  for (std::uint32_t i = 0; i < 4; ++i) {
    rig.miss(4, {evict(i, 100 + i)});
  }
  const std::vector<std::uint64_t>& b = rig.times.b;
  CHECK(b.at(1) == b.at(0) + 1);       // a beat each, and the request of the one before
  CHECK(b.at(2) == b.at(0) + 32 + 1);  // the first is written in the 32 cycles after b(0)
  CHECK(b.at(3) == b.at(0) + 64 + 1);
}

TEST_CASE("timing gates: requests of one burst follow each other", "[timing]") {
  Config config = deep();
  config.memory.latency = 50;
  Rig rig(config);
  rig.miss(4, {fetch(1), fetch(2), fetch(3)});
  CHECK(rig.times.b.at(0) == 34 + 50 + 3 * 4);  // the channel is busy for 4 cycles a line
  rig.triangle(0, {4});
  CHECK(rig.times.f.at(1) == 36);  // requests in 34, 32, 36
}

TEST_CASE("timing gates: a clear waits until the machine is empty", "[timing]") {
  Rig rig(deep());
  rig.triangle(0, {4});
  CHECK(rig.times.y.at(0) == 52);
  rig.fast_clear(100);
  rig.dropped();
  CHECK(rig.times.decide.at(1) == 53 + 100 + 4);
}

TEST_CASE("timing gates: a clear waits for writes to memory", "[timing]") {
  Config config = deep();
  config.memory.latency = 1;
  config.memory.write_bytes = 1;
  Rig rig(config);
  rig.miss(4, {evict(1, 7)});
  const std::uint64_t written = rig.times.b.at(0) + 256;
  rig.fast_clear(100);
  rig.dropped();
  CHECK(rig.times.decide.at(1) == written + 1 + 100 + 4);
}

TEST_CASE("timing gates: the flush looks at a line a cycle and waits for the write buffer", "[timing]") {
  Config config = deep();
  config.z_cache.lines = 16;
  config.z_cache.write_buffers = 1;
  config.memory.write_bytes = 64;
  Rig clean(config);
  clean.triangle(0, {4});
  CHECK(clean.flush({}) == 53 + 16);
  Rig dirty(config);
  dirty.triangle(0, {4});
  // line 2 is seen in 55 and written in 56 to 59; line 3 finds the slot in 60 and is written in 61 to 64
  CHECK(dirty.flush({{.slot = 2, .bytes = 256}, {.slot = 3, .bytes = 256}}) == 60 + 1 + 12);
  Rig last(config);
  last.triangle(0, {4});
  CHECK(last.flush({{.slot = 15, .bytes = 256}}) == 53 + 16 + 4);
}

TEST_CASE("timing rates: setup takes a triangle a cycle, a drawn one each interval", "[timing]") {
  Rig culled(deep());
  culled.dropped(200);
  CHECK(span(culled.times.decide, 100) == 100);
  for (const int interval : {1, 2, 4, 8, 16}) {
    Config config = deep();
    config.setup.interval = interval;
    Rig rig(config);
    for (int i = 0; i < 200; ++i) {
      rig.triangle(0, {0});
    }
    CHECK(span(rig.times.decide, 100) == static_cast<std::uint64_t>(100 * interval));
  }
}

TEST_CASE("timing rates: setup with few slots gives so many triangles in 19 cycles", "[timing]") {
  for (const int slots : {2, 4, 16}) {
    Config config = deep();
    config.setup.fifo = slots;
    Rig rig(config);
    for (int i = 0; i < 400; ++i) {
      rig.triangle(0, {0});
    }
    CHECK(span(rig.times.decide, static_cast<std::size_t>(10 * slots)) == 190);
  }
}

TEST_CASE("timing rates: a block a cycle", "[timing]") {
  Rig rig(deep());
  for (int i = 0; i < 100; ++i) {
    rig.triangle(4, {0}, 2);
  }
  CHECK(span(rig.times.accept, 10) == 10 * 7);
}

TEST_CASE("timing rates: few slots between walker, evaluator and quad generator", "[timing]") {
  const auto rate = [](int walker, int edge, int stages) {
    Config config = deep();
    config.tile_walker.fifo = walker;
    config.edge_evaluator.fifo = edge;
    config.edge_evaluator.pipe_stages = stages;
    Rig rig(config);
    rig.triangle(0, std::vector<int>(200, 0));
    return span(rig.times.g, 60);
  };
  CHECK(rate(64, 32, 2) == 60);
  CHECK(rate(2, 32, 2) == 120);  // two in 4 cycles
  CHECK(rate(3, 32, 2) == 80);
  CHECK(rate(4, 32, 2) == 60);
  CHECK(rate(64, 2, 2) == 120);  // two in 4
  CHECK(rate(64, 3, 2) == 80);
  CHECK(rate(64, 4, 2) == 60);
  CHECK(rate(64, 2, 3) == 150);  // two in 5
}

TEST_CASE("timing rates: quads a cycle", "[timing]") {
  for (const int width : {1, 2, 4, 8, 16}) {
    for (const int quads : {1, 3, 4, 7, 16}) {
      Config config = deep();
      config.quad_generator.quads_per_cycle = width;
      config.early_z.quads_per_cycle = width;
      Rig rig(config);
      rig.triangle(0, std::vector<int>(300, quads));
      const int beats = (quads + width - 1) / width;
      CHECK(span(rig.times.g, 50) == static_cast<std::uint64_t>(50 * beats));
      CHECK(span(rig.times.y, 50) == static_cast<std::uint64_t>(50 * beats));
    }
  }
}

TEST_CASE("timing rates: a narrower test", "[timing]") {
  Config config = deep();
  config.early_z.quads_per_cycle = 2;
  Rig rig(config);
  rig.triangle(0, std::vector<int>(500, 7));  // 2 beats in, 4 to test
  CHECK(span(rig.times.y, 50) == 200);
}

TEST_CASE("timing rates: few slots at the sink, a short pending store", "[timing]") {
  Config sink = deep();
  sink.early_z.fifo = 2;
  Rig few_slots(sink);
  few_slots.triangle(0, std::vector<int>(500, 4));
  CHECK(span(few_slots.times.y, 40) == 60);  // two in 2 + 1
  Config pending = deep();
  pending.early_z.pending = 4;
  Rig short_store(pending);
  short_store.triangle(0, std::vector<int>(500, 4));
  CHECK(span(short_store.times.y, 40) == 180);  // four in 17 + 1
}

TEST_CASE("timing rates: memory's bandwidth, latency and write channel", "[timing]") {
  const auto rate = [](int buffers, int latency, int read_bytes, int write_bytes, bool dirty) {
    Config config = deep();
    config.z_cache.misses_in_flight = buffers;
    config.memory.latency = latency;
    config.memory.read_bytes = read_bytes;
    config.memory.write_bytes = write_bytes;
    Rig rig(config);
    for (std::uint32_t i = 0; i < 300; ++i) {
      rig.miss(4, {dirty ? evict(i, 500 + i) : fetch(i)});
    }
    return span(rig.times.b, 40);
  };
  CHECK(rate(64, 10, 32, 256, false) == 40 * 8);              // 256 bytes, 32 a cycle
  CHECK(rate(4, 100, 64, 256, false) == 10 * (100 + 4 + 1));  // four lines in latency, transfer and a cycle
  CHECK(rate(64, 10, 256, 16, true) == 40 * 16);
}
