/// Names of edge_evaluator's pins.
#pragma once

namespace halfspace::tb {

struct EdgeEvaluatorPins {
  static auto& input_valid(auto& model) { return model.job_valid_i; }
  static auto& input_payload(auto& model) { return model.job_i; }
  static auto input_ready(auto& model) { return model.job_ready_o; }
  static auto output_valid(auto& model) { return model.coverage_valid_o; }
  static auto& output_payload(auto& model) { return model.coverage_o; }
  static auto& output_ready(auto& model) { return model.coverage_ready_i; }
};

}  // namespace halfspace::tb
