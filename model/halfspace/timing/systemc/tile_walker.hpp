/// tile_walker as a module.
#pragma once

#include <systemc>

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
  [[nodiscard]] StageMeter& meter() { return meter_; }

  // What the unit's walk calls; emitting suspends the walk until there is a credit.
  void decision(int x, int y, int size, TileVerdict verdict);
  void tile(const TileJob& job, TileWork tile_work);

 private:
  void walk();

  RunState& run_;
  StageMeter meter_;
  WalkerConfig config_;
  Cycle step_cycles_;
  TriangleToken triangle_;   ///< at work
  Cycle last_ = 0;           ///< cycle of the last emission, or of the load
  std::uint32_t steps_ = 0;  ///< since then
  Cycle done_ = 0;           ///< last step of the triangle before
  std::uint8_t slot_ = 0;    ///< of the triangle: the next after each that emitted a job
  bool emitted_ = false;     ///< the triangle has a job
};

}  // namespace halfspace::systemc
