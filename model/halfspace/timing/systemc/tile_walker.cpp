#include "halfspace/timing/systemc/tile_walker.hpp"

#include <algorithm>

#include "halfspace/machine/draw_state.hpp"
#include "halfspace/machine/tile_size.hpp"

namespace halfspace::systemc {

TileWalker::TileWalker(const sc_core::sc_module_name& name, RunState& run)
    : sc_module(name),
      in("in"),
      out("out"),
      run_(run),
      meter_(Stage::kTileWalker, run),
      walker_(walker_config(run.config)),
      step_cycles_(static_cast<Cycle>(run.config.tile_walker.step_interval)) {
  SC_THREAD(walk);
  set_stack_size(kStackBytes);
}

void TileWalker::begin_frame() {
  walker_.reset();
  done_ = 0;
}

void TileWalker::walk() {
  run_.guard([&] {
    for (;;) {
      triangle_ = {};
      meter_.waits_for(stall::kNoInput);
      const Cycle accept = std::max(in->visible(), done_);
      meter_.work_on(in->front().draw);
      meter_.stalled(stall::kNoInput, accept);
      run_.clock.wait_until(accept);
      triangle_ = in->take(accept);
      run_.record(&PacketTimes::accept, accept);
      meter_.stalled(stall::kWalkerLoad, accept + 1);  // nothing, when hidden behind the last step

      last_ = accept;
      const std::uint32_t steps = with_tile_size(run_.config.tile_walker.tile_size, [&](auto size) {
        return walker_.walk<size()>(
            *triangle_.triangle, *triangle_.draw,
            [this](const TileJob& job, TileWork work, std::uint32_t taken) { emit(job, work, taken); });
      });
      done_ = last_ + steps * step_cycles_;
      meter_.busy(done_ + 1);
      run_.in_pipe.remove();
    }
  });
}

void TileWalker::emit(const TileJob& job, TileWork work, std::uint32_t steps) {
  const Cycle ready = last_ + steps * step_cycles_;
  meter_.busy(ready);
  meter_.waits_for(stall::kWalkerNoCredit);
  const Cycle at = std::max(ready, out->credit());
  meter_.stalled(stall::kWalkerNoCredit, at);
  run_.clock.wait_until(at);

  run_.record(&PacketTimes::emit, at);
  meter_.busy(at + 1);
  last_ = at;
  run_.in_pipe.add();
  out->use_credit();
  out->put({.draw = triangle_.draw, .triangle = triangle_.triangle, .job = job, .work = work}, at);
}

}  // namespace halfspace::systemc
