#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "halfspace/timing/record/retime_lanes.cpp"
#include <hwy/foreach_target.h>
// after foreach_target, as Highway asks
#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "halfspace/timing/record/lanes-inl.hpp"
#include "halfspace/timing/record/retime.hpp"
#include "halfspace/timing/recurrence/replay-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace halfspace::HWY_NAMESPACE {
namespace {

/// The machines of a core, a lane each.
template <class Policy>
class LaneMachines {
 public:
  using Memory = RecurrenceMemory<Policy>;
  static constexpr std::size_t kMachines = Policy::Time::kMachines;
  using Numbers = MachineNumbers<kMachines>;

  explicit LaneMachines(std::span<const Config> configs) : configs_(configs) {}

  /// get(config) of each machine; lanes beyond repeat the first.
  template <class Get>
  [[nodiscard]] Numbers of_each(const Get& get) const {
    Numbers values{};
    for (std::size_t i = 0; i < kMachines; ++i) {
      values[i] = static_cast<std::uint32_t>(get(configs_[i < configs_.size() ? i : 0]));
    }
    return values;
  }

  /// For packets that ask for `rows` of the table of times.
  void set_up(Memory& memory, std::uint32_t rows) const {
    for (std::size_t i = 0; i < kFifos; ++i) {
      const Numbers capacity = of_each([i](const Config& config) { return capacities(config)[i]; });
      if (i < kSetupFifos) {
        memory.setup_fifos[i].set_up(capacity);
      } else {
        memory.fifos[i - kSetupFifos].set_up(capacity);
      }
    }
    memory.out = typename Policy::Table(rows);
    memory.late = typename Policy::Table(kLateRing);
    if (configs_[0].hi_z.enabled) {  // all have the same packets
      memory.hi_z_lag = static_cast<std::uint64_t>(configs_[0].hi_z.lag);
      memory.retired = typename Policy::Table(kHiZRing);
    }
    std::vector<Machine<std::uint64_t>> machines;
    for (std::size_t i = 0; i < kMachines; ++i) {
      machines.push_back(machine(configs_[i < configs_.size() ? i : 0]));
    }
    const auto fill = [&machines](auto& lanes, const auto& get) {
      Numbers values{};
      std::transform(machines.begin(), machines.end(), values.begin(),
                     [&](const auto& m) { return static_cast<std::uint32_t>(get(m)); });
      lanes = std::remove_reference_t<decltype(lanes)>::of(values);
    };
    auto& all = memory.machine;
    for (std::size_t i = 0; i <= kMostQuads; ++i) {
      fill(all.quad_beats[i], [i](const auto& m) { return m.quad_beats[i]; });
      fill(all.test_beats[i], [i](const auto& m) { return m.test_beats[i]; });
    }
    for (std::size_t i = 0; i <= kMostLineBytesLog2; ++i) {
      fill(all.read_cycles[i], [i](const auto& m) { return m.read_cycles[i]; });
      fill(all.write_cycles[i], [i](const auto& m) { return m.write_cycles[i]; });
    }
    fill(all.setup_interval, [](const auto& m) { return m.setup_interval; });
    fill(all.setup_latency, [](const auto& m) { return m.setup_latency; });
    fill(all.edge_latency, [](const auto& m) { return m.edge_latency; });
    fill(all.lookup_latency, [](const auto& m) { return m.lookup_latency; });
    fill(all.late_latency, [](const auto& m) { return m.late_latency; });
    fill(all.memory_latency, [](const auto& m) { return m.memory_latency; });
    fill(all.decode_latency, [](const auto& m) { return m.decode_latency; });
    fill(all.encode_latency, [](const auto& m) { return m.encode_latency; });
  }

 private:
  std::span<const Config> configs_;
};

/// kCount cores, through which every packet goes. They are members of their own, not an array, and calls are
/// written out, so that all is inlined and the compiler keeps their times in registers.
template <class Policy, std::size_t kCount>
class Cores {
 public:
  HWY_INLINE Cores(RecurrenceMemory<Policy>* memory, NoProbe& probe)
      : first_(memory[0], NoStalls{}, probe), rest_(memory + 1, probe) {}

