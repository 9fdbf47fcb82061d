/// What the bench sends to hi_z, and what must come of it: commands in order, with the answers of the C++
/// units.
#pragma once

#include <cstdint>
#include <vector>

#include "halfspace/units/hi_z.hpp"
#include "halfspace/units/packets.hpp"
#include "hi_z/models.hpp"

namespace halfspace::tb {

enum class HiZCommandKind : std::uint8_t { kBlock, kClear, kFrameEnd };

/// A tile job that leaves, and what comes back of it.
struct HiZJob {
  std::uint8_t tile = 0;
  bool burst = false;
  HiZUpdate update;
  std::vector<std::uint32_t> words;  ///< of the update
};

struct HiZCommand {
  HiZCommandKind kind = HiZCommandKind::kBlock;
  // A block.
  std::size_t triangle = 0;  ///< in HiZWorkload::triangles
  std::uint32_t number = 0;  ///< of the block; 0 where the draw does not test
  std::uint64_t tiles = 0;
  std::uint64_t rejected = 0;
  std::uint64_t sure = 0;
  EarlyZState state;
  DepthMoves moves;
  std::uint32_t clear_code = 0;
  bool plane = false;                ///< known
  bool gets_slot = false;            ///< the triangle: the block is its first that leaves
  std::uint8_t slot = 0;             ///< with which it leaves
  std::vector<std::uint32_t> words;  ///< as it comes
  std::vector<std::uint32_t> left;   ///< as it must leave, where it has a tile left
  std::vector<HiZJob> jobs;
  // A clear, in blocks.
  std::uint32_t first = 0;
  std::uint32_t last = 0;
};

struct HiZTriangleWords {
  std::vector<std::uint32_t> equation;
  std::vector<std::uint32_t> state;
};

struct HiZWorkload {
  std::vector<HiZTriangleWords> triangles;  ///< the slot that they come with is the index, modulo 256
  std::vector<HiZCommand> commands;
};

enum class HiZStyle : std::uint8_t {
  kDrawn,     ///< draws of all kinds, and what they leave in three surfaces
  kOneBlock,  ///< the same in one block or two of each
  /// Bounds that no draw has left: ranges that grow, shrink and move, at the ends of the codes too; and
  /// planes that are a fraction of a word away from where the verdict changes.
  kMadeUp,
};

/// So many blocks, with clears and ends of frames between them.
[[nodiscard]] HiZWorkload make_hi_z_workload(const HiZShape& shape, HiZStyle style, std::uint64_t seed,
                                             std::size_t blocks);

}  // namespace halfspace::tb
