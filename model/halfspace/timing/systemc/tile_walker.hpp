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

  sc_core::sc_port<CreditIn<BlockToken>> in;
  sc_core::sc_port<CreditOut<JobToken>> out;

  void begin_frame();

 private:
  void walk();
  /// Suspends until there is a credit. The block can be seen from cycle `visible` on.
  void emit(const TileJob& job, bool whole, Cycle visible);

  RunState& run_;
  StageMeter meter_;
  WalkerConfig config_;
  Cycle next_ = 0;  ///< of the next job
};

}  // namespace halfspace::systemc
