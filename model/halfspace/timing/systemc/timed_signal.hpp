/// A value for a trace file whose changes are known ahead of their time.
#pragma once

#include <map>
#include <systemc>

#include "halfspace/timing/systemc/sim_clock.hpp"

namespace halfspace::systemc {

/// The links and stages work with time stamps and are touched only when a packet moves; a waveform wants
/// every change in its cycle. Exists only in runs that are traced.
class TimedSignal : public sc_core::sc_module {
 public:
  SC_HAS_PROCESS(TimedSignal);
  TimedSignal(const sc_core::sc_module_name& name, const SimClock& clock);

  /// The value becomes `value` in `cycle`, or now if that is past. Of several for one cycle the last counts.
  void set(Cycle cycle, int value) { change(cycle, {.value = value, .relative = false}); }
  void add(Cycle cycle, int difference) { change(cycle, {.value = difference, .relative = true}); }

  [[nodiscard]] const int& value() const { return value_; }

 private:
  struct Change {
    int value;
    bool relative;
  };

  void change(Cycle cycle, Change change);
  void apply();

  const SimClock& clock_;
  std::multimap<Cycle, Change> changes_;
  sc_core::sc_event due_;
  int value_ = 0;
};

}  // namespace halfspace::systemc
