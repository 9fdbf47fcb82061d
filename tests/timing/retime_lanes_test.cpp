// Many machines at once in SIMD lanes, of 16 and of 32 bits, against the recurrence of one machine in 64.
#include <catch2/catch.hpp>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "all_vectors.hpp"
#include "halfspace/machine/surfaces.hpp"
#include "halfspace/timing/record/retime.hpp"
#include "halfspace/timing/recurrence/core.hpp"
#include "halfspace/timing/recurrence/run_recurrence.hpp"
#include "random_machine.hpp"
#include "random_record.hpp"

using namespace halfspace;
using namespace halfspace::testing;

namespace {

/// The batch says what each machine says alone.
void check_batch(Retimer& retimer, const std::vector<Config>& machines) {
  std::vector<RetimedFrame> alone;
  alone.reserve(machines.size());
  for (const Config& config : machines) {
    alone.push_back(retimer.retime(config));
  }
  with_all_vectors([&] {
    const std::vector<RetimedFrame> batch = retimer.retime(machines);
    for (std::size_t i = 0; i < machines.size(); ++i) {
      CAPTURE(i, difference_from_default(machines[i]));
      REQUIRE(batch[i] == alone[i]);
    }
  });
}

struct NoteEnds : ReplayHooks {
  const RecurrenceCore<OneMachine, NoStalls, NoProbe>& core;
  RetimedFrame& result;

  void end_segment(const StreamSegment& segment, bool bursts) {
    if (segment.kind == StreamSegment::Kind::kDraw) {
      const std::uint64_t before = result.draw_end.empty() ? 0 : result.draw_end.back();
      result.draw_end.push_back(bursts ? core.sink_next() - 1 : before);
    }
  }
};

/// `record` on the machine of `config` with a time for each line of memory.
RetimedFrame with_all_lines(const FrameRecord& record, const Config& config) {
  const ZTrace trace = trace_lines(record, z_cache_shape(config));
  RecurrenceMemory<OneMachine> memory = recurrence_memory(config, trace.rows);
  NoProbe probe;
  RecurrenceCore<OneMachine, NoStalls, NoProbe> core(memory, NoStalls{}, probe);
  RetimedFrame result;
  NoteEnds hooks{{}, core, result};
  bool bursts = false;
  replay(whole_stream(record, trace), core, hooks, bursts, [&](std::uint32_t surface) {
    return static_cast<std::uint64_t>(fast_clear_cycles(record.surfaces[surface].tiles, config));
  });
  result.cycles = core.flush(trace.flush, static_cast<std::uint32_t>(config.z_cache.lines));
  return result;
}

/// One triangle with so many blocks of one job, each after `empty` without, all with 4 quads; bursts change
/// between `lines` tiles.
FrameRecord long_triangle(std::uint32_t jobs, std::uint32_t empty, std::uint32_t lines) {
  FrameRecord record;
  record.surfaces.push_back({.tiles_x = 64, .tiles = 512, .sample_bytes = 4});
  record.packets.segments.push_back({.surface = 0, .touches_depth = 1, .triangles = 1});
  record.packets.triangles.push_back({.blocks = jobs});
  for (std::uint32_t i = 0; i < jobs; ++i) {
    record.packets.blocks.emplace_back(empty, 1);
    record.packets.jobs.push_back(4);
    record.packets.accesses.emplace_back(i % lines % 64, i % lines / 64, std::uint8_t{15}, std::uint8_t{15});
  }
  return record;
}

/// 70 machines around `base`: more than a pass has.
std::vector<Config> latencies(const Config& base) {
  std::vector<Config> machines;
  for (int i = 0; i < 70; ++i) {
    machines.push_back(base);
    machines.back().memory.latency = base.memory.latency + i % 7;
    machines.back().early_z.pending = base.early_z.pending - i % 5;
  }
  return machines;
}

}  // namespace

TEST_CASE("lanes of every processor say what one machine says, on random packets", "[timing]") {
  Random random(seed());
  for (int run = 0; run < 40; ++run) {
    CAPTURE(seed(), run);
    const Config recorded = random_sampled_config(random);
    CAPTURE(difference_from_default(recorded));
    Retimer retimer(random_record(random, recorded));
    const auto count = static_cast<std::size_t>(random.between(1, 100));
    check_batch(retimer, random_machines(random, recorded, count));
  }
}

