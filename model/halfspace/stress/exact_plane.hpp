/// The depth that a triangle's fragments ought to have, exact: the plane through its vertices, the polygon
/// offset of the specification, the clamp to [0, 1]. In integers, because a rational number has to be reduced
/// for each sample.
#pragma once

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "halfspace/numerics/depth.hpp"
#include "halfspace/reference/exact_triangle.hpp"
#include "halfspace/scene/frame.hpp"

namespace halfspace::stress {

class ExactPlane {
 public:
  /// `state`: polygon offset of the draw.
  ExactPlane(const reference::GridTriangle& p, const std::array<float, 3>& z, const Command& state,
             DepthFormat format, int sub_pixel_bits)
      : format_(format), one_pixel_(1L << sub_pixel_bits) {
    std::array<mpz_class, 3> a;  // of the edge opposite to a vertex: its change for a sub-pixel
    std::array<mpz_class, 3> b;
    mpz_class area2 = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& from = p[(i + 1) % 3];
      const auto& to = p[(i + 2) % 3];
      a[i] = from.y - to.y;
      b[i] = to.x - from.x;
      area2 += -a[i] * from.x - b[i] * from.y;
    }
    const int sign = sgn(area2);
    area2_ = abs(area2);
    one_ = area2_ << kScale;
    for (std::size_t i = 0; i < 3; ++i) {
      const mpz_class depth = scaled(mpq_class(z[i]));
      const auto& from = p[(i + 1) % 3];
      origin_ += sign * depth * (-a[i] * from.x - b[i] * from.y);
      dx_ += sign * depth * a[i];
      dy_ += sign * depth * b[i];
    }
    if (has_area() && state.has(Flag::kPolygonOffset)) {
      offset_ = offset_of(std::max({std::abs(z[0]), std::abs(z[1]), std::abs(z[2])}), state);
      origin_ += scaled(offset_ * area2_);
    }
    const auto [least, most] = std::minmax({z[0], z[1], z[2]});
    least_ = with_offset(least);
    most_ = with_offset(most);
  }

  [[nodiscard]] bool has_area() const { return sgn(area2_) != 0; }

  /// Magnitude of what polygon offset adds.
  [[nodiscard]] double offset() const { return std::abs(offset_.get_d()); }

  /// The exact depth at a position in sub-pixels, and how far a stored code is from it, in the unit of its
  /// last place.
  struct Error {
    double depth;
    double unit;
    double ulps;
    double beyond;  ///< how far it is outside the range of the vertices, in the same unit
  };
  /// `kept`: depth is kept within the range of the vertices, where the plane leaves it outside the triangle.
  [[nodiscard]] Error error(std::int64_t x, std::int64_t y, std::uint32_t code, bool kept = false) const {
    const mpz_class zero = 0;
    const mpz_class exact =
        std::clamp<mpz_class>(origin_ + dx_ * x + dy_ * y, kept ? least_ : zero, kept ? most_ : one_);
    const double depth = exact.get_d() / one_.get_d();
    // A depth just below a power of two may have been rounded to it.
    const int exponent = std::max(depth == 0 ? -126 : std::ilogb(depth * (1 - 0x1p-52)), -126);
    const std::uint32_t most = format_ == DepthFormat::kFloat32 ? 1 : max_unorm_code(format_);
    const double unit = format_ == DepthFormat::kFloat32 ? std::ldexp(1.0, exponent - 23) : 1.0 / most;
    const mpz_class stored = format_ == DepthFormat::kFloat32
                                 ? mpz_class(scaled(mpq_class(std::bit_cast<float>(code))) * area2_)
                                 : mpz_class(one_ * code);
    const auto ulps = [&](const mpz_class& off) { return off.get_d() / one_.get_d() / most / unit; };
    return {.depth = depth,
            .unit = unit,
            .ulps = std::abs(ulps(stored - exact * most)),
            .beyond = std::max({ulps(least_ * most - stored), ulps(stored - most_ * most), 0.0})};
  }

 private:
  // Of depth and numerator; no depth of float32 has bits below 2^-149.
  static constexpr unsigned kScale = 200;

  static mpz_class scaled(const mpq_class& value) {
    return mpz_class((value.get_num() << kScale) / value.get_den());
  }

  /// A vertex's depth with the offset, as a numerator over one_.
  [[nodiscard]] mpz_class with_offset(float z) const {
    return std::clamp<mpz_class>(scaled((mpq_class(z) + offset_) * area2_), 0, one_);
  }

  /// On a float32 surface a unit is that of the largest exponent of the triangle's depths: Vulkan 1.3
  /// specification, "Depth Bias Computation".
  [[nodiscard]] mpq_class offset_of(float z_max, const Command& state) const {
    mpq_class slope(std::max<mpz_class>(abs(dx_), abs(dy_)) * one_pixel_, one_);
    slope.canonicalize();
    const mpq_class unit = format_ != DepthFormat::kFloat32 ? mpq_class(1) / max_unorm_code(format_)
                           : z_max == 0                     ? mpq_class(0)
                                        : mpq_class(std::ldexp(1.0, std::ilogb(z_max) - 23));
    const mpq_class offset = slope * mpq_class(state.offset_factor) + unit * mpq_class(state.offset_units);
    return state.offset_clamp > 0   ? std::min<mpq_class>(offset, mpq_class(state.offset_clamp))
           : state.offset_clamp < 0 ? std::max<mpq_class>(offset, mpq_class(state.offset_clamp))
                                    : offset;
  }

  DepthFormat format_;
  long one_pixel_;
  mpz_class area2_;
  mpz_class one_;         ///< depth 1
  mpz_class origin_ = 0;  ///< at (0, 0)
  mpz_class dx_ = 0;      ///< for a sub-pixel
  mpz_class dy_ = 0;
  mpq_class offset_ = 0;
  mpz_class least_;  ///< of the vertices
  mpz_class most_;
};

}  // namespace halfspace::stress
