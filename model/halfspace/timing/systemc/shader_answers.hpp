/// The way back from the shader to z_test: when it is through with a burst that writes late.
#pragma once

#include <deque>
#include <systemc>

#include "halfspace/timing/systemc/sim_clock.hpp"

namespace halfspace::systemc {

/// In the order of bursts that leave a late write.
class ShaderAnswers {
 public:
  void begin_frame() { ready_.clear(); }

  /// The next burst's late write may be done from cycle `ready` on.
  void answer(Cycle ready) {
    ready_.push_back(ready);
    answered_.notify();
  }

  /// That cycle, of the oldest that was not taken; suspends the calling thread until it is known.
  Cycle take(SimClock& clock) {
    while (ready_.empty()) {
      clock.wait_for(answered_);
    }
    const Cycle ready = ready_.front();
    ready_.pop_front();
    return ready;
  }

 private:
  std::deque<Cycle> ready_;
  sc_core::sc_event answered_{sc_core::sc_gen_unique_name("answered")};
};

}  // namespace halfspace::systemc
