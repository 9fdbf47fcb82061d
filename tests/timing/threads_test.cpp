// The same results with any number of threads: timed runs on both cores, records, batches of machines.
#include <catch2/catch.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "../result_difference.hpp"
#include "halfspace/core/run_core.hpp"
#include "halfspace/scene/synthetic.hpp"
#include "halfspace/timing/record/retime.hpp"
#include "halfspace/timing/recurrence/run_recurrence.hpp"
#include "random_machine.hpp"
#include "record_difference.hpp"

namespace halfspace::testing {
namespace {

/// So many tile jobs that the stream has some tens of parts, or as few as random_frame() makes.
Frame long_or_short_frame(Random& random) {
  if (random.between(0, 1) == 0) {
    return random_frame(random);
  }
  FrameBuilder builder(128, pick(random, {DepthFormat::kUnorm24, DepthFormat::kFloat32}));
  for (auto n = random.between(1, 4); n > 0; --n) {
    builder.clear(1);
    builder.draw(random_triangles(random, 128, static_cast<int>(random.between(1, 200))));
  }
  return builder.frame;
}

/// What a timeline would show, as numbers.
class NotedCycles final : public CycleObserver {
 public:
  std::vector<std::uint64_t> notes;

  void draw(std::uint32_t index) override { note({0, index}); }
  void tile(std::uint32_t x, std::uint32_t y) override { note({1, x, y}); }
  void drained() override { note({2}); }
  void link(Link link, std::uint64_t from, std::uint64_t to) override {
    note({3, static_cast<std::uint64_t>(link), from, to});
  }
  void slice(Stage stage, std::optional<std::size_t> stall, std::uint64_t from, std::uint64_t to) override {
    note({4, static_cast<std::uint64_t>(stage), stall.value_or(99), from, to});
  }
  void transfer(Channel channel, std::uint64_t from, std::uint64_t to) override {
    note({5, static_cast<std::uint64_t>(channel), from, to});
  }

 private:
  void note(std::initializer_list<std::uint64_t> numbers) {
    notes.insert(notes.end(), numbers.begin(), numbers.end());
  }
};

struct ObservedRun {
  TimedResult result;
  Events events;
  NotedCycles cycles;
};

ObservedRun run_observed(const Frame& frame, const Config& config, const EngineOptions& options, int threads,
                         bool events, bool cycles) {
  ObservedRun run;
  EngineOptions own = options;
  own.watch.threads = threads;
  own.watch.observer = events ? &run.events : nullptr;
  own.observer = cycles ? &run.cycles : nullptr;
  run.result = run_recurrence(frame, config, own);
  return run;
}

/// Throws in the thread of the units, when so many draws are done.
class ThrowingObserver final : public PacketObserver {
 public:
  void draw_done(std::size_t done, std::size_t /*of*/) override {
    if (done == 2) {
      throw std::runtime_error("the units");
    }
  }
};

class ThrowingReader final : public StreamReader {
 public:
  int parts = 0;

