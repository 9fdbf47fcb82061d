/// Triangles for the tile_walker bench, all of them made by the C++ setup().
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/random.hpp"
#include "common/stream_bench.hpp"
#include "halfspace/units/packets.hpp"
#include "reference_walk.hpp"

namespace halfspace::tb {

/// Cases that a random search might miss: one pixel at every place of a block, bounds at the edges of blocks
/// and of the screen, edges along rows and columns of samples, triangles that cover nothing, the guard band.
[[nodiscard]] std::vector<SetupTriangle> directed_triangles(const WalkerParameters& parameters);

/// One triangle of a random kind: of a pixel, of a tile, of blocks, slivers, on pixel centres, at the guard
/// band, large, at the edges of the screen; some of them cut by a scissor.
[[nodiscard]] SetupTriangle random_triangle(const WalkerParameters& parameters, Random& random);

/// The triangles that setup gives for a frame (.ptf and the like), in their order.
[[nodiscard]] std::vector<SetupTriangle> frame_triangles(const std::string& file,
                                                         const WalkerParameters& parameters);

/// Two triangles of `size` pixels square that cover it.
[[nodiscard]] std::vector<SetupTriangle> square(int x, int y, int size, const WalkerParameters& parameters);

/// Random triangles until they have given `jobs` tile jobs.
[[nodiscard]] std::unique_ptr<Stimulus> random_stimulus(const WalkerParameters& parameters,
                                                        std::uint64_t seed, std::uint64_t jobs);
/// Equations and states are random in either.
[[nodiscard]] std::unique_ptr<Stimulus> list_stimulus(const WalkerParameters& parameters, std::uint64_t seed,
                                                      std::vector<SetupTriangle> triangles);

}  // namespace halfspace::tb
