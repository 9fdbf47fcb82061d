/// interpolator: from a quad and the values of an attribute at the vertices to its values at the four pixels.
///
/// The weights of the vertices at a pixel are b_i = E_i q_i / (E_0 q_0 + E_1 q_1 + E_2 q_2) with q = 1/w: the
/// numerators are the interpolation planes of M. Olano and T. Greer, "Triangle Scan Conversion using 2D
/// Homogeneous Coordinates" (1997), section 4. With equal q they are those of affine interpolation. E is
/// exact; what rounds is stated at interpolate(), and proved in docs/units/interpolator.md.
#pragma once

#include <array>
#include <cstdint>

#include "halfspace/units/link_packets.hpp"

namespace halfspace {

inline constexpr int kAttributeFraction = 16;  ///< bits of a component below the point
inline constexpr int kComponents = Widths{}.Components;
/// Bits of a weight above the point. At a helper pixel it may be below 0 and above 1; it saturates there.
inline constexpr int kWeightWhole = 4;

/// Of vertices 1 and 2, with as many bits below the point as the machine's mantissas have; vertex 0 has the
/// rest.
struct VertexWeights {
  std::int64_t w1 = 0;
  std::int64_t w2 = 0;
};

/// `e`: unbiased edge values at a pixel, their sum above 0. `q`: positive normal float32. `bits`: of the
/// mantissas that are multiplied, even, 8 to 24; bits below are cut off. Where the sum is not above 0 after
/// that, which is only at helper pixels, the plane of the triangle has no point in front of the eye: the
/// weights are 0.
[[nodiscard]] VertexWeights perspective_weights(const std::array<std::int64_t, 3>& e,
                                                const std::array<std::uint32_t, 3>& q, int bits);

/// Component c from its values at the vertices. At a covered pixel it is at most
/// 3 * 2^-bits (|v1 - v0| + |v2 - v0|) + 1/2 units of the last place off, and between the three values. At a
/// helper pixel it saturates at the ends of the format.
[[nodiscard]] std::int32_t interpolate(const std::array<std::int32_t, 3>& v, const VertexWeights& weights,
                                       bool covered, int bits);

[[nodiscard]] ShadedQuad interpolator(const AttributeQuad& quad, int sub_pixel_bits, int bits);

}  // namespace halfspace