  [[nodiscard]] bool has_time() const override { return true; }
  void begin(std::span<const StreamSurface> /*surfaces*/, std::uint32_t /*memory_lines*/) override {}
  void read(const StreamView& /*part*/, std::vector<std::uint64_t>* /*burst_cycles*/) override {
    if (++parts == 3) {
      throw std::runtime_error("the reader");
    }
  }
  void end(std::span<const ZFlush> /*dirty*/) override {}
};

/// Four draws, each of more than one part.
Frame four_draws() {
  Random random(seed());
  FrameBuilder builder(256);
  for (int i = 0; i < 4; ++i) {
    builder.draw(random_triangles(random, 256, 100));
  }
  return builder.frame;
}

}  // namespace

TEST_CASE("threads: a timed run gives the same, on both cores", "[timing]") {
  Random random(seed());
  for (int run = 0; run < 60; ++run) {
    CAPTURE(seed(), run);
    const Config config = random_sampled_config(random);
    const Frame frame = long_or_short_frame(random);
    INFO(difference_from_default(config));
    EngineOptions options;
    options.stalls = random.between(0, 1) == 0 ? StallPlan{} : random_stalls(random);
    options.packet_times = true;
    options.watch.keep_visible = random.between(0, 1) == 0;
    options.watch.core = pick(random, {Core::kAuto, Core::kReadable});
    const bool events = random.between(0, 3) == 0;
    const bool cycles = random.between(0, 3) == 0;
    const ObservedRun one = run_observed(frame, config, options, 1, events, cycles);
    for (const int threads : {2, 3}) {
      CAPTURE(threads);
      const ObservedRun more = run_observed(frame, config, options, threads, events, cycles);
      REQUIRE(more.result.frame.core == one.result.frame.core);
      REQUIRE(result_difference(more.result.frame, one.result.frame) == "");
      REQUIRE(difference(more.result.times, one.result.times) == "");
      REQUIRE(difference(more.result.cycles, one.result.cycles) == "");
      REQUIRE(difference(more.events, one.events) == "");
      REQUIRE(more.cycles.notes == one.cycles.notes);
    }
  }
}

TEST_CASE("threads: a frame of many parts is timed the same", "[timing][exhaustive]") {
  const Frame frame = synthetic_frame("medium");
  for (const Core core : {Core::kFast, Core::kReadable}) {
    EngineOptions options;
    options.watch.core = core;
    const TimedResult one = run_recurrence(frame, Config{}, options);
    options.watch.threads = 2;
    const TimedResult two = run_recurrence(frame, Config{}, options);
    CHECK(result_difference(two.frame, one.frame) == "");
    CHECK(difference(two.cycles, one.cycles) == "");
  }
}

TEST_CASE("threads: a record is the same, from both cores", "[timing]") {
  Random random(seed());
  for (int run = 0; run < 30; ++run) {
    CAPTURE(seed(), run);
    const Config config = random_sampled_config(random);
    const Frame frame = long_or_short_frame(random);
    for (const Core core : {Core::kAuto, Core::kReadable}) {
      const FrameRecord one = record_frame(frame, config, {.core = core});
      REQUIRE(record_difference(record_frame(frame, config, {.core = core, .threads = 2}), one) == "");
      REQUIRE(record_difference(record_frame(frame, config, {.core = core, .threads = 3}), one) == "");
    }
  }
}

TEST_CASE("threads: a batch of machines is timed the same, exactly and by a sample", "[timing][exhaustive]") {
  Random random(seed());
  for (int run = 0; run < 12; ++run) {
    CAPTURE(seed(), run);
    const Config recorded = random_sampled_config(random);
    const FrameRecord record =
        record_frame(run % 3 == 0 ? synthetic_frame("medium") : long_or_short_frame(random), recorded);
    const auto count = static_cast<std::size_t>(random.between(1, 150));
    const std::vector<Config> machines = random_machines(random, recorded, count);
    Retimer one(record);
    const std::vector<RetimedFrame> exact = one.retime(machines);
    const std::vector<std::uint64_t> estimated = one.estimate(machines);
    for (const int threads : {2, 3}) {
      CAPTURE(threads);
      Retimer more(record, threads);
      REQUIRE(more.retime(machines) == exact);
      REQUIRE(more.estimate(machines) == estimated);
      REQUIRE(Retimer(record, threads).estimate(machines) == estimated);
    }
  }
}

TEST_CASE("threads: what the units or the reader throw reaches the caller", "[timing]") {
  const Frame frame = four_draws();
  for (const Core core : {Core::kFast, Core::kReadable}) {
    for (const int threads : {1, 2, 3}) {
      for (int run = 0; run < 20; ++run) {
        CAPTURE(static_cast<int>(core), threads, run);
        ThrowingObserver observer;
        EngineOptions options;
        options.watch = {.observer = &observer, .core = core, .threads = threads};
        REQUIRE_THROWS_WITH(run_recurrence(frame, Config{}, options), "the units");
        ThrowingReader reader;
        REQUIRE_THROWS_WITH(run_core(frame, Config{}, {.core = core, .threads = threads}, &reader),
                            "the reader");
        REQUIRE(reader.parts == 3);
      }
    }
  }
}

}  // namespace halfspace::testing
