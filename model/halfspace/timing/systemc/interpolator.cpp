#include "halfspace/timing/systemc/interpolator.hpp"

#include <algorithm>
#include <bit>

#include "halfspace/machine/passage/interpolator.hpp"
#include "halfspace/machine/tile_size.hpp"
#include "halfspace/timing/contract.hpp"

namespace halfspace::systemc {

Interpolator::Interpolator(const sc_core::sc_module_name& name, RunState& run, Sink& sink)
    : sc_module(name), in("in"), out("out"), run_(run), sink_(sink), meter_(Stage::kInterpolator, run) {
  if (run.config.interpolator.enabled) {
    SC_THREAD(interpolate);
    set_stack_size(kStackBytes);
  }
}

void Interpolator::begin_frame() { next_ = 0; }

void Interpolator::interpolate() {
  run_.guard([&] {
    for (;;) {
      meter_.waits_for(stall::kNoInput);
      const Cycle visible = in->visible();
      const TestedToken& head = in->front();
      meter_.work_on(head.draw);
      meter_.stalled(stall::kNoInput, visible);
      const Cycle at = std::max(visible, next_);
      run_.clock.wait_until(at);
      run_.record(&PacketTimes::y, at);
      const std::uint64_t live = with_tile_size(run_.config.tile_walker.tile_size, [&](auto size) {
        return passage::interpolator<size()>(head.burst.burst, head.result, *head.draw);
      });
      next_ = shade(head, live, at);
      const TestedToken token = in->take(next_ - 1);
      sink_.show_burst(token, at);
      sink_.end_beats(*token.draw, next_ - 1, live != 0);
    }
  });
}

Cycle Interpolator::shade(const TestedToken& token, std::uint64_t live, Cycle at) {
  const int width = run_.config.early_z.quads_per_cycle;
  const int attributes = token.draw->attributes;
  std::uint64_t left =
      static_cast<std::uint64_t>(std::popcount(live)) * static_cast<std::uint64_t>(attributes);
  for (int first = 0; first < token.burst.burst.quads; first += width) {
    const std::uint64_t packets = shaded_packets(live, first, width, attributes);
    if (packets == 0) {
      meter_.busy(++at);
    }
    for (std::uint64_t n = 0; n < packets; ++n) {
      --left;
      at = give({.draw = token.draw,
                 .ends_burst = left == 0,
                 .ends_late = left == 0 && token.draw->early_z.late},
                at) +
           1;
      meter_.busy(at);
    }
  }
  return at;
}

Cycle Interpolator::give(const ShadedToken& token, Cycle at) {
  meter_.waits_for(stall::kInterpolatorNoCredit);
  const Cycle start = std::max(at, out->credit());
  meter_.stalled(stall::kInterpolatorNoCredit, start);
  run_.clock.wait_until(start);
  out->use_credit();
  out->put(token, start);
  return start;
}

}  // namespace halfspace::systemc
