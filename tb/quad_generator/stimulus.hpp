/// Coverages for the quad_generator bench. Every function takes the widths of a configuration.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "common/random.hpp"
#include "common/stream_bench.hpp"
#include "halfspace/numerics/widths.hpp"
#include "halfspace/units/packets.hpp"

namespace halfspace::tb {

/// Cases that a random search might miss: every sample alone, every pair of quads, every number of quads at
/// both ends of the tile and in all parts of it, empty ones between full ones, all pass-through bits.
[[nodiscard]] std::vector<Coverage> directed_coverages(const Widths& widths);

/// The quads `numbers` covered, each by a random sample or more.
[[nodiscard]] Coverage coverage_of_quads(const std::vector<int>& numbers, const Widths& widths,
                                         Random& random);

/// Any number of quads in any places.
[[nodiscard]] Coverage random_coverage(int quads, const Widths& widths, Random& random);

/// What the C++ edge evaluator makes of tile jobs.
[[nodiscard]] std::vector<Coverage> coverages_of_jobs(const std::vector<TileJob>& jobs, const Widths& widths);

/// Runs of 1 to 32 coverages of a kind: empty, one quad, one beat, full, any number of quads, random samples,
/// or the quads between two rows and columns.
[[nodiscard]] std::unique_ptr<Stimulus> random_stimulus(const Widths& widths, std::uint64_t seed,
                                                        std::uint64_t count);
[[nodiscard]] std::unique_ptr<Stimulus> list_stimulus(const Widths& widths, std::vector<Coverage> coverages);

}  // namespace halfspace::tb
