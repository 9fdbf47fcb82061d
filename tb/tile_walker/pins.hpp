/// Names of tile_walker's pins, and what the verilated classes make of them.
#pragma once

#include <string>

#include "common/verilated_dut.hpp"
#include "models.hpp"

namespace halfspace::tb {

struct TileWalkerPins {
  static auto& input_valid(auto& model) { return model.block_valid_i; }
  static auto& input_payload(auto& model) { return model.block_i; }
  static auto input_ready(auto& model) { return model.block_ready_o; }
  static auto output_valid(auto& model) { return model.job_valid_o; }
  static auto& output_payload(auto& model) { return model.job_o; }
  static auto& output_ready(auto& model) { return model.job_ready_i; }
};

template <class Model>
TileWalkerModel verilated(const std::string& name, int tile_size, int block_size, int sub_pixel_bits,
                          int fifo_depth, bool accept, int order, int samples) {
  return {
      {name, tile_size, sub_pixel_bits, 0, make_dut<Model, TileWalkerPins>},
      {{tile_size, block_size, sub_pixel_bits, samples}, fifo_depth, accept, static_cast<TileOrder>(order)}};
}

}  // namespace halfspace::tb
