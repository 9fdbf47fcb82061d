/// What the bench of tile_walker sends: the blocks that triangles of walk_triangles.hpp touch.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "common/stream_bench.hpp"
#include "halfspace/units/packets.hpp"
#include "parameters.hpp"

namespace halfspace::tb {

/// The block jobs that the C++ block_walker gives for triangles, in their order.
[[nodiscard]] std::vector<BlockJob> block_jobs(std::span<const SetupTriangle> triangles,
                                               const WalkSizes& sizes);

/// The tile jobs of a block, by model/halfspace/units/tile_walker.hpp.
[[nodiscard]] std::vector<TileJob> tile_jobs(const BlockJob& block, const TileWalkerParameters& parameters);

/// Blocks of random triangles until they have given `jobs` tile jobs. Many blocks have only some of their
/// tiles, or one: masks that block_walker gives seldom, or never.
[[nodiscard]] std::unique_ptr<Stimulus> random_stimulus(const TileWalkerParameters& parameters,
                                                        std::uint64_t seed, std::uint64_t jobs);
/// Slots are random in either.
[[nodiscard]] std::unique_ptr<Stimulus> list_stimulus(const TileWalkerParameters& parameters,
                                                      std::uint64_t seed, std::vector<BlockJob> blocks);

}  // namespace halfspace::tb
