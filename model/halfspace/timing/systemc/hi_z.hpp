/// hi_z as a module, and the way back to it from the units behind.
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <systemc>

#include "halfspace/machine/passage/hi_z.hpp"
#include "halfspace/timing/systemc/credit_link.hpp"
#include "halfspace/timing/systemc/stage_meter.hpp"
#include "halfspace/timing/systemc/tokens.hpp"

namespace halfspace::systemc {

/// What has become of the tile jobs, in order: from quad_generator whether they have a burst, from z_test
/// what is stored behind it.
class JobReturns {
 public:
  explicit JobReturns(SimClock& clock) : clock_(clock) {}

  void begin_frame() { returns_.clear(); }

  /// The next job's coverage is taken in cycle `taken`.
  void covered(bool burst, Cycle taken);
  /// The last beat of the next burst is tested in cycle `tested`.
  void tested(const HiZUpdate& update, Cycle tested);

  /// Suspends the calling thread until it is known of the first `jobs` that hi_z has not seen when it can.
  void wait_for(std::size_t jobs);
  /// Of the first of them.
  [[nodiscard]] const HiZUpdate& update() const { return returns_.front().update; }
  /// The first cycle in which it can be seen.
  [[nodiscard]] Cycle ready() const { return returns_.front().ready; }
  void pop() { returns_.pop_front(); }

 private:
  struct Return {
    bool known = false;
    Cycle ready = 0;
    HiZUpdate update;
  };

  [[nodiscard]] bool known(std::size_t jobs) const;
  void wake();

  SimClock& clock_;
  std::deque<Return> returns_;
  std::size_t awaited_ = 0;  ///< jobs for which hi_z waits; 0 where it does not
  sc_core::sc_event known_{sc_core::sc_gen_unique_name("job_returned")};
};

class HiZ : public sc_core::sc_module {
 public:
  SC_HAS_PROCESS(HiZ);
  HiZ(const sc_core::sc_module_name& name, RunState& run);

  sc_core::sc_port<CreditIn<BlockToken>> in;
  sc_core::sc_port<CreditOut<BlockToken>> out;
  JobReturns returns;

  void begin_frame();
  /// The first cycle in which no block is in the unit of which nothing is left.
  [[nodiscard]] Cycle blocks_out() const { return out_; }
  /// Nothing is under way from cycle `idle` on. Returns the cycle in which all jobs are seen and the surface
  /// is cleared.
  Cycle clear(std::uint32_t surface, std::uint32_t code, Cycle idle);

 private:
  void decide();
  /// Applies all jobs before `end`, one a cycle from cycle `from` on; returns the cycle of the last.
  Cycle see(std::uint64_t end, Cycle from);
  /// The first cycle in which the output FIFO has a slot for the next block, whatever becomes of those
  /// before.
  Cycle slot();

  RunState& run_;
  StageMeter meter_;
  halfspace::HiZ unit_;
  std::vector<HiZSurface> places_;
  std::uint64_t seen_ = 0;
  Cycle next_ = 0;
  Cycle next_update_ = 0;
  Cycle out_ = 0;
  std::array<bool, kHiZUndecided> last_{};  ///< whether the last blocks left
};

}  // namespace halfspace::systemc
