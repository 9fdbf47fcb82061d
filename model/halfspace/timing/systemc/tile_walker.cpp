#include "halfspace/timing/systemc/tile_walker.hpp"

#include <algorithm>

#include "halfspace/timing/draw_state.hpp"
#include "halfspace/timing/tally.hpp"

namespace halfspace::systemc {

TileWalker::TileWalker(const sc_core::sc_module_name& name, RunState& run)
    : sc_module(name),
      in("in"),
      out("out"),
      run_(run),
      meter_(Stage::kTileWalker, run),
      config_(walker_config(run.config)),
      step_cycles_(static_cast<Cycle>(run.config.tile_walker.step_interval)) {
  SC_THREAD(walk);
  set_stack_size(kStackBytes);
}

void TileWalker::begin_frame() {
  done_ = 0;
  slot_ = 0;
}

void TileWalker::walk() {
  run_.guard([&] {
    for (;;) {
      triangle_ = {};
      meter_.waits_for(stall::kNoInput);
      const Cycle accept = std::max(in->visible(), done_);
      meter_.work_on(in->front().work);
      meter_.stalled(stall::kNoInput, accept);
      run_.clock.wait_until(accept);
      triangle_ = in->take(accept);
      run_.record(&PacketTimes::accept, accept);
      meter_.stalled(stall::kWalkerLoad, accept + 1);  // nothing, when hidden behind the last step

      last_ = accept;
      steps_ = 0;
      emitted_ = false;
      with_tile_size(run_.config.tile_walker.tile_size, [&](auto size) {
        halfspace::tile_walker<size()>(*triangle_.triangle, config_, slot_, *this);
      });
      slot_ = static_cast<std::uint8_t>(slot_ + (emitted_ ? 1 : 0));
      done_ = last_ + steps_ * step_cycles_;
      meter_.busy(done_ + 1);
      run_.in_pipe.remove();
    }
  });
}

void TileWalker::decision(int x, int y, int size, TileVerdict verdict) {
  ++steps_;
  DrawWork& work = *triangle_.work;
  tally(work.counters.tile_walker, verdict, size != run_.config.tile_walker.tile_size);
  if (work.record_decisions) {
    run_.observer->decision({.draw = work.draw,
                             .triangle = triangle_.triangle->triangle,
                             .surface = work.surface,
                             .x = static_cast<std::uint32_t>(x),
                             .y = static_cast<std::uint32_t>(y),
                             .size = static_cast<std::uint32_t>(size),
                             .verdict = verdict});
  }
}

void TileWalker::tile(const TileJob& job, TileWork tile_work) {
  steps_ += tile_work == TileWork::kWholeByBlock ? 1 : 0;  // no decision came before it
  const Cycle ready = last_ + steps_ * step_cycles_;
  meter_.busy(ready);
  meter_.waits_for(stall::kWalkerNoCredit);
  const Cycle at = std::max(ready, out->credit());
  meter_.stalled(stall::kWalkerNoCredit, at);
  run_.clock.wait_until(at);

  run_.record(&PacketTimes::emit, at);
  meter_.busy(at + 1);
  last_ = at;
  steps_ = 0;
  emitted_ = true;
  if (triangle_.work->record_jobs) {
    run_.observer->tile_job(job);
  }
  run_.in_pipe.add();
  out->use_credit();
  out->put({.work = triangle_.work, .triangle = triangle_.triangle, .job = job, .tile_work = tile_work}, at);
}

}  // namespace halfspace::systemc
