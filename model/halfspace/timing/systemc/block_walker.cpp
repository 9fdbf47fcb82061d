#include "halfspace/timing/systemc/block_walker.hpp"

#include <algorithm>

#include "halfspace/machine/draw_state.hpp"
#include "halfspace/machine/tile_size.hpp"

namespace halfspace::systemc {

BlockWalker::BlockWalker(const sc_core::sc_module_name& name, RunState& run)
    : sc_module(name),
      in("in"),
      out("out"),
      run_(run),
      meter_(Stage::kBlockWalker, run),
      walker_(walker_config(run.config)) {
  SC_THREAD(walk);
  set_stack_size(kStackBytes);
}

void BlockWalker::begin_frame() {
  walker_.reset();
  next_ = 0;
}

void BlockWalker::walk() {
  run_.guard([&] {
    for (;;) {
      triangle_ = {};
      meter_.waits_for(stall::kNoInput);
      const Cycle visible = in->visible();
      const Cycle accept = std::max(visible + 1, next_) - 1;  // hidden behind the last step
      meter_.work_on(in->front().draw);
      meter_.stalled(stall::kNoInput, accept);
      run_.clock.wait_until(accept);
      triangle_ = in->take(accept);
      run_.record(&PacketTimes::accept, accept);
      meter_.stalled(stall::kBlockLoad, accept + 1);  // nothing, when hidden

      next_ = accept + 1;
      const std::uint32_t empty_after = with_tile_size(run_.config.tile_walker.tile_size, [&](auto size) {
        return walker_.walk<size()>(
            *triangle_.triangle, *triangle_.draw,
            [this](const BlockJob& block, std::uint32_t empty) { emit(block, empty); });
      });
      if (empty_after != 0) {
        visit(empty_after);
      }
      run_.in_pipe.remove();
    }
  });
}

void BlockWalker::visit(std::uint32_t empty) {
  meter_.waits_for(stall::kBlockNoCredit);
  next_ = std::max(next_, out->credit());
  meter_.stalled(stall::kBlockNoCredit, next_);
  next_ += empty;
  meter_.busy(next_);
}

void BlockWalker::emit(const BlockJob& block, std::uint32_t empty_before) {
  visit(empty_before);
  const Cycle at = next_++;
  run_.clock.wait_until(at);
  run_.record(&PacketTimes::block, at);
  meter_.busy(next_);
  run_.in_pipe.add();
  out->use_credit();
  out->put({.draw = triangle_.draw, .triangle = triangle_.triangle, .block = block}, at);
}

}  // namespace halfspace::systemc
