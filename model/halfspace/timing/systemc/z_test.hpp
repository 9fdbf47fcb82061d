/// z_test as a module: moves the lines of the z cache, tests bursts against them, does late writes, and
/// writes lines back.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <systemc>
#include <vector>

#include "halfspace/timing/systemc/credit_link.hpp"
#include "halfspace/timing/systemc/hi_z.hpp"
#include "halfspace/timing/systemc/shader_answers.hpp"
#include "halfspace/timing/systemc/stage_meter.hpp"
#include "halfspace/timing/systemc/z_cache_state.hpp"

namespace halfspace::systemc {

class ZTest : public sc_core::sc_module {
 public:
  SC_HAS_PROCESS(ZTest);
  /// Tells `returns` of every burst.
  ZTest(const sc_core::sc_module_name& name, RunState& run, JobReturns& returns, ZCacheState& cache);

  sc_core::sc_port<CreditOut<TestedToken>> out;

  /// Answered by who takes the bursts.
  ShaderAnswers answers;

  void begin_frame();
  /// Does the late writes that are out, from cycle `from` on, from which on no stage before it has anything
  /// left to do; returns the cycle after the last such.
  Cycle write_all_late(Cycle from);
  /// Nothing comes any more before the end of the frame.
  void end_frame();

 private:
  /// What the shader keeps of a burst, to be written when it is through.
  struct LateWrite {
    ZSlots slots;
    std::array<std::uint32_t, kMaxZParts> line{};  ///< of memory, by part
    int quads = 0;
    TileMask kept;
    std::vector<std::uint32_t> codes;
  };

  void test_bursts();
  void make_way(const PendingToken& token);
  void write_late();
  template <int TileSize>
  void write(const LateWrite& late);
  void tell_of_late();
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
  LateWrites order_;
  std::deque<LateWrite> late_;  ///< those that are out
  Cycle late_begun_ = 0;        ///< of what write_all_late() did: to be told with the next burst
  Cycle late_next_ = 0;
  WriteToken writing_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace halfspace::systemc
