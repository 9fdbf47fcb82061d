/// quad_generator as a module.
#pragma once

#include <systemc>

#include "halfspace/timing/systemc/credit_link.hpp"
#include "halfspace/timing/systemc/hi_z.hpp"
#include "halfspace/timing/systemc/stage_meter.hpp"
#include "halfspace/timing/systemc/tokens.hpp"

namespace halfspace::systemc {

class QuadGenerator : public sc_core::sc_module {
 public:
  SC_HAS_PROCESS(QuadGenerator);
  /// Tells `returns` of every coverage.
  QuadGenerator(const sc_core::sc_module_name& name, RunState& run, JobReturns& returns);

  sc_core::sc_port<CreditIn<CoverageToken>> in;
  sc_core::sc_port<CreditOut<BurstToken>> out;

  void begin_frame();

 private:
  void generate();

  RunState& run_;
  JobReturns& returns_;
  StageMeter meter_;
  Cycle next_ = 0;  ///< first cycle in which the next coverage may be taken
};

}  // namespace halfspace::systemc