  HWY_INLINE void dropped() {
    first_.dropped();
    rest_.dropped();
  }
  HWY_INLINE void drawn() {
    first_.drawn();
    rest_.drawn();
  }
  HWY_INLINE void job(const JobWork& work) {
    first_.job(work);
    rest_.job(work);
  }
  HWY_INLINE void block(std::uint32_t empty_before, int jobs) {
    first_.block(empty_before, jobs);
    rest_.block(empty_before, jobs);
  }
  HWY_INLINE void block_done() {
    first_.block_done();
    rest_.block_done();
  }
  HWY_INLINE void walked(std::uint32_t empty_after) {
    first_.walked(empty_after);
    rest_.walked(empty_after);
  }
  HWY_INLINE void keep_near() {
    first_.keep_near();
    rest_.keep_near();
  }
  /// act(core, its number), for what is rare.
  template <class Act>
  void each(const Act& act, std::size_t number = 0) {
    act(first_, number);
    rest_.each(act, number + 1);
  }

 private:
  RecurrenceCore<Policy, NoStalls, NoProbe> first_;
  Cores<Policy, kCount - 1> rest_;
};

template <class Policy>
class Cores<Policy, 0> {
 public:
  HWY_INLINE Cores(RecurrenceMemory<Policy>* /*memory*/, NoProbe& /*probe*/) {}
  HWY_INLINE void dropped() {}
  HWY_INLINE void drawn() {}
  HWY_INLINE void job(const JobWork& /*work*/) {}
  HWY_INLINE void block(std::uint32_t /*empty_before*/, int /*jobs*/) {}
  HWY_INLINE void block_done() {}
  HWY_INLINE void walked(std::uint32_t /*empty_after*/) {}
  HWY_INLINE void keep_near() {}
  template <class Act>
  void each(const Act& /*act*/, std::size_t /*number*/) {}
};

/// The machines of a pass. Every packet goes through all cores: the stream is read once, and one core works
/// while another waits for its numbers.
template <class Policy, std::size_t kCount>
class Pass {
 public:
  static constexpr bool kInterpolates = Policy::kInterpolates;
  using Core = RecurrenceCore<Policy, NoStalls, NoProbe>;
  using Machines = LaneMachines<Policy>;

  /// Times are looked after every `jobs` jobs.
  HWY_INLINE Pass(const Machines* machines, RecurrenceMemory<Policy>* memory, std::uint32_t jobs,
                  std::span<RetimedFrame> results, NoProbe& probe)
      : machines_(machines), results_(results), jobs_(jobs), jobs_left_(jobs), cores_(memory, probe) {}

  HWY_INLINE void dropped() { cores_.dropped(); }
  HWY_INLINE void drawn() { cores_.drawn(); }
  HWY_INLINE void job(const JobWork& work) {
    cores_.job(work);
    if constexpr (Policy::Clock::kMoves) {
      if (HWY_UNLIKELY(--jobs_left_ == 0)) {
        jobs_left_ = jobs_;
        cores_.keep_near();
      }
    }
  }
  HWY_INLINE void block(std::uint32_t empty_before, int jobs) { cores_.block(empty_before, jobs); }
  HWY_INLINE void block_done() { cores_.block_done(); }
  HWY_INLINE void walked(std::uint32_t empty_after) { cores_.walked(empty_after); }
  void fast_clear(std::uint32_t tiles) {
    cores_.each([this, tiles](Core& core, std::size_t number) HWY_ATTR {
      core.fast_clear(Policy::SetupTime::of(machines_[number].of_each(
          [tiles](const Config& config) { return fast_clear_cycles(tiles, config); })));
    });
  }
  /// The end of the frame, where each z cache has `lines`. False where the width was too small.
  bool flush(std::span<const ZFlush> dirty, std::uint32_t lines) {
    bool good = true;
    cores_.each([&](Core& core, std::size_t number) HWY_ATTR {
      const auto cycles = core.flush(dirty, lines).numbers();
      good = good && !core.lost();
      const std::span<RetimedFrame> here = results_of(number);
      for (std::size_t i = 0; i < here.size(); ++i) {
        here[i].cycles = cycles[i];
      }
    });
    return good;
  }
  /// Notes the end of a draw; `bursts`: it had some.
  void draw_end(bool bursts) {
    cores_.each([&](Core& core, std::size_t number) HWY_ATTR {
      const auto next = core.sink_next().numbers();
      const std::span<RetimedFrame> here = results_of(number);
      for (std::size_t i = 0; i < here.size(); ++i) {
        std::vector<std::uint64_t>& ends = here[i].draw_end;
        const std::uint64_t before = ends.empty() ? 0 : ends.back();
        ends.push_back(bursts ? next[i] - 1 : before);
      }
    });
  }

 private:
  [[nodiscard]] std::span<RetimedFrame> results_of(std::size_t core) const {
    const std::size_t first = core * Machines::kMachines;
    return results_.subspan(first, std::min(Machines::kMachines, results_.size() - first));
  }

