/// interpolator as a module. Without `interpolator.enabled` its ports are not bound, and it does nothing.
#pragma once

#include <cstdint>
#include <systemc>

#include "halfspace/timing/systemc/credit_link.hpp"
#include "halfspace/timing/systemc/sink.hpp"
#include "halfspace/timing/systemc/stage_meter.hpp"
#include "halfspace/timing/systemc/tokens.hpp"

namespace halfspace::systemc {

class Interpolator : public sc_core::sc_module {
 public:
  SC_HAS_PROCESS(Interpolator);
  /// Shows `sink` each burst that it takes.
  Interpolator(const sc_core::sc_module_name& name, RunState& run, Sink& sink);

  sc_core::sc_port<CreditIn<TestedToken>, 1, sc_core::SC_ZERO_OR_MORE_BOUND> in;
  sc_core::sc_port<CreditOut<ShadedToken>, 1, sc_core::SC_ZERO_OR_MORE_BOUND> out;

  void begin_frame();

 private:
  void interpolate();
  /// The beats of a burst, from cycle `at` on, a quad with one attribute after the other; gives the cycle
  /// after.
  Cycle shade(const TestedToken& token, std::uint64_t live, Cycle at);
  /// Begins the next of them in cycle `at` or when there is a credit; gives that cycle.
  Cycle give(const ShadedToken& token, Cycle at);

  RunState& run_;
  Sink& sink_;
  StageMeter meter_;
  Cycle next_ = 0;  ///< first cycle in which the next burst may be taken
};

}  // namespace halfspace::systemc
