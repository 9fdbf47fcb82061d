/// block_walker as a module.
#pragma once

#include <systemc>

#include "halfspace/machine/passage/block_walker.hpp"
#include "halfspace/timing/systemc/credit_link.hpp"
#include "halfspace/timing/systemc/stage_meter.hpp"
#include "halfspace/timing/systemc/tokens.hpp"

namespace halfspace::systemc {

class BlockWalker : public sc_core::sc_module {
 public:
  SC_HAS_PROCESS(BlockWalker);
  BlockWalker(const sc_core::sc_module_name& name, RunState& run);

  sc_core::sc_port<CreditIn<TriangleToken>> in;
  sc_core::sc_port<CreditOut<BlockToken>> out;

  void begin_frame();

 private:
  void walk();
  void emit(const BlockJob& block, std::uint32_t empty_before);
  /// Visits so many blocks without a tile. Suspends until there is a credit, which each step waits for.
  void visit(std::uint32_t empty);

  RunState& run_;
  StageMeter meter_;
  passage::BlockWalker walker_;
  TriangleToken triangle_;  ///< at work
  Cycle next_ = 0;          ///< of the next step
};

}  // namespace halfspace::systemc
