// The statistics of the recurrence against those of a probe that adds up packet by packet.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "all_vectors.hpp"
#include "differences.hpp"
#include "halfspace/machine/stream_writer.hpp"
#include "halfspace/machine/surfaces.hpp"
#include "halfspace/timing/record/z_trace.hpp"
#include "halfspace/timing/recurrence/core.hpp"
#include "halfspace/timing/recurrence/cycle_probe.hpp"
#include "random_machine.hpp"
#include "random_record.hpp"
#include "scalar_probe.hpp"

using namespace halfspace;
using namespace halfspace::testing;

namespace {

/// The parts of a stream through a core whose probe is Probe.
template <class Probe>
class ProbedRun {
 public:
  template <class... More>
  ProbedRun(const Config& config, const StallPlan& stalls, std::uint32_t rows, More... more)
      : probe(capacities(config), more...),
        config_(config),
        memory_(recurrence_memory(config, rows)),
        core_(memory_, stalls, probe) {}

  void read(const StreamView& part, std::uint64_t clear_cycles) {
    Hooks hooks{{}, *this};
    replay(part, core_, hooks, bursts_, [&](std::uint32_t /*surface*/) { return clear_cycles; });
  }

  FrameCycles finish(std::span<const ZFlush> dirty) {
    probe.drained(core_.progress());
    const std::uint64_t cycles = core_.flush(dirty, static_cast<std::uint32_t>(config_.z_cache.lines));
    return probe.finish(cycles, core_.progress());
  }

  Probe probe;

 private:
  struct Hooks : ReplayHooks {
    ProbedRun& run;

    void begin_segment(const StreamSegment& segment) {
      const bool draw = segment.kind == StreamSegment::Kind::kDraw;
      run.probe.draw(draw ? run.draws_++ : kNoDraw, run.core_.progress());
    }
  };

  const Config& config_;
  RecurrenceMemory<OneMachine> memory_;
  RecurrenceCore<OneMachine, StallPlan, Probe> core_;
  std::uint32_t draws_ = 0;
  bool bursts_ = false;
};

/// Adds up what it is told.
class SliceSums final : public CycleObserver {
 public:
  void draw(std::uint32_t /*index*/) override {}
  void drained() override {}
  void link(Link link, std::uint64_t from, std::uint64_t to) override {
    sums.held[static_cast<std::size_t>(link)] += to - from;
    ++sums.packets[static_cast<std::size_t>(link)];
  }
  void slice(Stage stage, std::optional<std::size_t> stall, std::uint64_t from, std::uint64_t to) override {
    const auto i = static_cast<std::size_t>(stage);
    follow &= from == next_[i];
    next_[i] = to;
    (stall ? sums.stage[i].stall[*stall] : sums.stage[i].busy) += to - from;
  }
  void transfer(Channel channel, std::uint64_t from, std::uint64_t to) override {
    (channel == Channel::kRead ? sums.read_busy : sums.write_busy) += to - from;
  }

  CycleStats sums;
  bool follow = true;  ///< slices of a stage follow each other

 private:
  std::array<std::uint64_t, kStages> next_{};
};

/// Every part goes to all.
class ProbedReader final : public StreamReader {
 public:
  ProbedReader(const Config& config, const StallPlan& stalls, std::uint32_t rows, std::uint64_t clear_cycles)
      : scalar_(config, stalls, rows),
        summed_(config, stalls, rows),
        each_(config, stalls, rows, &times_, &slices_),
        clear_cycles_(clear_cycles) {}

  void begin(std::span<const StreamSurface> /*surfaces*/, std::uint32_t /*memory_lines*/) override {}
  void read(const StreamView& part, std::vector<std::uint64_t>* /*burst_cycles*/) override {
    scalar_.read(part, clear_cycles_);
    summed_.read(part, clear_cycles_);
    each_.read(part, clear_cycles_);
  }
  void end(std::span<const ZFlush> dirty) override {
    const FrameCycles expected = scalar_.finish(dirty);
    CHECK(difference(summed_.finish(dirty), expected) == "");
    CHECK(difference(each_.finish(dirty), expected) == "");
    CHECK(difference(times_, scalar_.probe.times) == "");
    CHECK(slices_.follow);
    slices_.sums.occupancy = expected.stats.occupancy;  // which nobody is told
    CHECK(difference("slices: ", slices_.sums, expected.stats) == "");
  }

 private:
  PacketTimes times_;
  SliceSums slices_;
  ProbedRun<ScalarProbe> scalar_;
  ProbedRun<CycleProbe<false>> summed_;
  ProbedRun<CycleProbe<true>> each_;
  std::uint64_t clear_cycles_;
};

/// Gives `stream` to `reader` in parts that end anywhere but in a block, after one packet in `length` or so.
void read_in_parts(const StreamView& stream, StreamReader& reader, Random& random, std::int64_t length) {
  StreamWriter writer(reader);
  const auto cut = [&](bool in_triangle) {
    if (random.between(1, length) == 1) {
      writer.give(in_triangle, nullptr);
    }
  };
  HWY_NAMESPACE::StreamCursor at{.triangle = stream.triangles.data(),
                                 .block = stream.blocks.data(),
                                 .job = stream.jobs.data(),
                                 .miss = stream.misses.data(),
                                 .miss_burst = stream.miss_burst.data(),
                                 .late = stream.late.data(),
                                 .continues_triangle = false};
  for (const StreamSegment& segment : stream.segments) {
    writer.begin_segment(segment.kind, segment.surface, segment.touches_depth != 0);
    std::uint32_t seen = 0;
    for (std::uint32_t i = 0; i < segment.triangles; ++i, ++at.triangle) {
      seen += at.triangle->dropped_before;
      writer.drawn(seen++);
      for (std::uint32_t k = 0; k < at.triangle->blocks; ++k, ++at.block) {
        cut(true);
        writer.block(at.block->empty_before());
        for (int j = 0; j < at.block->jobs(); ++j, ++at.job) {
          writer.job(*at.job);
          if (segment.touches_depth != 0 && *at.job != 0) {
            JobWork work;
            HWY_NAMESPACE::next_access(at, work);
            writer.late(work.late_done, work.late);
            writer.accessed(work.misses);
          }
        }
      }
      cut(true);
      writer.walked(at.triangle->empty_after);
      cut(false);
    }
    writer.end_segment(seen + segment.dropped_after);
    cut(false);
  }
  writer.give(false, nullptr);
}

}  // namespace

TEST_CASE("statistics of random packets are those of a scalar probe", "[timing]") {
  Random random(seed());
  for (int run = 0; run < 150; ++run) {
    const Config config = random_sampled_config(random);
    const StallPlan stalls = random_stalls(random);
    const FrameRecord record = random_record(random, config);
    const ZTrace trace = trace_lines(record, z_cache_shape(config));
    const auto clear_cycles = static_cast<std::uint64_t>(random.between(1, 1000));
    const std::int64_t length = pick(random, {1, 10, 1000, 1 << 30});
    CAPTURE(seed(), run, difference_from_default(config), length);
    with_all_vectors([&] {
      ProbedReader reader(config, stalls, trace.rows, clear_cycles);
      read_in_parts(whole_stream(record, trace), reader, random, length);
      reader.end(trace.flush);
    });
  }
}
