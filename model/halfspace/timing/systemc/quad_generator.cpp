#include "halfspace/timing/systemc/quad_generator.hpp"

#include "halfspace/machine/passage/quad_generator.hpp"
#include "halfspace/machine/tile_size.hpp"
#include "halfspace/timing/contract.hpp"

namespace halfspace::systemc {

QuadGenerator::QuadGenerator(const sc_core::sc_module_name& name, RunState& run, JobReturns& returns)
    : sc_module(name),
      in("in"),
      out("out"),
      run_(run),
      returns_(returns),
      meter_(Stage::kQuadGenerator, run) {
  SC_THREAD(generate);
}

void QuadGenerator::begin_frame() { next_ = 0; }

void QuadGenerator::generate() {
  run_.guard([&] {
    for (;;) {
      const Cycle at = meter_.wait_to_begin(*in.operator->(), next_, stall::kQuadNoCredit,
                                            [this] { return out->credit(); });
      CoverageToken token = in->take(at);
      run_.record(&PacketTimes::g, at);
      if (run_.config.hi_z.enabled) {
        returns_.covered(any(token.coverage.mask), at);
      }
      if (!any(token.coverage.mask)) {
        meter_.busy(at + 1);
        next_ = at + 1;
        run_.in_pipe.remove();
        continue;
      }
      const Burst burst = with_tile_size(run_.config.tile_walker.tile_size, [&](auto size) {
        return passage::quad_generator<size()>(token.coverage, *token.draw);
      });
      next_ = at + static_cast<Cycle>(beats(burst.quads, run_.config.quad_generator.quads_per_cycle));
      meter_.busy(next_);
      out->use_credit();
      out->put({.draw = token.draw, .triangle = std::move(token.triangle), .burst = burst}, at);
    }
  });
}

}  // namespace halfspace::systemc
