/// Names of setup's pins.
#pragma once

namespace halfspace::tb {

struct SetupPins {
  static auto& input_valid(auto& model) { return model.triangle_valid_i; }
  static auto& input_payload(auto& model) { return model.packet_i; }
  static auto input_ready(auto& model) { return model.triangle_ready_o; }
  static auto output_valid(auto& model) { return model.triangle_valid_o; }
  static auto& output_payload(auto& model) { return model.packet_o; }
  static auto& output_ready(auto& model) { return model.triangle_ready_i; }
};

}  // namespace halfspace::tb
