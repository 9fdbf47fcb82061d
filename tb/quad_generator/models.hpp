/// The verilated configurations of quad_generator that a bench has.
#pragma once

#include <vector>

#include "common/stream_dut.hpp"
#include "halfspace/numerics/widths.hpp"

namespace halfspace::tb {

struct QuadGeneratorModel {
  DutModel dut;
  int quad_width = 0;
  int z_parts = 0;
  int fifo_depth = 0;  ///< in bursts
};

[[nodiscard]] inline Widths widths_of(const QuadGeneratorModel& model) {
  return Widths{.SubPixelBits = model.dut.sub_pixel_bits,
                .TileSize = model.dut.tile_size,
                .QuadWidth = model.quad_width,
                .ZParts = model.z_parts};
}

[[nodiscard]] std::vector<QuadGeneratorModel> quad_generator_models();

}  // namespace halfspace::tb
