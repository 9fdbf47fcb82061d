#include "halfspace/timing/systemc/hi_z.hpp"

#include <algorithm>
#include <utility>

#include "halfspace/machine/surfaces.hpp"
#include "halfspace/timing/contract.hpp"

namespace halfspace::systemc {

void JobReturns::covered(bool burst, Cycle taken) {
  returns_.push_back({.known = !burst, .ready = taken + kHiZEmptyLatency, .update = {}});
  wake();
}

void JobReturns::tested(const HiZUpdate& update, Cycle tested) {
  const auto burst = std::ranges::find(returns_, false, &Return::known);
  *burst = {.known = true, .ready = tested + kHiZUpdateLatency, .update = update};
  wake();
}

bool JobReturns::known(std::size_t jobs) const {
  return returns_.size() >= jobs &&
         std::all_of(returns_.begin(), returns_.begin() + static_cast<std::ptrdiff_t>(jobs),
                     [](const Return& each) { return each.known; });
}

void JobReturns::wake() {
  if (awaited_ != 0 && known(awaited_)) {
    known_.notify(clock_.time_until(returns_[awaited_ - 1].ready));
    awaited_ = 0;
  }
}

void JobReturns::wait_for(std::size_t jobs) {
  while (!known(jobs)) {
    awaited_ = jobs;
    clock_.wait_for(known_);
  }
}

HiZ::HiZ(const sc_core::sc_module_name& name, RunState& run)
    : sc_module(name), in("in"), out("out"), returns(run.clock), run_(run), meter_(Stage::kHiZ, run) {
  SC_THREAD(decide);
}

void HiZ::begin_frame() {
  places_ = place_blocks(run_.result.surfaces, run_.config);
  unit_ = make_hi_z(places_, run_.config);
  returns.begin_frame();
  seen_ = 0;
  next_ = 0;
  next_update_ = 0;
  out_ = 0;
  last_.fill(false);
}

Cycle HiZ::see(std::uint64_t end, Cycle from) {
  if (seen_ < end) {
    returns.wait_for(static_cast<std::size_t>(end - seen_));
  }
  Cycle last = 0;
  for (; seen_ < end; ++seen_) {
    unit_.retire(returns.update());
    last = std::max({returns.ready(), next_update_, from});
    next_update_ = last + 1;
    returns.pop();
  }
  return last;
}

/// Of the blocks in last_, each has a slot for itself: some already, because they leave.
Cycle HiZ::slot() { return out->credit(1 + static_cast<int>(std::ranges::count(last_, false))); }

void HiZ::decide() {
  run_.guard([&] {
    for (;;) {
      meter_.waits_for(stall::kNoInput);
      const Cycle visible = in->visible();
      meter_.work_on(in->front().draw);
      meter_.stalled(stall::kNoInput, visible);
      meter_.waits_for(stall::kHiZNoUpdate);
      const Cycle updated = see(unit_.must_retire(), next_);
      meter_.stalled(stall::kHiZNoUpdate, updated);
      meter_.waits_for(stall::kHiZNoCredit);
      const Cycle at = std::max({visible, next_, updated, slot()});
      meter_.stalled(stall::kHiZNoCredit, at);
      run_.clock.wait_until(at);

      BlockToken token = in->take(at);
      run_.record(&PacketTimes::hi_z, at);
      next_ = at + 1;
      meter_.busy(next_);
      DrawContext& draw = *token.draw;
      const HiZSurface place = draw.surface == kNoSurface ? HiZSurface{} : places_[draw.surface];
      passage::hi_z(unit_, token.block, token.triangle->depth, place, draw);
      out_ = next_;
      std::shift_left(last_.begin(), last_.end(), 1);
      last_.back() = token.block.tiles != 0;
      if (token.block.tiles == 0) {
        out_ = at + kHiZLatency - 1;  // it shows only there
        run_.in_pipe.remove();
        continue;
      }
      out->use_credit();
      out->put(std::move(token), at);
    }
  });
}

Cycle HiZ::clear(std::uint32_t surface, std::uint32_t code, Cycle idle) {
  see(unit_.must_retire(), next_);  // at once, what the next block must see; the rest when all else is idle
  see(unit_.jobs(), std::max(idle, out_) + 1);
  unit_.clear(places_[surface], code);
  last_.fill(false);
  return std::max({idle, next_update_, out_});
}

}  // namespace halfspace::systemc
