/// tile_walker as a module.
#pragma once

#include <systemc>

#include "halfspace/machine/passage/tile_walker.hpp"
#include "halfspace/timing/systemc/credit_link.hpp"
#include "halfspace/timing/systemc/stage_meter.hpp"
#include "halfspace/timing/systemc/tokens.hpp"

namespace halfspace::systemc {

class TileWalker : public sc_core::sc_module {
 public:
  SC_HAS_PROCESS(TileWalker);
  TileWalker(const sc_core::sc_module_name& name, RunState& run);

  sc_core::sc_port<CreditIn<TriangleToken>> in;
  sc_core::sc_port<CreditOut<JobToken>> out;

  void begin_frame();

 private:
  void walk();
  /// Suspends until there is a credit.
  void emit(const TileJob& job, TileWork work, std::uint32_t steps);

  RunState& run_;
  StageMeter meter_;
  passage::TileWalker walker_;
  Cycle step_cycles_;
  TriangleToken triangle_;  ///< at work
  Cycle last_ = 0;          ///< cycle of the last emission, or of the load
  Cycle done_ = 0;          ///< last step of the triangle before
};

}  // namespace halfspace::systemc
