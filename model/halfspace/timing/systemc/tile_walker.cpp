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
      config_(walker_config(run.config)) {
  SC_THREAD(walk);
  set_stack_size(kStackBytes);
}

void TileWalker::begin_frame() { next_ = 0; }

void TileWalker::walk() {
  run_.guard([&] {
    for (;;) {
      meter_.waits_for(stall::kNoInput);
      const Cycle visible = in->visible();
      const BlockToken& token = in->front();  // it works from the head
      meter_.work_on(token.draw);
      meter_.stalled(stall::kNoInput, visible);
      with_tile_size(run_.config.tile_walker.tile_size, [&](auto size) {
        passage::tile_walker<size()>(
            token.block, config_, *token.draw,
            [this, visible](const TileJob& job, bool whole) { emit(job, whole, visible); });
        return 0;
      });
      in->take(next_ - 1);
      run_.in_pipe.remove();
    }
  });
}

void TileWalker::emit(const TileJob& job, bool whole, Cycle visible) {
  meter_.waits_for(stall::kTileNoCredit);
  const Cycle at = std::max({visible, next_, out->credit()});
  meter_.stalled(stall::kTileNoCredit, at);
  run_.clock.wait_until(at);
  run_.record(&PacketTimes::emit, at);
  next_ = at + 1;
  meter_.busy(next_);
  run_.in_pipe.add();
  out->use_credit();
  const BlockToken& token = in->front();
  out->put({.draw = token.draw, .triangle = token.triangle, .job = job, .whole = whole}, at);
}

}  // namespace halfspace::systemc
