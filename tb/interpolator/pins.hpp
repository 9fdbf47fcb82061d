/// Names of interpolator's pins, and what the verilated classes make of them.
#pragma once

#include <string>

#include "common/verilated_dut.hpp"
#include "models.hpp"

namespace halfspace::tb {

struct InterpolatorPins {
  static auto& input_valid(auto& model) { return model.quad_valid_i; }
  static auto& input_payload(auto& model) { return model.quad_i; }
  static auto input_ready(auto& model) { return model.quad_ready_o; }
  static auto output_valid(auto& model) { return model.shaded_valid_o; }
  static auto& output_payload(auto& model) { return model.shaded_o; }
  static auto& output_ready(auto& model) { return model.shaded_ready_i; }
};

template <class Model>
InterpolatorModel verilated(const std::string& name, int sub_pixel_bits, int bits, int fifo_depth) {
  return {{name, Widths{}.TileSize, sub_pixel_bits, 0, make_dut<Model, InterpolatorPins>},
          {sub_pixel_bits, bits, fifo_depth}};
}

}  // namespace halfspace::tb
