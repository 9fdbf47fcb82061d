/// Cycles on SystemC's clock. There is no clock signal: a cycle is 1 ns of simulated time, and a process runs
/// only in the cycles in which it does something.
#pragma once

#include <cstdint>
#include <systemc>

namespace halfspace::systemc {

/// Counted from the first cycle of the frame.
using Cycle = std::uint64_t;

class SimClock {
 public:
  SimClock() : ticks_(sc_core::sc_time(1, sc_core::SC_NS).value()) {}

  /// This cycle becomes cycle 0.
  void restart() { origin_ = sc_core::sc_time_stamp().value(); }

  [[nodiscard]] Cycle now() const { return (sc_core::sc_time_stamp().value() - origin_) / ticks_; }

  /// The cycle that is `delay` from now.
  [[nodiscard]] Cycle after(const sc_core::sc_time& delay) const { return now() + delay.value() / ticks_; }

  /// Zero where the cycle has come already.
  [[nodiscard]] sc_core::sc_time time_until(Cycle cycle) const {
    const std::uint64_t at = origin_ + cycle * ticks_;
    const std::uint64_t now = sc_core::sc_time_stamp().value();
    return sc_core::sc_time::from_value(at > now ? at - now : 0);
  }

  /// Suspends the calling thread until `cycle`, if that is still to come.
  void wait_until(Cycle cycle) {
    const sc_core::sc_time left = time_until(cycle);
    if (left.value() != 0) {
      sc_core::wait(left);
      ++activations_;
    }
  }

  /// Suspends the calling thread until the event.
  void wait_for(const sc_core::sc_event& event) {
    sc_core::wait(event);
    ++activations_;
  }

  /// How often a thread that waited here was run.
  [[nodiscard]] std::uint64_t activations() const { return activations_; }

 private:
  std::uint64_t ticks_;  ///< of the kernel's resolution in a cycle
  std::uint64_t origin_ = 0;
  std::uint64_t activations_ = 0;
};

}  // namespace halfspace::systemc
