#include "halfspace/timing/systemc/sink.hpp"

#include <algorithm>

#include "halfspace/machine/passage/sink.hpp"
#include "halfspace/machine/tile_size.hpp"
#include "halfspace/timing/contract.hpp"

namespace halfspace::systemc {

Sink::Sink(const sc_core::sc_module_name& name, RunState& run, ShaderAnswers& answers)
    : sc_module(name), in("in"), shaded("shaded"), run_(run), answers_(answers) {
  if (run.config.interpolator.enabled) {
    SC_THREAD(take_shaded);
  } else {
    SC_THREAD(take);
  }
  set_stack_size(kStackBytes);
}

void Sink::begin_frame() { free_ = next_ = 0; }

void Sink::take() {
  run_.guard([&] {
    for (;;) {
      const Cycle at = std::max(in->visible(), free_);
      run_.clock.wait_until(at);
      const auto burst_beats =
          static_cast<Cycle>(beats(in->front().burst.burst.quads, run_.config.early_z.quads_per_cycle));
      const Cycle last = at + burst_beats - 1;
      const TestedToken token = in->take(last);
      free_ = last + 1;
      if (token.draw->early_z.late && any(token.result.passed)) {
        answers_.answer(free_ + static_cast<Cycle>(run_.config.late_z.latency));
      }
      run_.record(&PacketTimes::y, at);
      show_burst(token, at);
      end_beats(*token.draw, last, false);
    }
  });
}

void Sink::take_shaded() {
  run_.guard([&] {
    for (;;) {
      const Cycle at = std::max(shaded->visible(), free_);
      run_.clock.wait_until(at);
      const ShadedToken token = shaded->take(at);
      free_ = at + 1;
      run_.record(&PacketTimes::s, at);
      if (token.ends_late) {
        answers_.answer(free_ + static_cast<Cycle>(run_.config.late_z.latency));
      }
      if (token.ends_burst) {
        end_beats(*token.draw, at, false);
      }
    }
  });
}

void Sink::show_burst(const TestedToken& token, Cycle first_beat) {
  with_tile_size(run_.config.tile_walker.tile_size, [&](auto size) { show<size()>(token, first_beat); });
}

void Sink::end_beats(const DrawContext& draw, Cycle last, bool follows) {
  next_ = std::max(next_, last + 1);
  run_.book.burst_left(draw, last);
  if (!follows) {
    run_.in_pipe.remove();
  }
}

template <int TileSize>
void Sink::show(const TestedToken& token, Cycle first_beat) {
  const DrawContext& draw = *token.draw;
  const QuadBurst& burst = token.burst.burst.packet;
  const Coverage& coverage = burst.coverage;
  const SetupTriangle& triangle = *token.burst.triangle;
  passage::sink<TileSize>(coverage.mask, token.result, coverage.tile_x, coverage.tile_y, triangle.triangle,
                          draw, run_.surface(draw));
  if (draw.record_quads) {
    const bool together = run_.config.interpolator.enabled;
    const auto width = static_cast<Cycle>(run_.config.early_z.quads_per_cycle);
    passage::show_quads<TileSize>(burst, token.result, token.codes.data(), triangle, draw,
                                  [&](QuadEvent& quad, std::size_t number) {
                                    quad.cycle = first_beat + (together ? 0 : number / width);
                                    run_.observer->quad(quad);
                                  });
  }
}

}  // namespace halfspace::systemc
