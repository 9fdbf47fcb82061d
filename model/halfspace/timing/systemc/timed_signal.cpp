#include "halfspace/timing/systemc/timed_signal.hpp"

#include <algorithm>

namespace halfspace::systemc {

TimedSignal::TimedSignal(const sc_core::sc_module_name& name, const SimClock& clock)
    : sc_module(name), clock_(clock) {
  SC_METHOD(apply);
  sensitive << due_;
  dont_initialize();
}

void TimedSignal::change(Cycle cycle, Change change) {
  changes_.emplace(std::max(cycle, clock_.now()), change);
  due_.notify(clock_.time_until(changes_.begin()->first));
}

void TimedSignal::apply() {
  const Cycle now = clock_.now();
  while (!changes_.empty() && changes_.begin()->first <= now) {
    const Change& change = changes_.begin()->second;
    value_ = change.relative ? value_ + change.value : change.value;
    changes_.erase(changes_.begin());
  }
  if (!changes_.empty()) {
    due_.notify(clock_.time_until(changes_.begin()->first));
  }
}

}  // namespace halfspace::systemc
