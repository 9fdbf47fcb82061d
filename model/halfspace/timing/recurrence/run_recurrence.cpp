#include "halfspace/timing/recurrence/run_recurrence.hpp"

#include <vector>

#include "halfspace/core/run_core.hpp"
#include "halfspace/timing/recurrence/core.hpp"
#include "halfspace/timing/recurrence/cycle_probe.hpp"

namespace halfspace {
namespace {

/// Times the stream of a frame while the units run.
template <class TimePolicy, class Stalls, bool kEach>
class RecurrenceReader final : public StreamReader {
 public:
  RecurrenceReader(const Config& config, const Stalls& stalls, CycleObserver* observer, PacketTimes* times)
      : config_(config),
        observed_(observer != nullptr),
        probe_(capacities(config), times, observer),
        memory_(recurrence_memory<TimePolicy>(config, 0)),
        core_(memory_, stalls, probe_) {}

  [[nodiscard]] bool wants_tiles() const override { return observed_; }
  [[nodiscard]] bool wants_live() const override { return TimePolicy::kInterpolates; }
  [[nodiscard]] bool has_time() const override { return true; }

  void begin(std::span<const StreamSurface> surfaces, std::uint32_t memory_lines) override {
    for (const StreamSurface& surface : surfaces) {
      clear_cycles_.push_back(static_cast<std::uint64_t>(fast_clear_cycles(surface.tiles, config_)));
    }
    memory_.out = TimeTable(memory_lines);
  }

  void read(const StreamView& part, std::vector<std::uint64_t>* burst_cycles) override {
    Hooks hooks{{}, *this, part, burst_cycles};
    replay(part, core_, hooks, bursts_, [this](std::uint32_t surface) { return clear_cycles_[surface]; });
  }

  void end(std::span<const ZFlush> dirty) override {
    probe_.drained(core_.progress());
    cycles_ = core_.flush(dirty, static_cast<std::uint32_t>(config_.z_cache.lines));
  }

  FrameCycles finish() { return probe_.finish(cycles_, core_.progress()); }

 private:
  struct Hooks : ReplayHooks {
    RecurrenceReader& reader;
    const StreamView& part;
    std::vector<std::uint64_t>* burst_cycles;

    void begin_segment(const StreamSegment& segment) {
      reader.in_draw_ = segment.kind == StreamSegment::Kind::kDraw;
      reader.probe_.draw(reader.in_draw_ ? reader.draws_++ : kNoDraw, reader.core_.progress());
    }
    void job(std::size_t index) {
      if constexpr (kEach) {
        if (reader.observed_ && reader.in_draw_) {
          reader.probe_.tile(part.tiles[index]);
        }
      }
    }
    template <class Core>
    void burst(const Core& core) {
      if (burst_cycles != nullptr) {
        burst_cycles->push_back(core.sink_start());
      }
    }
  };

  const Config& config_;
  bool observed_;
  CycleProbe<kEach> probe_;
  RecurrenceMemory<TimePolicy> memory_;
  RecurrenceCore<TimePolicy, Stalls, CycleProbe<kEach>> core_;
  std::vector<std::uint64_t> clear_cycles_;  ///< by surface
  std::uint32_t draws_ = 0;
  bool in_draw_ = false;
  bool bursts_ = false;
  std::uint64_t cycles_ = 0;
};

template <class TimePolicy, bool kEach, class Stalls>
TimedResult run_with(const Frame& frame, const Config& config, const EngineOptions& options,
                     const Stalls& stalls) {
  TimedResult result;
  RecurrenceReader<TimePolicy, Stalls, kEach> reader(config, stalls, options.observer,
                                                     options.packet_times ? &result.times : nullptr);
  result.frame = run_core(frame, config, options.watch, &reader);
  result.cycles = reader.finish();
  return result;
}

}  // namespace

TimedResult run_recurrence(const Frame& frame, const Config& config, const EngineOptions& options) {
  if (config.interpolator.enabled) {
    return run_with<InterpolatingMachine, true>(frame, config, options, options.stalls);
  }
  if (options.observer != nullptr || options.packet_times) {
    return run_with<OneMachine, true>(frame, config, options, options.stalls);
  }
  return options.stalls.any() ? run_with<OneMachine, false>(frame, config, options, options.stalls)
                              : run_with<OneMachine, false>(frame, config, options, NoStalls{});
}

}  // namespace halfspace
