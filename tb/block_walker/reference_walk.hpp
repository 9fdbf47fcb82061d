/// The walk of a triangle over blocks by the C++ definition, as the bench needs it: step by step.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/walk_triangles.hpp"
#include "halfspace/units/link_packets.hpp"
#include "halfspace/units/packets.hpp"
#include "halfspace/units/square_edges.hpp"

namespace halfspace::tb {

/// A configuration of the unit: its widths and its parameters.
struct BlockWalkerParameters {
  WalkSizes sizes;
  int fifo_depth = 4;
  bool trivial_reject = true;
  bool sample_reject = false;
  bool hi_z = false;
  int levels = 2;
  WalkOrder order = WalkOrder::kRaster;

  [[nodiscard]] WalkerConfig walker() const {
    return {.sub_pixel_bits = sizes.sub_pixel_bits,
            .block_size = sizes.block_size,
            .trivial_reject = trivial_reject,
            .sample_reject = sample_reject,
            .levels = levels,
            .order = order,
            .samples = sizes.pattern()};
  }
};

/// A step of the walk: a block of the bounds, or with one level a tile of it, or nothing that leaves. Sets of
/// tiles are masks as in BlockJob.
struct BlockStep {
  BlockJob job;                            ///< leaves, if it has a tile
  std::uint64_t touched = 0;               ///< by the bounds
  std::array<std::uint64_t, 3> outside{};  ///< of those: the boxes of all samples outside the edge
  std::array<std::uint64_t, 3> inside{};   ///< all inside
  bool few_samples = false;                ///< these are tested, not tiles
  bool wide = false;                       ///< the bounds have more than one column of blocks
  bool tall = false;                       ///< more than one row
  bool pass = false;                       ///< it only leads the walk: of the job only a and b are there
  [[nodiscard]] bool leaves() const { return job.tiles != 0; }
};

/// Words of the source's packet: the triangle, then what is only passed on, equation and state.
struct InputWords {
  std::size_t triangle = 0;
  std::size_t equation = 0;
  std::size_t state = 0;
  explicit InputWords(const Widths& widths);
  [[nodiscard]] std::size_t all() const { return triangle + equation + state; }
};

/// The walk of a triangle packet, by model/halfspace/units/block_walker.hpp. The sets of tiles are made from
/// the corners of all boxes of samples at the corners of each, or from all samples of few, and must agree
/// with its masks.
[[nodiscard]] std::vector<BlockStep> reference_walk(std::span<const std::uint32_t> triangle,
                                                    std::uint8_t slot,
                                                    const BlockWalkerParameters& parameters);

}  // namespace halfspace::tb
