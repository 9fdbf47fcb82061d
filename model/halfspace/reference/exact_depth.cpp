#include "halfspace/reference/exact_depth.hpp"

#include <algorithm>
#include <cmath>

namespace halfspace::reference {
namespace {

constexpr int kFloatFraction = 23;         // bits after the point of a float32
constexpr int kFloatLeastExponent = -126;  // of its normal numbers

/// GMP has no constructor from 128 bits: upper and lower half.
mpz_class to_integer(Int128 value) {
  const bool negative = value < 0;
  const Int128 magnitude = negative ? -value : value;
  mpz_class result = static_cast<unsigned long>(magnitude >> 64);
  result = (result << 64) + static_cast<unsigned long>(magnitude & ~0UL);
  return negative ? mpz_class(-result) : result;
}

/// 2^exponent.
mpq_class power_of_two(int exponent) {
  const mpz_class power = mpz_class(1) << static_cast<unsigned long>(std::abs(exponent));
  return exponent >= 0 ? mpq_class(power) : mpq_class(1, power);
}

mpq_class largest_code(int bits) { return power_of_two(bits) - 1; }

/// The nearest integer to a number that is not negative, ties to even.
mpz_class round_to_even(const mpq_class& value) {
  mpz_class down;
  mpz_fdiv_q(down.get_mpz_t(), value.get_num_mpz_t(), value.get_den_mpz_t());
  const mpq_class rest = value - down;
  const mpq_class half(1, 2);
  const bool odd = mpz_odd_p(down.get_mpz_t()) != 0;
  if (rest > half || (rest == half && odd)) return down + 1;
  return down;
}

/// The exponent of the unit of the last place of a float32 at `value`, which is not negative.
int unit_exponent(const mpq_class& value) {
  // Counting down from the binade of 1 is slow for tiny numbers, and plainly right.
  int e = 0;
  while (e > kFloatLeastExponent && value < power_of_two(e)) --e;
  return e - kFloatFraction;
}

}  // namespace

mpq_class unorm_value(std::uint32_t code, int bits) { return mpq_class(code) / largest_code(bits); }

mpq_class float_value(float value) {
  return mpq_class(static_cast<double>(value));
}  // exact by GMP's definition

mpq_class exact_depth(const GridTriangle& triangle, const std::array<mpq_class, 3>& z,
                      const GridPoint& sample) {
  const auto& [a, b, c] = triangle;
  const mpq_class sum = z[0] * to_integer(twice_area(b, c, sample)) +
                        z[1] * to_integer(twice_area(c, a, sample)) +
                        z[2] * to_integer(twice_area(a, b, sample));
  return sum / to_integer(twice_area(a, b, c));
}

std::uint32_t nearest_unorm(const mpq_class& depth, int bits) {
  return static_cast<std::uint32_t>(round_to_even(depth * largest_code(bits)).get_ui());
}

float nearest_float(const mpq_class& depth) {
  const int exponent = unit_exponent(depth);
  const mpz_class units = round_to_even(depth / power_of_two(exponent));
  return std::ldexp(static_cast<float>(units.get_ui()), exponent);  // at most 2^24 units: exact
}

mpq_class ulps_off_unorm(std::uint32_t stored, const mpq_class& exact, int bits) {
  return abs(mpq_class(stored) - exact * largest_code(bits));
}

mpq_class ulps_off_float(float stored, const mpq_class& exact) {
  return abs(float_value(stored) - exact) / power_of_two(unit_exponent(exact));
}

}  // namespace halfspace::reference
