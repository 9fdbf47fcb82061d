/// z_test as a module: moves the lines of the z cache, tests bursts against them, and writes lines back.
#pragma once

#include <array>
#include <cstdint>
#include <systemc>
#include <vector>

#include "halfspace/timing/systemc/credit_link.hpp"
#include "halfspace/timing/systemc/hi_z.hpp"
#include "halfspace/timing/systemc/stage_meter.hpp"
#include "halfspace/timing/systemc/z_cache_state.hpp"

namespace halfspace::systemc {

class ZTest : public sc_core::sc_module {
 public:
  SC_HAS_PROCESS(ZTest);
  /// Tells `returns` of every burst.
  ZTest(const sc_core::sc_module_name& name, RunState& run, JobReturns& returns, ZCacheState& cache);

  sc_core::sc_port<CreditOut<TestedToken>> out;

  void begin_frame();

 private:
  void test_bursts();
  int replace_lines(const PendingToken& token);
  void move_lines(const PendingToken& token, Cycle at);
  void take_victim(const ZLines::Victim& victim, std::uint32_t slot, DrawContext* draw, Cycle at);
  template <int TileSize>
  TestedToken test(PendingToken& token);
  void write_back();

  RunState& run_;
  JobReturns& returns_;
  ZCacheState& cache_;
  StageMeter meter_;
  std::array<ZLines::Victim, kMaxZParts> victims_;
  Cycle next_ = 0;  ///< first cycle in which the next burst may be tested
  WriteToken writing_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace halfspace::systemc
