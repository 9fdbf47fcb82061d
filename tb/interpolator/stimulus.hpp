/// Quads with an attribute for the interpolator bench.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "common/random.hpp"
#include "common/stream_bench.hpp"
#include "halfspace/units/link_packets.hpp"
#include "interpolator_coverage.hpp"
#include "models.hpp"

namespace halfspace::tb {

/// Cases that a random search might miss: one edge value or product alone, the ends of every width, the
/// horizon of a plane, weights at and beyond their ends, values at the ends of the format.
[[nodiscard]] std::vector<AttributeQuad> directed_quads(const InterpolatorParameters& parameters);

/// Quads of triangles with snapped vertices, and quads of edges of any size. What the unit must make of them
/// is counted in `coverage`.
[[nodiscard]] std::unique_ptr<Stimulus> random_stimulus(const InterpolatorParameters& parameters,
                                                        InterpolatorCoverage& coverage, std::uint64_t seed,
                                                        std::uint64_t count);
[[nodiscard]] std::unique_ptr<Stimulus> list_stimulus(const InterpolatorParameters& parameters,
                                                      InterpolatorCoverage& coverage,
                                                      std::vector<AttributeQuad> quads);

}  // namespace halfspace::tb
