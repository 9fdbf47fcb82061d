/// Names of block_walker's pins, and what the verilated classes make of them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/verilated_dut.hpp"
#include "models.hpp"

namespace halfspace::tb {

struct BlockWalkerPins {
  static auto& input_valid(auto& model) { return model.triangle_valid_i; }
  /// Triangle, equation and state, each in whole words.
  static void set_input_payload(auto& model, std::span<const std::uint32_t> payload) {
    const auto take = [&](auto& port) {
      set_port(port, payload);
      payload = payload.subspan(words_of(port).size());
    };
    take(model.triangle_i);
    take(model.equation_i);
    take(model.state_i);
  }
  static auto input_ready(auto& model) { return model.triangle_ready_o; }
  static auto output_valid(auto& model) { return model.block_valid_o; }
  static auto& output_payload(auto& model) { return model.block_o; }
  static auto& output_ready(auto& model) { return model.block_ready_i; }
  /// The write port of the slots: write, slot, equation, state.
  static void side_outputs(auto& model, std::vector<std::uint32_t>& words) {
    words.push_back(model.slot_write_o);
    words.push_back(model.slot_o);
    const auto add = [&](const auto& port) {
      const std::span<const std::uint32_t> bits = words_of(port);
      words.insert(words.end(), bits.begin(), bits.end());
    };
    add(model.slot_equation_o);
    add(model.slot_state_o);
  }
};

template <class Model>
BlockWalkerModel verilated(const std::string& name, int tile_size, int block_size, int sub_pixel_bits,
                           int fifo_depth, bool reject, bool samples, bool hi_z, int levels, int order,
                           int pixel_samples) {
  return {{name, tile_size, sub_pixel_bits, 0, make_dut<Model, BlockWalkerPins>},
          {{tile_size, block_size, sub_pixel_bits, pixel_samples},
           fifo_depth,
           reject,
           samples,
           hi_z,
           levels,
           static_cast<WalkOrder>(order)}};
}

}  // namespace halfspace::tb
