/// Exact depth of a triangle at a sample, as a rational number, and how far a stored depth is from it. Needs
/// GMP (256 bits and more: a float32 has an exponent, so that three of them have no common scale of 128
/// bits), and is therefore a library of its own, for tests.
#pragma once

#include <gmpxx.h>

#include <array>
#include <cstdint>

#include "halfspace/reference/exact_triangle.hpp"

namespace halfspace::reference {

/// The value of a unorm code: code / (2^bits - 1).
[[nodiscard]] mpq_class unorm_value(std::uint32_t code, int bits);

/// The value of a finite float.
[[nodiscard]] mpq_class float_value(float value);

/// The depth at `sample` of the plane through the vertices of `triangle`, which must have area, at the depths
/// `z`: the sum of z[i] * E[i] / 2A, where E[i] is the edge function of the edge opposite to vertex i.
[[nodiscard]] mpq_class exact_depth(const GridTriangle& triangle, const std::array<mpq_class, 3>& z,
                                    const GridPoint& sample);

/// The unorm code nearest to a depth in [0,1], ties to even. bits is 1 to 32.
[[nodiscard]] std::uint32_t nearest_unorm(const mpq_class& depth, int bits);

/// The float32 nearest to a depth in [0,1], ties to even.
[[nodiscard]] float nearest_float(const mpq_class& depth);

/// |stored - exact| in units of the last place of the format: 1 / (2^bits - 1).
[[nodiscard]] mpq_class ulps_off_unorm(std::uint32_t stored, const mpq_class& exact, int bits);

/// |stored - exact| in units of the last place of a float32 at `exact`: 2^(e - 23) where 2^e <= exact < 2^(e
/// + 1), 2^-149 below the normal numbers.
[[nodiscard]] mpq_class ulps_off_float(float stored, const mpq_class& exact);

}  // namespace halfspace::reference
