/// The walk of a triangle by the C++ definition, as the bench needs it: step by step.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "halfspace/numerics/widths.hpp"
#include "halfspace/units/link_packets.hpp"
#include "halfspace/units/packets.hpp"
#include "halfspace/units/tile_walker.hpp"

namespace halfspace::tb {

/// A configuration of the unit: its widths and its parameters.
struct WalkerParameters {
  int tile_size = 8;
  int sub_pixel_bits = 8;
  int fifo_depth = 16;
  int block_size = 32;
  bool block_level = true;
  bool trivial_reject = true;
  bool trivial_accept = true;
  int step_interval = 1;

  [[nodiscard]] Widths widths() const {
    return Widths{.SubPixelBits = sub_pixel_bits, .TileSize = tile_size};
  }
  [[nodiscard]] WalkerConfig walker() const {
    return {.sub_pixel_bits = sub_pixel_bits,
            .block_size = block_size,
            .block_level = block_level,
            .trivial_reject = trivial_reject,
            .trivial_accept = trivial_accept};
  }
};

/// What a step is about.
enum class StepKind : std::uint8_t {
  kBlockReject,
  kBlockAccept,
  kBlockPartial,
  kTileReject,
  kTileAccept,
  kTilePartial,
  kTileByBlock,  ///< of an accepted block: given out without a decision
};
inline constexpr std::size_t kStepKinds = 7;

constexpr bool gives_out(StepKind kind) { return kind >= StepKind::kTileAccept; }

struct WalkStep {
  StepKind kind = StepKind::kBlockReject;
  std::uint8_t edges = 0;  ///< bit i: edge i rejects, or is what makes the square partial; all of an accept
};

struct Walk {
  bool one_tile = false;  ///< the bounds fit one
  std::vector<WalkStep> steps;
  std::vector<TileJob> jobs;
};

/// Words of the source's packet: the triangle, then what is only passed on, equation and state.
struct InputWords {
  std::size_t triangle = 0;
  std::size_t equation = 0;
  std::size_t state = 0;
  explicit InputWords(const Widths& widths);
  [[nodiscard]] std::size_t all() const { return triangle + equation + state; }
};

/// The walk of a triangle packet, by model/halfspace/units/tile_walker.hpp.
[[nodiscard]] Walk reference_walk(std::span<const std::uint32_t> triangle, std::uint8_t slot,
                                  const WalkerParameters& parameters);

}  // namespace halfspace::tb
