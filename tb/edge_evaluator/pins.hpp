/// Names of edge_evaluator's pins, and what the verilated classes make of them.
#pragma once

#include <string>

#include "common/verilated_dut.hpp"
#include "models.hpp"

namespace halfspace::tb {

struct EdgeEvaluatorPins {
  static auto& input_valid(auto& model) { return model.job_valid_i; }
  static auto& input_payload(auto& model) { return model.job_i; }
  static auto input_ready(auto& model) { return model.job_ready_o; }
  static auto output_valid(auto& model) { return model.coverage_valid_o; }
  static auto& output_payload(auto& model) { return model.coverage_o; }
  static auto& output_ready(auto& model) { return model.coverage_ready_i; }
};

template <class Model>
DutModel verilated(const std::string& name, int tile_size, int sub_pixel_bits, int pipe_stages) {
  return {name, tile_size, sub_pixel_bits, pipe_stages, make_dut<Model, EdgeEvaluatorPins>};
}

}  // namespace halfspace::tb
