/// The depth interpolator `barycentric`: z = z0 + w1 (z1 - z0) + w2 (z2 - z0) with w_i = E_i / 2A by one
/// reciprocal a triangle; on float32 surfaces the sum of the three products w_i z_i. None is negative where
/// the depths are not, so nothing cancels. Error and the proof of the bounds: docs/numerics.md.
#pragma once

#include <cstdint>

#include "halfspace/units/packets.hpp"

namespace halfspace {

inline constexpr int kWeightBits = 30;  ///< fraction bits of a barycentric weight in [0, 1]

/// Fills `reciprocal` and `shift`; area2 is there.
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

/// Depth at a covered sample of a unorm surface, in the form of a vertex depth. e1 and e2 are the unbiased
/// edge values.
inline std::int64_t barycentric_unorm(const DepthEquation& eq, std::int64_t e1, std::int64_t e2) {
  // Vertex depths beyond [0, 1] lose low bits, so that the difference of two has 32 bits all the same.
  const int cut = eq.beyond ? eq.exponent + 1 : 0;
  const std::int64_t z0 = eq.z[0] >> cut;
  const std::int64_t rise1 = (eq.z[1] >> cut) - z0;
  const std::int64_t rise2 = (eq.z[2] >> cut) - z0;
  const std::int64_t sum = (z0 << kWeightBits) + weight(eq, e1) * rise1 + weight(eq, e2) * rise2;
  return sum >> (kWeightBits - cut);
}

/// Stored bits at a covered sample of a float32 surface, not yet clamped.
std::uint32_t barycentric_float(const DepthEquation& eq, std::int64_t e1, std::int64_t e2);

}  // namespace halfspace
