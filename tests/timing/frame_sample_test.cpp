// A sample of a record: its stretches, its weights, and how near its cycles are.
#include <catch2/catch.hpp>
#include <cmath>

#include "halfspace/scene/synthetic.hpp"
#include "halfspace/timing/record/calibrate.hpp"
#include "halfspace/timing/record/retime.hpp"
#include "random_machine.hpp"

using namespace halfspace;
using namespace halfspace::testing;

namespace {

double sum_of(const std::vector<Stretch>& stretches, StretchCount which) {
  double sum = 0;
  for (Stretch stretch : stretches) {
    sum += count(stretch.counts, which);
  }
  return sum;
}

std::uint64_t dropped(const PacketStream& packets) {
  std::uint64_t sum = 0;
  for (const StreamSegment& segment : packets.segments) {
    sum += segment.dropped_after;
  }
  for (const StreamTriangle& triangle : packets.triangles) {
    sum += triangle.dropped_before;
  }
  return sum;
}

std::uint64_t blocks(const PacketStream& packets) {
  std::uint64_t sum = 0;
  for (const StreamTriangle& triangle : packets.triangles) {
    sum += triangle.empty_after;
  }
  for (const StreamBlock& block : packets.blocks) {
    sum += block.empty_before() + 1;
  }
  return sum;
}

template <class Packet>
std::vector<std::uint32_t> words(const std::vector<Packet>& packets) {
  std::vector<std::uint32_t> words;
  for (const Packet& packet : packets) {
    words.push_back(packet.word());
  }
  return words;
}

/// Draws without depth: `draws` of `triangles`, each of 4 blocks of 2 jobs of 16 quads, with a fast clear
/// before draw `cleared`.
FrameRecord even_record(std::uint32_t draws, std::uint32_t triangles, std::uint32_t cleared = 0xFFFFFFFF) {
  FrameRecord record;
  record.surfaces.push_back({.tiles_x = 64, .tiles = 4096, .sample_bytes = 4});
  for (std::uint32_t i = 0; i < draws; ++i) {
    if (i == cleared) {
      record.packets.segments.push_back({.kind = StreamSegment::Kind::kFastClear, .surface = 0});
    }
    record.packets.segments.push_back({.triangles = triangles});
  }
  record.packets.triangles.assign(std::size_t{draws} * triangles, {.blocks = 4});
  record.packets.blocks.assign(record.packets.triangles.size() * 4, StreamBlock(0, 2));
  record.packets.jobs.assign(record.packets.triangles.size() * 8, 16);
  return record;
}

double percent_off(std::uint64_t estimate, std::uint64_t cycles) {
  return 100 * (static_cast<double>(estimate) / static_cast<double>(cycles) - 1);
}

}  // namespace

TEST_CASE("stretches of a record lie one behind the other, and have its counts", "[timing]") {
  Random random(seed());
  for (int run = 0; run < 40; ++run) {
    CAPTURE(seed(), run);
    const FrameRecord record = record_frame(random_frame(random), random_sampled_config(random));
    const PacketStream& packets = record.packets;
    const auto work = static_cast<std::uint64_t>(random.between(1, 60));
    const std::vector<Stretch> stretches = cut(record, work);
    CHECK(stretches[0].first_job == 0);
    CHECK(stretches[0].first_access == 0);
    for (std::size_t i = 1; i < stretches.size(); ++i) {
      REQUIRE(stretches[i].first_job > stretches[i - 1].first_job);
      REQUIRE(stretches[i].first_access >= stretches[i - 1].first_access);
      REQUIRE(stretches[i - 1].work >= work);
      REQUIRE(packets.jobs[stretches[i].first_job - 1] != 0);
    }
    CHECK(sum_of(stretches, StretchCount::kStretches) == static_cast<double>(stretches.size()));
    CHECK(sum_of(stretches, StretchCount::kJobs) == static_cast<double>(packets.jobs.size()));
    CHECK(sum_of(stretches, StretchCount::kBlocks) == static_cast<double>(blocks(packets)));
    CHECK(sum_of(stretches, StretchCount::kDrawn) == static_cast<double>(packets.triangles.size()));
    CHECK(sum_of(stretches, StretchCount::kDropped) == static_cast<double>(dropped(packets)));
  }
}

