/// The depth interpolator `barycentric`: z = z0 + w1 (z1 - z0) + w2 (z2 - z0) with w_i = E_i / 2A by one
/// reciprocal a triangle; on float32 surfaces the sum of the three products w_i z_i, none of which is
/// negative, so nothing cancels. Error and the proof of the bounds: docs/numerics.md.
#pragma once

#include <algorithm>
#include <cstdint>

#include "halfspace/units/packets.hpp"

namespace halfspace {

inline constexpr int kWeightBits = 30;  ///< fraction bits of a barycentric weight in [0, 1]

/// Fills `reciprocal` and `shift` from area2 > 0, twice the area in squared sub-pixel units.
void set_reciprocal(DepthEquation& eq);

/// An edge value on the scale on which 2A has 32 bits.
inline std::uint64_t scale_weight(const DepthEquation& eq, std::int64_t e) {
  const auto value = static_cast<std::uint64_t>(e);
  return eq.shift >= 0 ? value >> eq.shift : value << -eq.shift;
}

/// E / 2A with kWeightBits fraction bits, at most 2^-29 too small.
inline std::int64_t weight(const DepthEquation& eq, std::int64_t e) {
  return static_cast<std::int64_t>((scale_weight(eq, e) * eq.reciprocal) >> (63 - kWeightBits));
}

/// Stored code at a covered sample of a unorm surface. e1 and e2 are the unbiased edge values.
inline std::uint32_t barycentric_unorm(const DepthEquation& eq, int fraction, std::int64_t e1,
                                       std::int64_t e2) {
  const std::int64_t z0 = eq.z[0];
  const std::int64_t sum =
      (z0 << kWeightBits) + weight(eq, e1) * (eq.z[1] - z0) + weight(eq, e2) * (eq.z[2] - z0);
  const int below = kWeightBits + fraction;
  const std::int64_t code = (sum + (std::int64_t{1} << (below - 1))) >> below;
  return static_cast<std::uint32_t>(std::clamp<std::int64_t>(code, eq.min_code, eq.max_code));
}

/// Stored bits at a covered sample of a float32 surface.
std::uint32_t barycentric_float(const DepthEquation& eq, std::int64_t e1, std::int64_t e2);

}  // namespace halfspace
