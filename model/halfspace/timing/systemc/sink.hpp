/// Takes what early_z or the interpolator behind it gives, as pixel shading would: counts the fragments of
/// each pixel, and shows the quads to who watches.
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

  /// Only one is bound: that of the last unit.
  sc_core::sc_port<CreditIn<TestedToken>, 1, sc_core::SC_ZERO_OR_MORE_BOUND> in;
  sc_core::sc_port<CreditIn<ShadedToken>, 1, sc_core::SC_ZERO_OR_MORE_BOUND> shaded;

  void begin_frame();
  /// First cycle after the last beat so far, also of the interpolator.
  [[nodiscard]] Cycle next() const { return next_; }

  // For the interpolator.

  /// A burst has left early_z, whose first beat did in that cycle.
  void show_burst(const TestedToken& token, Cycle first_beat);
  /// It has left it with its last beat in cycle `last`. `follows`: some of its quads are still to come.
  void end_beats(const DrawContext& draw, Cycle last, bool follows);

 private:
  void take();
  void take_shaded();
  template <int TileSize>
  void show(const TestedToken& token, Cycle first_beat);

  RunState& run_;
  ShaderAnswers& answers_;
  Cycle free_ = 0;  ///< first cycle in which it may take the next packet
  Cycle next_ = 0;
};

}  // namespace halfspace::systemc