  const Machines* machines_;
  std::span<RetimedFrame> results_;
  std::uint32_t jobs_;
  std::uint32_t jobs_left_;
  Cores<Policy, kCount> cores_;
};

template <class PassType>
struct DrawEnds : ReplayHooks {
  PassType& pass;

  void end_segment(const StreamSegment& segment, bool bursts) {
    if (segment.kind == StreamSegment::Kind::kDraw) {
      pass.draw_end(bursts);
    }
  }
};

/// False where the width was too small; then `results` are wrong.
template <class Policy, std::size_t kCount>
bool retime_pass(const FrameRecord& record, const ZTrace& trace, std::span<const Config> configs,
                 std::uint32_t jobs, std::span<RetimedFrame> results) {
  using Machines = LaneMachines<Policy>;
  std::vector<Machines> machines;
  const auto memory = hwy::MakeUniqueAlignedArray<RecurrenceMemory<Policy>>(kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    const std::size_t first = i * Machines::kMachines;
    machines.emplace_back(configs.subspan(first, std::min(Machines::kMachines, configs.size() - first)));
    machines[i].set_up(memory[i], trace.rows);
  }
  NoProbe probe;
  Pass<Policy, kCount> pass(machines.data(), memory.get(), jobs, results, probe);
  DrawEnds<Pass<Policy, kCount>> hooks{{}, pass};
  bool bursts = false;
  replay(whole_stream(record, trace), pass, hooks, bursts,
         [&](std::uint32_t surface) { return record.surfaces[surface].tiles; });
  // all share the shape of the z cache, so the number of its lines too
  return pass.flush(trace.flush, static_cast<std::uint32_t>(configs[0].z_cache.lines));
}

/// As many of the machines as go into a pass; gives their number, 0 where the width was too small for them.
template <class Policy>
std::size_t retime_some(const FrameRecord& record, const ZTrace& trace, std::span<const Config> configs,
                        std::uint32_t jobs, RetimedFrame* results) {
  constexpr std::size_t kMachines = Policy::Time::kMachines;
  const std::size_t count = std::min(configs.size(), 2 * kMachines);
  for (std::size_t i = 0; i < count; ++i) {
    results[i].draw_end.clear();
    results[i].draw_end.reserve(record.packets.segments.size());
  }
  const auto pass = count > kMachines ? retime_pass<Policy, 2> : retime_pass<Policy, 1>;
  return pass(record, trace, configs.first(count), jobs, {results, count}) ? count : 0;
}

#if HWY_TARGET != HWY_SCALAR
/// In lanes of 16 bits as retime_some. 0 too where the machines are so slow that a job may not fit.
std::size_t retime_narrow(const FrameRecord& record, const ZTrace& trace, std::span<const Config> configs,
                          std::uint32_t most_empty, RetimedFrame* results) {
  std::uint64_t growth = 1;
  for (const Config& config : configs.first(std::min(configs.size(), 2 * NarrowLanes::Time::kMachines))) {
    growth = std::max(growth, detail::longest_job(config, most_empty));
  }
  // times are near at first and may grow as far again until they are looked after
  const auto jobs = static_cast<std::uint32_t>(detail::kNarrowRoom / growth);
  return jobs == 0 ? 0 : retime_some<NarrowLanes>(record, trace, configs, jobs, results);
}
#endif

}  // namespace

std::size_t pass_machines() {
#if HWY_TARGET != HWY_SCALAR
  return 2 * NarrowLanes::Time::kMachines;
#else
  return 2 * WideLanes::Time::kMachines;
#endif
}

void retime_group(const FrameRecord& record, const ZTrace& trace, std::span<const Config> configs,
                  [[maybe_unused]] std::uint32_t most_empty, RetimedFrame* results) {
  while (!configs.empty()) {
    std::size_t done = 0;
#if HWY_TARGET != HWY_SCALAR
    done = retime_narrow(record, trace, configs, most_empty, results);
#endif
    if (done == 0) {
      done = retime_some<WideLanes>(record, trace, configs, 0, results);
    }
    configs = configs.subspan(done);
    results += done;
  }
}

}  // namespace halfspace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace halfspace::detail {

HWY_EXPORT(pass_machines);
HWY_EXPORT(retime_group);

std::size_t pass_machines() { return HWY_DYNAMIC_DISPATCH(pass_machines)(); }

void retime_lanes(const FrameRecord& record, const ZTrace& trace, std::span<const Config> configs,
                  std::uint32_t most_empty, RetimedFrame* results) {
  HWY_DYNAMIC_DISPATCH(retime_group)(record, trace, configs, most_empty, results);
}

}  // namespace halfspace::detail
#endif
