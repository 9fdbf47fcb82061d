#include "halfspace/units/depth_interpolator.hpp"

#include <algorithm>

namespace halfspace {
namespace {

__extension__ using Int128 = __int128;

/// numerator / denominator rounded to nearest (halves upwards) and saturated to +-2^kPlaneLimitBits.
std::int64_t saturated_quotient(Int128 numerator, std::int64_t denominator) {
  constexpr Int128 kLimit = Int128{1} << kPlaneLimitBits;
  const Int128 doubled = 2 * numerator + denominator;
  Int128 quotient = doubled / (2 * Int128{denominator});
  if (doubled < 0 && quotient * 2 * denominator != doubled) {
    --quotient;  // division truncates, the rounding needs floor
  }
  return static_cast<std::int64_t>(std::clamp(quotient, -kLimit, kLimit));
}

/// A float32 depth in [0, 1] on the scale of unorm vertex depths, for the plane, which is fixed point
/// throughout.
std::uint32_t fixed_of_float(std::uint32_t bits) {
  return static_cast<std::uint32_t>(std::nearbyint(std::ldexp(std::bit_cast<float>(bits), kVertexDepthBits)));
}

void make_plane(const std::array<ScreenVertex, 3>& v, const std::array<Edge, 3>& edge, int sub_pixel_bits,
                DepthFormat format, DepthEquation& eq) {
  if (format == DepthFormat::kFloat32) {
    for (std::uint32_t& z : eq.z) {
      z = fixed_of_float(z);
    }
  }
  const std::int64_t dz1 = std::int64_t{eq.z[1]} - eq.z[0];
  const std::int64_t dz2 = std::int64_t{eq.z[2]} - eq.z[0];
  const int pixel = sub_pixel_bits;
  // z = z0 + (dz1 E1 + dz2 E2) / 2A; a step of one pixel changes E_i by a_i << sub_pixel_bits
  const auto slope = [&](std::int64_t step1, std::int64_t step2) {
    const Int128 numerator = Int128{dz1} * step1 + Int128{dz2} * step2;
    return saturated_quotient(numerator * (Int128{1} << (kPlaneFraction + pixel)), eq.area2);
  };
  eq.dx = slope(edge[1].a, edge[2].a);
  eq.dy = slope(edge[1].b, edge[2].b);
  eq.x = v[0].x >> pixel;
  eq.y = v[0].y >> pixel;
  const auto at_origin = [&](std::size_t i) {
    return edge[i].c + eq.bias[i] +
           ((std::int64_t{edge[i].a} * eq.x + std::int64_t{edge[i].b} * eq.y) << pixel);
  };
  const Int128 rise = Int128{dz1} * at_origin(1) + Int128{dz2} * at_origin(2);
  const std::int64_t z0 = std::int64_t{eq.z[0]} << kPlaneFraction;
  eq.origin = z0 + saturated_quotient(rise * (Int128{1} << kPlaneFraction), eq.area2);
}

/// A non-negative number m * 2^exponent whose m has its top bit at bit 31, or is 0. Lower bits are cut off.
struct Normalised {
  std::uint64_t m = 0;
  int exponent = 0;
};

Normalised normalise(std::uint64_t value, int exponent) {
  if (value == 0) {
    return {};
  }
  const int shift = 32 - std::bit_width(value);
  return {shift >= 0 ? value << shift : value >> -shift, exponent - shift};
}

/// A non-negative float32 as an integer times 2^exponent.
struct FloatParts {
  std::uint32_t mantissa;
  int exponent;
};

FloatParts split(std::uint32_t bits) {
  const int field = static_cast<int>(bits >> 23);
  const std::uint32_t fraction = bits & 0x7FFFFFu;
  return field == 0 ? FloatParts{fraction, -149} : FloatParts{fraction | 0x800000u, field - 150};
}

/// The float32 nearest to m * 2^exponent, halves upwards. The value is at most about 1.
std::uint32_t float_bits(std::uint64_t m, int exponent) {
  if (m == 0) {
    return 0;
  }
  const int width = std::bit_width(m);
  // cut to 24 bits, or to fewer where the float is subnormal: its last place is never below 2^-149
  const int cut = std::max(width - 24, -149 - exponent);
  if (cut > width) {
    return 0;
  }
  // one bit more than is kept, plus one, halved: m may fill all 64 bits, so nothing can be added to it
  const std::uint64_t rounded = cut <= 0 ? m << -cut : ((m >> (cut - 1)) + 1) >> 1;
  const int place = exponent + cut;
  // Adding the mantissa with its hidden bit to a field that is one too low carries correctly, also after
  // rounding up to the next power of two and for subnormals, whose hidden bit is absent.
  return static_cast<std::uint32_t>((static_cast<std::uint64_t>(place + 149) << 23) + rounded);
}

}  // namespace

void make_depth_equation(const std::array<ScreenVertex, 3>& v, const std::array<Edge, 3>& edge,
                         std::int64_t area2, int sub_pixel_bits, DepthFormat format,
                         DepthInterpolator interpolator, DepthEquation& out) {
  out.z = {v[0].z, v[1].z, v[2].z};
  out.area2 = area2;
  const auto [z_min, z_max] = std::minmax({v[0].z, v[1].z, v[2].z});
  out.min_code = stored_code(format, z_min);
  out.max_code = stored_code(format, z_max);
  if (interpolator == DepthInterpolator::kPlane) {
    make_plane(v, edge, sub_pixel_bits, format, out);
    return;
  }
  out.shift = static_cast<std::int8_t>(std::bit_width(static_cast<std::uint64_t>(area2)) - 32);
  constexpr std::uint64_t kOne = (std::uint64_t{1} << 63) - 1;
  const std::uint64_t scaled = scale_weight(out, area2);  // 2^31 to 2^32 - 1, since area2 > 0
  out.reciprocal = static_cast<std::uint32_t>(kOne / std::max<std::uint64_t>(scaled, 1));
}

std::uint32_t barycentric_float(const DepthEquation& eq, std::int64_t e1, std::int64_t e2) {
  const std::array<std::int64_t, 3> e{eq.area2 - e1 - e2, e1, e2};
  std::array<std::uint64_t, 3> product{};
  std::array<int, 3> exponent{};
  int top = -1000;  // below every exponent that can occur
  for (std::size_t i = 0; i < 3; ++i) {
    const Normalised w = normalise(static_cast<std::uint64_t>(e[i]), 0);
    const FloatParts z = split(eq.z[i]);
    product[i] = w.m * z.mantissa;
    exponent[i] = w.exponent + z.exponent;
    if (product[i] != 0) {
      top = std::max(top, exponent[i]);
    }
  }
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const int shift = top - exponent[i];
    sum += product[i] != 0 && shift < 64 ? product[i] >> shift : 0;
  }
  // sum * 2^top / 2A, where 1 / 2A is reciprocal * 2^-63 * 2^-shift
  const Normalised s = normalise(sum, top);
  const std::uint32_t bits = float_bits(s.m * eq.reciprocal, s.exponent - 63 - eq.shift);
  return std::clamp(bits, eq.min_code, eq.max_code);
}

std::uint32_t plane_code(const DepthEquation& eq, DepthFormat format, std::int32_t x, std::int32_t y) {
  const std::int64_t z = eq.origin + eq.dx * (x - eq.x) + eq.dy * (y - eq.y);
  if (format == DepthFormat::kFloat32) {
    const auto fixed = static_cast<double>(std::max<std::int64_t>(z, 0));
    const auto depth = static_cast<float>(std::ldexp(fixed, -kVertexDepthBits - kPlaneFraction));
    return std::clamp(std::bit_cast<std::uint32_t>(depth), eq.min_code, eq.max_code);
  }
  const int below = vertex_depth_fraction(format) + kPlaneFraction;
  const std::int64_t code = (z + (std::int64_t{1} << (below - 1))) >> below;
  return static_cast<std::uint32_t>(std::clamp<std::int64_t>(code, eq.min_code, eq.max_code));
}

}  // namespace halfspace
