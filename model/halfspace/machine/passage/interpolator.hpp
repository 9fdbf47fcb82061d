/// A tested burst's passage into the interpolator: which of its quads ask for attributes, and their counts.
#pragma once

#include <bit>
#include <cstdint>

#include "halfspace/machine/draw_context.hpp"
#include "halfspace/machine/passage/quad_generator.hpp"
#include "halfspace/machine/passage/z_test.hpp"
#include "halfspace/units/quad_generator.hpp"

namespace halfspace::passage {

/// Bit i: quad i of the burst, in the order in which they leave, has a sample that passed, and its draw has a
/// shader that asks for attributes. The quads of a clear ask for none.
template <int TileSize>
std::uint64_t interpolator(const Burst& burst, const Tested& tested, DrawContext& draw) {
  std::uint64_t live = 0;
  if (draw.attributes == 0) {
    return live;
  }
  int number = 0;
  int passed = 0;
  for_each_quad<TileSize>(burst.packet, [&](const Quad& quad) {
    const std::uint8_t bits = quad_bits<TileSize>(tested.passed, quad.x, quad.y);
    live |= std::uint64_t{bits != 0} << number++;
    passed += std::popcount(bits);
  });
  const auto quads = static_cast<std::uint64_t>(std::popcount(live));
  InterpolatorCounters& counters = draw.counters.interpolator;
  counters.quads += quads;
  counters.quads_killed += static_cast<std::uint64_t>(burst.quads) - quads;
  counters.attributes += quads * static_cast<std::uint64_t>(draw.attributes);
  counters.helpers += 4 * quads - static_cast<std::uint64_t>(passed);
  return live;
}

}  // namespace halfspace::passage