TEST_CASE("copies of all stretches are the record, in more draws", "[timing]") {
  Random random(seed());
  for (int run = 0; run < 40; ++run) {
    CAPTURE(seed(), run);
    const FrameRecord record = record_frame(random_frame(random), random_sampled_config(random));
    const std::vector<Stretch> stretches = cut(record, static_cast<std::uint64_t>(random.between(1, 60)));
    const StretchCopy copied = copy(record, stretches, std::vector<bool>(stretches.size(), true));
    CHECK(words(copied.packets.blocks) == words(record.packets.blocks));
    CHECK(copied.packets.jobs == record.packets.jobs);
    CHECK(std::ranges::equal(copied.packets.accesses, record.packets.accesses, {}, &StreamAccess::words,
                             &StreamAccess::words));
    CHECK(dropped(copied.packets) == dropped(record.packets));
    CHECK(blocks(copied.packets) == blocks(record.packets));
  }
}

TEST_CASE("the copy of a stretch has its counts", "[timing]") {
  Random random(seed());
  for (int run = 0; run < 20; ++run) {
    CAPTURE(seed(), run);
    const FrameRecord record = record_frame(random_frame(random), random_sampled_config(random));
    const std::vector<Stretch> stretches = cut(record, static_cast<std::uint64_t>(random.between(1, 60)));
    for (std::size_t i = 0; i < stretches.size(); ++i) {
      std::vector<bool> wanted(stretches.size());
      wanted[i] = true;
      const PacketStream packets = copy(record, stretches, wanted).packets;
      StretchCounts counts = stretches[i].counts;
      CHECK(count(counts, StretchCount::kJobs) == static_cast<double>(packets.jobs.size()));
      CHECK(count(counts, StretchCount::kBlocks) == static_cast<double>(blocks(packets)));
      CHECK(count(counts, StretchCount::kDropped) == static_cast<double>(dropped(packets)));
      // a triangle that began in the stretch before is drawn again
      CHECK(static_cast<double>(packets.triangles.size()) - count(counts, StretchCount::kDrawn) <= 1);
    }
  }
}

TEST_CASE("calibrated weights give the totals", "[timing]") {
  Random random(seed());
  StretchCounts totals{};
  std::vector<StretchCounts> counts;
  const std::vector<double> weights(60, 10.0);
  for (std::size_t s = 0; s < weights.size(); ++s) {
    StretchCounts stretch{};
    for (std::size_t i = 0; i + 1 < kStretchCounts; ++i) {  // of the last there is nothing
      stretch[i] = static_cast<double>(random.between(10, 20));
      totals[i] += 10 * stretch[i] * (i % 2 == 0 ? 1.02 : 0.98);
    }
    counts.push_back(stretch);
  }
  const std::vector<double> calibrated = calibrate(weights, counts, totals);
  for (std::size_t i = 0; i < kStretchCounts; ++i) {
    double sum = 0;
    for (std::size_t s = 0; s < weights.size(); ++s) {
      sum += calibrated[s] * counts[s][i];
    }
    CHECK(sum == Approx(totals[i]).epsilon(0.005));
  }
  SECTION("and stay what they are where they do already") {
    StretchCounts now{};
    for (const StretchCounts& stretch : counts) {
      for (std::size_t i = 0; i < kStretchCounts; ++i) {
        now[i] += 10 * stretch[i];
      }
    }
    for (const double weight : calibrate(weights, counts, now)) {
      CHECK(weight == Approx(10));
    }
  }
  SECTION("and where there is nothing to count") {
    CHECK(calibrate(weights, std::vector<StretchCounts>(weights.size()), {}) == weights);
  }
}

TEST_CASE("a short record is timed whole", "[timing]") {
  Random random(seed());
  for (int run = 0; run < 10; ++run) {
    CAPTURE(seed(), run);
    const Config recorded = random_sampled_config(random);
    Retimer retimer(record_frame(random_frame(random), recorded));
    std::vector<Config> machines;
    for (int i = 0; i < 5; ++i) {
      machines.push_back(random_timing(random, recorded));
    }
    const std::vector<std::uint64_t> estimates = retimer.estimate(machines);
    for (std::size_t i = 0; i < machines.size(); ++i) {
      CHECK(estimates[i] == retimer.retime(machines[i]).cycles);
    }
  }
}

