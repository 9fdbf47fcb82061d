/// setup as a module: the cull stage, its queue, and the decision in front of the divider.
#pragma once

#include <systemc>

#include "halfspace/timing/systemc/credit_link.hpp"
#include "halfspace/timing/systemc/stage_meter.hpp"
#include "halfspace/timing/systemc/tokens.hpp"

namespace halfspace::systemc {

/// What the source sees of setup.
class TriangleInput : virtual public sc_core::sc_interface {
 public:
  /// The cull stage takes a triangle that is there from cycle `arrive` on; suspends the calling thread until
  /// it does. Returns the cycle.
  virtual Cycle take(const QueuedTriangle& triangle, Cycle arrive) = 0;
};

class Setup : public sc_core::sc_module, public TriangleInput {
 public:
  SC_HAS_PROCESS(Setup);
  Setup(const sc_core::sc_module_name& name, RunState& run);

  sc_core::sc_port<CreditOut<TriangleToken>> out;

  Cycle take(const QueuedTriangle& triangle, Cycle arrive) override;
  void begin_frame();

 private:
  void decide();

  RunState& run_;
  StageMeter meter_;
  CreditLink<QueuedTriangle> queue_;
  Cycle next_cull_ = 0;  ///< first cycle in which the stage is free
  Cycle next_decision_ = 0;
  Cycle divider_free_ = 0;
};

}  // namespace halfspace::systemc
