/// The verilated configurations of setup that this build has.
#pragma once

#include <string>
#include <vector>

#include "common/stream_dut.hpp"
#include "halfspace/machine/shape.hpp"
#include "halfspace/numerics/widths.hpp"
#include "halfspace/units/square_edges.hpp"

namespace halfspace::tb {

struct SetupModel {
  DutModel dut;
  int queue = 8;
  int fifo = 24;
  int interval = 1;
  int block_size = 32;
  int interpolator_number = 1;
  bool hi_z = false;
  int conservative_number = 0;
  int uncertainty = 0;
  bool thin_lines = false;
  int samples = 1;  ///< of a pixel, at the standard positions

  [[nodiscard]] SamplePattern pattern() const { return standard_samples(samples); }
  /// The places in a pixel that decide which pixels a box has: two corners of the box of the samples.
  [[nodiscard]] std::vector<SamplePosition> bounding_places() const {
    const SampleBox box = pattern().box();
    const SamplePosition least{.x = box.x_least, .y = box.y_least};
    const SamplePosition most{.x = box.x_most, .y = box.y_most};
    return samples == 1 ? std::vector{least} : std::vector{least, most};
  }
  [[nodiscard]] DepthInterpolator interpolator() const {
    return static_cast<DepthInterpolator>(interpolator_number);
  }
  [[nodiscard]] Conservative conservative() const { return static_cast<Conservative>(conservative_number); }
  /// Whether planes for hi_z are made.
  [[nodiscard]] bool has_planes() const { return hi_z && interpolator() == DepthInterpolator::kPlane; }
  /// Cycles from the decision to the output.
  [[nodiscard]] int divide_latency() const {
    Config config;
    config.depth.interpolator = interpolator();
    config.hi_z.enabled = hi_z;
    return latency(Link::kSetup, config);
  }
  [[nodiscard]] Widths widths() const {
    return {.SubPixelBits = dut.sub_pixel_bits,
            .PixelSamples = samples,
            .BlockSize = block_size,
            .TileSize = dut.tile_size};
  }
  [[nodiscard]] WalkerConfig walker() const {
    return {.sub_pixel_bits = dut.sub_pixel_bits, .block_size = block_size};
  }
};

[[nodiscard]] std::vector<SetupModel> setup_models();

}  // namespace halfspace::tb