TEST_CASE("the estimate of an even frame is right", "[timing]") {
  // 4 beats a job, behind a step that is shorter
  const FrameRecord record = even_record(10, 2000);
  REQUIRE(FrameSample(record).pays());
  Retimer retimer(record);
  const std::uint64_t exact = retimer.retime(Config{}).cycles;
  CHECK(exact >= 640'000);
  CHECK(std::abs(percent_off(retimer.estimate(Config{}), exact)) < 0.1);
}

TEST_CASE("the estimate has the time of clears", "[timing]") {
  Config config;
  config.z_cache.clear_tiles = 1;  // 4096 cycles a clear
  for (const std::uint32_t before : {0u, 5u}) {
    Retimer with(even_record(10, 2000, before));
    Retimer without(even_record(10, 2000));
    const std::uint64_t clear = with.estimate(config) - without.estimate(config);
    CHECK(clear >= 4096);
    CHECK(clear < 4096 + 200);  // and until the machine is empty, and full again
  }
}

TEST_CASE("a sample waits for no line that left the z cache outside of it", "[timing]") {
  FrameRecord record = even_record(10, 2000);
  for (StreamSegment& segment : record.packets.segments) {
    segment.touches_depth = 1;
  }
  const std::size_t jobs = record.packets.jobs.size();
  record.packets.accesses.assign(jobs, StreamAccess(0, 0, 1, 0));
  ZTrace trace;  // each burst waits for what the one before it replaced
  trace.rows = 2;
  trace.z.misses.assign(jobs, {.line = 1, .victim = 1, .bytes = 64, .fetch = true});
  for (std::uint32_t i = 0; i < jobs; ++i) {
    trace.z.burst.push_back(i);
  }
  trace.z.burst.push_back(kNoBurst);
  for (std::uint32_t i = 0; i < jobs; ++i) {  // and for its late write, and leaves one
    trace.z.late.push_back({.access = i, .done = i, .leaves = true});
  }
  trace.z.late.push_back({.access = kNoBurst});

  const FrameSample sample(record, {.stretches = 96});
  const ZTrace sampled = sample.trace(trace).trace;
  REQUIRE(sampled.z.misses.size() == sample.packets().packets.jobs.size());
  std::size_t without_wait = 0;
  for (std::size_t i = 0; i < sampled.z.misses.size(); ++i) {
    CHECK(sampled.z.burst[i] == i);
    CHECK(sampled.z.late[i].access == i);
    CHECK(sampled.z.late[i].done == i);  // of the sample's
    CHECK(sampled.z.misses[i].victim == 1);
    without_wait += sampled.z.misses[i].line == 0 ? 1 : 0;
  }
  CHECK(without_wait == 96);  // the first of each stretch with its warm-up
}

TEST_CASE("a run of dropped triangles counts once, however long it is", "[timing]") {
  FrameRecord record = even_record(10, 2000);
  record.packets.triangles[11111].dropped_before = 50'000;
  Retimer retimer(record);
  CHECK(std::abs(percent_off(retimer.estimate(Config{}), retimer.retime(Config{}).cycles)) < 0.5);
}

TEST_CASE("estimates are near, on machines of all kinds, one by one and in a batch", "[timing]") {
  Random random(seed());
  for (const char* name : {"large_ftb", "fill_btf"}) {
    CAPTURE(seed(), name);
    Retimer retimer(record_frame(synthetic_frame(name), Config{}));
    REQUIRE(FrameSample(retimer.record()).pays());
    std::vector<Config> machines{Config{}};
    for (const int lines : {128, 16}) {
      for (const int latency : {20, 100, 400}) {
        for (const int pending : {8, 32}) {
          Config machine;
          machine.z_cache.lines = lines;
          machine.memory.latency = latency;
          machine.early_z.pending = pending;
          machine.tile_walker.fifo = pick(random, {4, 16, 64});
          machine.quad_generator.fifo = pick(random, {2, 4, 16});
          machine.memory.read_bytes = pick(random, {16, 64});
          machine.memory.write_bytes = pick(random, {16, 64});
          machines.push_back(machine);
        }
      }
    }
    const std::vector<std::uint64_t> estimates = retimer.estimate(machines);
    double sum = 0;
    for (std::size_t i = 0; i < machines.size(); ++i) {
      CAPTURE(difference_from_default(machines[i]));
      const double error = percent_off(estimates[i], retimer.retime(machines[i]).cycles);
      CHECK(std::abs(error) < 15);
      sum += std::abs(error);
      CHECK(retimer.estimate(machines[i]) == estimates[i]);
    }
    CHECK(sum / static_cast<double>(machines.size()) < 5);
  }
}
