/// Takes what early_z gives, as pixel shading would: counts the fragments of each pixel, and shows the quads
/// to who watches.
#pragma once

#include <systemc>

#include "halfspace/timing/systemc/credit_link.hpp"
#include "halfspace/timing/systemc/shader_answers.hpp"
#include "halfspace/timing/systemc/tokens.hpp"

namespace halfspace::systemc {

class Sink : public sc_core::sc_module {
 public:
  SC_HAS_PROCESS(Sink);
  /// Tells `answers` when the shader is through with a burst.
  Sink(const sc_core::sc_module_name& name, RunState& run, ShaderAnswers& answers);

  sc_core::sc_port<CreditIn<TestedToken>> in;

  void begin_frame();
  /// First cycle after the last beat so far.
  [[nodiscard]] Cycle next() const { return next_; }

 private:
  void take();
  template <int TileSize>
  void show(const TestedToken& token, Cycle first_beat);

  RunState& run_;
  ShaderAnswers& answers_;
  Cycle next_ = 0;
};

}  // namespace halfspace::systemc
