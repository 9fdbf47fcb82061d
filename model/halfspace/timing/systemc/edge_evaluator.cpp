#include "halfspace/timing/systemc/edge_evaluator.hpp"

#include "halfspace/machine/passage/edge_evaluator.hpp"
#include "halfspace/machine/tile_size.hpp"

namespace halfspace::systemc {

EdgeEvaluator::EdgeEvaluator(const sc_core::sc_module_name& name, RunState& run)
    : sc_module(name), in("in"), out("out"), run_(run), meter_(Stage::kEdgeEvaluator, run) {
  SC_THREAD(evaluate);
}

void EdgeEvaluator::begin_frame() { next_ = 0; }

void EdgeEvaluator::evaluate() {
  run_.guard([&] {
    for (;;) {
      const Cycle at = meter_.wait_to_begin(*in.operator->(), next_, stall::kEdgeNoCredit,
                                            [this] { return out->credit(); });
      JobToken token = in->take(at);
      run_.record(&PacketTimes::e, at);
      meter_.busy(at + 1);
      next_ = at + 1;
      const Coverage coverage = with_tile_size(run_.config.tile_walker.tile_size, [&](auto size) {
        return passage::edge_evaluator<size()>(token.job, token.whole, *token.draw);
      });
      out->use_credit();
      out->put({.draw = token.draw, .triangle = std::move(token.triangle), .coverage = coverage}, at);
    }
  });
}

}  // namespace halfspace::systemc
