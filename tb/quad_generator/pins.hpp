/// Names of quad_generator's pins.
#pragma once

namespace halfspace::tb {

struct QuadGeneratorPins {
  static auto& input_valid(auto& model) { return model.coverage_valid_i; }
  static auto& input_payload(auto& model) { return model.coverage_i; }
  static auto input_ready(auto& model) { return model.coverage_ready_o; }
  static auto output_valid(auto& model) { return model.beat_valid_o; }
  static auto& output_payload(auto& model) { return model.beat_o; }
  static auto& output_ready(auto& model) { return model.beat_ready_i; }
};

}  // namespace halfspace::tb