TEST_CASE("lanes of every processor say what a full run says, on random frames", "[timing]") {
  Random random(seed());
  for (int run = 0; run < 15; ++run) {
    CAPTURE(seed(), run);
    const Config recorded = random_sampled_config(random);
    const Frame frame = random_frame(random);
    Retimer retimer(record_frame(frame, recorded));
    const std::vector<Config> machines = random_machines(random, recorded, 40);
    check_batch(retimer, machines);
    for (const Config& config : machines) {
      CAPTURE(difference_from_default(config));
      REQUIRE(retimer.retime(config).cycles == run_recurrence(frame, config).cycles.cycles);
    }
  }
}

TEST_CASE("a table of few rows says what one of all lines of memory says", "[timing]") {
  Random random(seed());
  for (int run = 0; run < 60; ++run) {
    CAPTURE(seed(), run);
    const Config recorded = random_sampled_config(random);
    Retimer retimer(random_record(random, recorded));
    for (const Config& config : random_machines(random, recorded, 20)) {
      CAPTURE(difference_from_default(config));
      REQUIRE(retimer.retime(config) == with_all_lines(retimer.record(), config));
    }
  }
}

TEST_CASE("a table of few rows holds every line that a burst waits for", "[timing]") {
  // A line leaves, dirty; so do `more` others, and fill the write buffer; `clean` bursts pass that write
  // nothing, and fill the pending store; then the first line is asked for again.
  Config config;
  config.tile_walker.fifo = config.early_z.pending = config.z_cache.write_buffers = 64;
  config.z_cache.lines = config.z_cache.ways = 1;
  config.z_cache.misses_in_flight = 64;
  config.memory.latency = 1;
  config.memory.read_bytes = 1024;
  config.memory.write_bytes = 1;
  bool waited = false;
  for (const std::uint32_t more : {0u, 1u, 30u, 61u, 62u, 63u, 64u, 65u, 66u, 100u}) {
    for (const std::uint32_t clean : {0u, 1u, 30u, 61u, 62u, 63u, 64u, 65u, 66u, 200u}) {
      CAPTURE(more, clean);
      FrameRecord record = long_triangle(1 + more + clean + 2, 1, 512);
      record.config.z_cache = config.z_cache;
      for (std::uint32_t i = 0; i < record.packets.accesses.size(); ++i) {
        StreamAccess& access = record.packets.accesses[i];
        const auto written = static_cast<std::uint8_t>(i <= more ? 15 : 0);
        access = StreamAccess(access.tile_x(), access.tile_y(), access.touched(), written);
      }
      const RetimedFrame not_asked = with_all_lines(record, config);
      record.packets.accesses.back() = StreamAccess(0, 0, std::uint8_t{15}, std::uint8_t{0});
      const RetimedFrame asked = with_all_lines(record, config);
      waited |= more > 60 && clean > 65 && asked.draw_end > not_asked.draw_end;
      REQUIRE(Retimer(record).retime(config) == asked);
    }
  }
  CHECK(waited);
}

TEST_CASE("a frame of more than 2^16 cycles goes through lanes of 16 bits", "[timing]") {
  Retimer retimer(long_triangle(60000, 3, 2));
  const std::vector<Config> machines = latencies(Config{});
  REQUIRE(detail::longest_job(machines.back(), 3) < detail::kNarrowRoom);
  CHECK(retimer.retime(machines[0]).cycles > std::uint64_t{1} << 17);
  check_batch(retimer, machines);
}

