/// Names of quad_generator's pins, and what the verilated classes make of them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/verilated_dut.hpp"
#include "models.hpp"

namespace halfspace::tb {

struct QuadGeneratorPins {
  static auto& input_valid(auto& model) { return model.coverage_valid_i; }
  static auto& input_payload(auto& model) { return model.coverage_i; }
  static auto input_ready(auto& model) { return model.coverage_ready_o; }
  static auto output_valid(auto& model) { return model.beat_valid_o; }
  static auto& output_payload(auto& model) { return model.beat_o; }
  static auto& output_ready(auto& model) { return model.beat_ready_i; }
  /// For hi_z: taken, burst.
  static void side_outputs(auto& model, std::vector<std::uint32_t>& words) {
    words.push_back(model.job_taken_o);
    words.push_back(model.job_burst_o);
  }
};

template <class Model>
QuadGeneratorModel verilated(const std::string& name, int tile_size, int quad_width, int z_parts,
                             int fifo_depth, int sub_pixel_bits) {
  return {{name, tile_size, sub_pixel_bits, 0, make_dut<Model, QuadGeneratorPins>},
          quad_width,
          z_parts,
          fifo_depth};
}

}  // namespace halfspace::tb
