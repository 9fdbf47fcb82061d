/// The interpolator's part of RecurrenceCore: docs/units/interpolator.md, *Cycles in the machine*. In the
/// manner of Highway, as core-inl.hpp.
#if defined(HALFSPACE_INTERPOLATION_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HALFSPACE_INTERPOLATION_INL
#undef HALFSPACE_INTERPOLATION_INL
#else
#define HALFSPACE_INTERPOLATION_INL
#endif

#include <hwy/highway.h>

#include <cstdint>

#include "halfspace/timing/contract.hpp"
#include "halfspace/timing/cycle_stats.hpp"
#include "halfspace/timing/recurrence/machine.hpp"

HWY_BEFORE_NAMESPACE();
namespace halfspace::HWY_NAMESPACE {

/// What follows early_z: the sink, or the interpolator and then the sink.
template <class TimePolicy>
class Interpolation {
 public:
  using T = typename TimePolicy::Time;

  /// What follows was free from `free` on, and takes a burst of so many beats in `at`; gives the cycle after
  /// the last beat.
  template <class Stalls, class Probe>
  HWY_INLINE T take(const JobWork& work, const T& beats, const T& free, const T& at,
                    RecurrenceMemory<TimePolicy>& memory, const Stalls& stalls, Probe& probe) {
    if constexpr (TimePolicy::kInterpolates) {
      static_assert(!TimePolicy::Clock::kMoves && Probe::kLooks, "not made for it");
      return shade(work, free, at, memory, stalls, probe);
    } else {
      return at + beats;
    }
  }

  /// The cycle after the last in which any of both took anything, where the first was free from `free` on.
  [[nodiscard]] HWY_INLINE T taken_next(const T& free) const {
    return TimePolicy::kInterpolates ? later(free, next_) : free;
  }

  /// The cycle after the sink took the last quad of the interpolator.
  [[nodiscard]] const T& next() const { return next_; }
  /// Quads with one attribute, so far.
  [[nodiscard]] std::uint64_t packets() const { return packets_; }

 private:
  /// A beat stays until all that it asks for has been begun, a quad with one attribute in a cycle.
  template <class Stalls, class Probe>
  T shade(const JobWork& work, const T& free, T at, RecurrenceMemory<TimePolicy>& memory,
          const Stalls& stalls, Probe& probe) {
    const auto& machine = memory.machine;
    auto& fifo = memory.fifos[static_cast<std::size_t>(Fifo::kInterpolator) - kSetupFifos];
    T begun = at;
    probe.wait(Stage::kInterpolator, stall::kNoInput, free, at);
    for (int first = 0; first < work.quads; first += machine.test_width) {
      std::uint64_t packets = shaded_packets(work.live, first, machine.test_width, machine.attributes);
      at = at + (packets == 0 ? 1 : 0);
      for (; packets != 0; --packets) {
        const T start = later(at, fifo.usable(packets_));
        if (start != at) {
          probe.busy(Stage::kInterpolator, begun, at);
          probe.wait(Stage::kInterpolator, stall::kInterpolatorNoCredit, at, start);
          begun = start;
        }
        at = start + 1;
        const T visible =
            start + (machine.shade_latency + stalls.cycles(StallPoint::kInterpolator, packets_));
        const T taken = later(visible, next_);
        next_ = taken + 1;
        probe.link(Link::kInterpolator, packets_, start, next_);
        probe.note(&PacketTimes::s, taken);
        fifo.give(packets_++, next_);
      }
    }
    probe.busy(Stage::kInterpolator, begun, at);
    return at;
  }

  T next_{};
  std::uint64_t packets_ = 0;
};

}  // namespace halfspace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