TEST_CASE("a gap of more than 2^16 cycles goes through lanes of 16 bits", "[timing]") {
  // dropped triangles, a clear that takes its time, walks without a job after the last burst of a draw, and a
  // draw without bursts at the end
  FrameRecord record = long_triangle(100, 0, 64);
  record.surfaces[0].tiles = 1 << 18;
  PacketStream& packets = record.packets;
  packets.segments[0].dropped_after = 200000;
  packets.segments.push_back({.kind = StreamSegment::Kind::kFastClear, .surface = 0});
  packets.segments.push_back({.surface = 0, .triangles = 100, .dropped_after = 70000});
  packets.triangles.push_back({.dropped_before = 100000, .blocks = 1});
  packets.blocks.emplace_back(0u, 1);
  packets.jobs.push_back(4);
  packets.segments.push_back({.surface = 0, .triangles = 201});
  for (int i = 0; i < 300; ++i) {
    packets.triangles.push_back({.empty_after = 3000});
  }
  Config config;
  config.z_cache.clear_tiles = 1;
  record.config.z_cache.clear_tiles = 1;
  Retimer retimer(std::move(record));
  const RetimedFrame one = retimer.retime(config);
  CHECK(one.cycles > 200000 + (1 << 18) + 170000);
  REQUIRE(one.draw_end.size() == 3);
  CHECK(one.draw_end[2] == one.draw_end[1]);
  check_batch(retimer, latencies(config));
}

TEST_CASE("a flush of more than 2^16 cycles goes through lanes of 16 bits", "[timing]") {
  FrameRecord record = long_triangle(512, 0, 512);
  Config config;
  config.z_cache.lines = 512;
  config.z_cache.ways = 16;
  config.memory.write_bytes = 1;
  record.config.z_cache = config.z_cache;
  Retimer retimer(std::move(record));
  CHECK(retimer.retime(config).cycles > std::uint64_t{1} << 16);
  check_batch(retimer, latencies(config));
}

TEST_CASE("packets that are too far apart for 16 bits are timed in 32", "[timing]") {
  // each burst fits, but the walker is 64 bursts of 2000 cycles before z_test
  Config slow;
  slow.memory.latency = 2000;
  slow.tile_walker.fifo = slow.early_z.pending = slow.quad_generator.fifo = 64;
  slow.z_cache.lines = slow.z_cache.ways = slow.z_cache.misses_in_flight = 1;
  REQUIRE(detail::longest_job(slow, 0) < detail::kNarrowRoom);
  FrameRecord record = long_triangle(2000, 0, 64);
  record.config.z_cache = slow.z_cache;
  Retimer retimer(std::move(record));
  std::vector<Config> machines = latencies(slow);
  CHECK(retimer.retime(machines[0]).cycles > std::uint64_t{2000} * 2000);
  machines.push_back(slow);
  machines.back().memory.latency = 60000;  // a burst alone does not fit
  CHECK(detail::longest_job(machines.back(), 0) > detail::kNarrowRoom);
  check_batch(retimer, machines);
}

TEST_CASE("no burst takes longer than the bound that lanes of 16 bits rely on", "[timing]") {
  Random random(seed());
  for (int run = 0; run < 200; ++run) {
    CAPTURE(seed(), run);
    const Config config = random_sampled_config(random);
    CAPTURE(difference_from_default(config));
    FrameRecord record = random_record(random, config);
    record.packets.segments.clear();
    // one triangle, so that jobs alone take the time, on a pipe that is as long as the bound of a job
    const auto jobs = static_cast<std::uint32_t>(record.packets.jobs.size());
    record.packets.segments.push_back({.surface = 0, .touches_depth = 1, .triangles = 1});
    record.packets.triangles.assign(1, {.blocks = static_cast<std::uint32_t>(record.packets.blocks.size())});
    std::uint32_t most_empty = 0;
    for (const StreamBlock& block : record.packets.blocks) {
      most_empty = std::max(most_empty, block.empty_before());
    }
    record.packets.accesses.clear();
    for (const StreamJob quads : record.packets.jobs) {
      if (quads != 0) {
        record.packets.accesses.emplace_back(static_cast<std::uint32_t>(random.between(0, 15)),
                                             static_cast<std::uint32_t>(random.between(0, 15)),
                                             std::uint8_t{3}, std::uint8_t{3});
      }
    }
    const std::uint64_t bound = detail::longest_job(config, most_empty);
    const auto lines = static_cast<std::uint64_t>(config.z_cache.lines);
    const std::uint64_t flush = lines * (1 + 1024);
    CHECK(Retimer(record).retime(config).cycles <= (jobs + 1) * bound + flush + lines);
  }
}
