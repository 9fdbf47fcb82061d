#include "halfspace/timing/systemc/setup.hpp"

#include <algorithm>

#include "halfspace/machine/passage/setup.hpp"
#include "halfspace/timing/contract.hpp"

namespace halfspace::systemc {

Setup::Setup(const sc_core::sc_module_name& name, RunState& run)
    : sc_module(name), out("out"), run_(run), meter_(Stage::kSetup, run), queue_(run, Fifo::kSetupQueue) {
  SC_THREAD(decide);
}

void Setup::begin_frame() {
  next_cull_ = 0;
  next_decision_ = 0;
  divider_free_ = 0;
}

Cycle Setup::take(const QueuedTriangle& triangle, Cycle arrive) {
  const Cycle at = std::max({arrive, next_cull_, queue_.credit(1)});
  run_.clock.wait_until(at);
  queue_.use_credit();
  queue_.put(triangle, at);
  next_cull_ = at + 1;
  return at;
}

void Setup::decide() {
  run_.guard([&] {
    const auto interval = static_cast<Cycle>(run_.config.setup.interval);
    SetupTriangle equations;
    for (;;) {
      meter_.waits_for(stall::kNoInput);
      const Cycle visible = queue_.visible();
      DrawContext* const draw = queue_.front().draw;
      meter_.work_on(draw);
      meter_.stalled(stall::kNoInput, visible);

      const bool drawn = passage::setup(queue_.front().triangle, *draw, equations);
      Cycle at = std::max(visible, next_decision_);
      if (drawn) {
        meter_.stalled(stall::kSetupDivider, divider_free_);
        meter_.waits_for(stall::kSetupNoCredit);
        const Cycle credit = out->credit();
        meter_.stalled(stall::kSetupNoCredit, credit);
        at = std::max({at, divider_free_, credit});
      }
      run_.clock.wait_until(at);

      queue_.take(at);
      run_.record(&PacketTimes::decide, at);
      meter_.busy(at + 1);
      next_decision_ = at + 1;
      if (!drawn) {
        run_.in_pipe.remove();
        continue;
      }
      divider_free_ = at + interval;
      out->use_credit();
      out->put({.draw = draw, .triangle = std::make_shared<const SetupTriangle>(equations)}, at);
    }
  });
}

}  // namespace halfspace::systemc
