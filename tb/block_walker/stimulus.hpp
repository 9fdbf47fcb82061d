/// What the bench of block_walker sends: triangles of walk_triangles.hpp as packets.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "common/stream_bench.hpp"
#include "halfspace/units/packets.hpp"
#include "reference_walk.hpp"

namespace halfspace::tb {

/// Random triangles until they have given `blocks` block jobs.
[[nodiscard]] std::unique_ptr<Stimulus> random_stimulus(const BlockWalkerParameters& parameters,
                                                        std::uint64_t seed, std::uint64_t blocks);
/// Equations and states are random in either.
[[nodiscard]] std::unique_ptr<Stimulus> list_stimulus(const BlockWalkerParameters& parameters,
                                                      std::uint64_t seed,
                                                      std::vector<SetupTriangle> triangles);

}  // namespace halfspace::tb
