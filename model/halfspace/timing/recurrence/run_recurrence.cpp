#include "halfspace/timing/recurrence/run_recurrence.hpp"

#include "halfspace/timing/pipeline.hpp"
#include "halfspace/timing/recurrence/core.hpp"
#include "halfspace/timing/recurrence/cycle_probe.hpp"

namespace halfspace {
namespace {

/// The clock of a traversal.
template <class Stalls, bool kObserved>
class RecurrenceClock {
 public:
  RecurrenceClock(const Config& config, const Stalls& stalls, const TimedRun& run)
      : config_(config),
        probe_(capacities(config), run.times, run.observer),
        core_(machine(config), make_credits(config), stalls, probe_) {}
  RecurrenceClock(const RecurrenceClock&) = delete;  // the core holds a reference to the probe
  RecurrenceClock& operator=(const RecurrenceClock&) = delete;
  ~RecurrenceClock() = default;

  void start(std::uint32_t memory_lines) { core_.start(memory_lines); }
  void draw(std::uint32_t index) { probe_.draw(index); }
  void dropped() { core_.dropped(); }
  void drawn() { core_.drawn(); }
  void job(const JobWork& work) { core_.job(work); }
  void walked(std::uint32_t steps) { core_.walked(steps); }
  [[nodiscard]] std::uint64_t quad_cycle(int quad) const {
    return core_.sink_start() + static_cast<std::uint64_t>(quad / config_.early_z.quads_per_cycle);
  }
  void fast_clear(std::uint32_t tiles) {
    core_.fast_clear(static_cast<std::uint64_t>(fast_clear_cycles(tiles, config_)));
  }
  void flush(const std::vector<ZFlush>& lines) {
    probe_.drained();
    cycles_ = core_.flush(lines, static_cast<std::uint32_t>(config_.z_cache.lines));
  }

  FrameCycles finish() { return probe_.finish(cycles_); }

 private:
  const Config& config_;
  CycleProbe<kObserved> probe_;
  RecurrenceCore<OneMachine, Stalls, CycleProbe<kObserved>> core_;
  std::uint64_t cycles_ = 0;
};

template <bool kObserved, class Stalls>
FrameResult run_with(const Frame& frame, const Config& config, bool keep_visible, PacketObserver* observer,
                     const Stalls& stalls, TimedRun& run) {
  RecurrenceClock<Stalls, kObserved> clock(config, stalls, run);
  FrameResult result = run_pipeline(frame, config, keep_visible, observer, clock);
  run.cycles = clock.finish();
  return result;
}

}  // namespace

FrameResult run_recurrence(const Frame& frame, const Config& config, bool keep_visible,
                           PacketObserver* observer, TimedRun& run) {
  if (run.observer != nullptr) {
    return run_with<true>(frame, config, keep_visible, observer, run.stalls, run);
  }
  return run.stalls.any() ? run_with<false>(frame, config, keep_visible, observer, run.stalls, run)
                          : run_with<false>(frame, config, keep_visible, observer, NoStalls{}, run);
}

}  // namespace halfspace
