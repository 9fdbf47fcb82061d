/// The verilated configurations of interpolator that a bench has.
#pragma once

#include <vector>

#include "common/stream_dut.hpp"
#include "halfspace/numerics/widths.hpp"

namespace halfspace::tb {

struct InterpolatorParameters {
  int sub_pixel_bits = 0;
  int bits = 0;        ///< of mantissas and weights
  int fifo_depth = 0;  ///< in quads

  [[nodiscard]] Widths widths() const { return Widths{.SubPixelBits = sub_pixel_bits}; }
};

struct InterpolatorModel {
  DutModel dut;
  InterpolatorParameters parameters;
};

[[nodiscard]] std::vector<InterpolatorModel> interpolator_models();

}  // namespace halfspace::tb
