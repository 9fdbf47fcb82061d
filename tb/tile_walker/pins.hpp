/// Names of tile_walker's pins.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/verilated_dut.hpp"

namespace halfspace::tb {

struct TileWalkerPins {
  static auto& input_valid(auto& model) { return model.triangle_valid_i; }
  /// Triangle, equation and state, each in whole words.
  static void set_input_payload(auto& model, std::span<const std::uint32_t> payload) {
    const auto take = [&](auto& port) {
      to_port(payload, port);
      payload = payload.subspan(from_port(port).size());
    };
    take(model.triangle_i);
    take(model.equation_i);
    take(model.state_i);
  }
  static auto input_ready(auto& model) { return model.triangle_ready_o; }
  static auto output_valid(auto& model) { return model.job_valid_o; }
  static auto& output_payload(auto& model) { return model.job_o; }
  static auto& output_ready(auto& model) { return model.job_ready_i; }
  /// The write port of the slots: write, slot, equation, state.
  static void side_outputs(auto& model, std::vector<std::uint32_t>& words) {
    words.push_back(model.slot_write_o);
    words.push_back(model.slot_o);
    const auto add = [&](const auto& port) {
      const std::span<const std::uint32_t> bits = from_port(port);
      words.insert(words.end(), bits.begin(), bits.end());
    };
    add(model.slot_equation_o);
    add(model.slot_state_o);
  }
};

}  // namespace halfspace::tb
