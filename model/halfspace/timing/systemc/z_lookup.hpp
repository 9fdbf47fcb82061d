/// z_lookup as a module: takes bursts, and asks memory for what the z cache lacks.
#pragma once

#include <cstdint>
#include <systemc>
#include <vector>

#include "halfspace/timing/systemc/credit_link.hpp"
#include "halfspace/timing/systemc/stage_meter.hpp"
#include "halfspace/timing/systemc/z_cache_state.hpp"

namespace halfspace::systemc {

class ZLookup : public sc_core::sc_module {
 public:
  SC_HAS_PROCESS(ZLookup);
  ZLookup(const sc_core::sc_module_name& name, RunState& run, ZCacheState& cache);

  sc_core::sc_port<CreditIn<BurstToken>> in;

  void begin_frame();

 private:
  void look_up_bursts();
  void look_up(Cycle at);
  Cycle resolve(int part, Cycle earliest);
  Cycle request(std::uint32_t line);

  RunState& run_;
  ZCacheState& cache_;
  StageMeter meter_;
  PendingToken looked_up_;  ///< at work
  Cycle next_ = 0;          ///< first cycle in which the next burst may be taken
  std::vector<std::uint8_t> bytes_;
};

}  // namespace halfspace::systemc
