/// Names of setup's pins, and what the verilated classes make of them.
#pragma once

#include <string>

#include "common/verilated_dut.hpp"
#include "models.hpp"

namespace halfspace::tb {

struct SetupPins {
  static auto& input_valid(auto& model) { return model.triangle_valid_i; }
  static auto& input_payload(auto& model) { return model.packet_i; }
  static auto input_ready(auto& model) { return model.triangle_ready_o; }
  static auto output_valid(auto& model) { return model.triangle_valid_o; }
  static auto& output_payload(auto& model) { return model.packet_o; }
  static auto& output_ready(auto& model) { return model.triangle_ready_i; }
};

template <class Model>
SetupModel verilated(const std::string& name, int tile_size, int sub_pixel_bits, int block_size, int queue,
                     int fifo, int interval, int interpolator, int hi_z, int conservative, int uncertainty,
                     int thin_lines, int samples) {
  return {{name, tile_size, sub_pixel_bits, 0, make_dut<Model, SetupPins>},
          queue,
          fifo,
          interval,
          block_size,
          interpolator,
          hi_z != 0,
          conservative,
          uncertainty,
          thin_lines != 0,
          samples};
}

}  // namespace halfspace::tb
