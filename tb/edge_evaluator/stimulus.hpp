/// Tile jobs for the edge_evaluator bench. Every function takes the widths of a configuration.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "common/random.hpp"
#include "common/stream_bench.hpp"
#include "halfspace/numerics/widths.hpp"
#include "halfspace/units/packets.hpp"

namespace halfspace::tb {

/// What the unit must make of a job: the C++ definition, with what it passes on.
[[nodiscard]] Coverage reference_coverage(const TileJob& job, const Widths& widths);

/// Cases that a random search might miss: extremes, saturation limits, accept bits and bounds one by one,
/// edges through samples.
[[nodiscard]] std::vector<TileJob> directed_jobs(const Widths& widths);

/// One job with fields of their own: half planes through the tile, near its corners, at the saturation limit
/// or anywhere.
[[nodiscard]] TileJob random_job(const Widths& widths, Random& random);

/// One job of a triangle with snapped vertices: slivers, small, large and guard-band triangles, at a tile
/// near it.
[[nodiscard]] TileJob triangle_job(const Widths& widths, Random& random);

/// Each as often: random_job and triangle_job.
[[nodiscard]] std::unique_ptr<Stimulus> random_stimulus(const Widths& widths, std::uint64_t seed,
                                                        std::uint64_t count);
[[nodiscard]] std::unique_ptr<Stimulus> list_stimulus(const Widths& widths, std::vector<TileJob> jobs);

}  // namespace halfspace::tb
