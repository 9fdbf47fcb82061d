/// The depth that a triangle's fragments ought to have, exact: the plane through its vertices, the polygon
/// offset of the specification, the clamp to [0, 1]. In integers, because a rational number has to be reduced
/// for each sample.
#pragma once

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "families.hpp"
#include "halfspace/numerics/depth.hpp"

namespace halfspace::testing {

class ExactPlane {
 public:
  ExactPlane(const Sample& sample, DepthFormat format) : format_(format) {
    const auto& p = sample.xy;
    std::array<mpz_class, 3> a;  // of the edge opposite to a vertex: its change for a sub-pixel
    std::array<mpz_class, 3> b;
    mpz_class area2 = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& from = p[(i + 1) % 3];
      const auto& to = p[(i + 2) % 3];
      a[i] = from[1] - to[1];
      b[i] = to[0] - from[0];
      area2 += -a[i] * from[0] - b[i] * from[1];
    }
    const int sign = sgn(area2);
    area2_ = abs(area2);
    one_ = area2_ << kScale;
    for (std::size_t i = 0; i < 3; ++i) {
      const mpz_class z = scaled(mpq_class(sample.z[i]));
      const auto& from = p[(i + 1) % 3];
      origin_ += sign * z * (-a[i] * from[0] - b[i] * from[1]);
      dx_ += sign * z * a[i];
      dy_ += sign * z * b[i];
    }
    if (sgn(area2_) != 0 && (sample.state.flags & bits({Flag::kPolygonOffset})) != 0) {
      offset_ = offset_of(sample);
      origin_ += scaled(offset_ * area2_);
    }
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
  };
  [[nodiscard]] Error error(std::int64_t x, std::int64_t y, std::uint32_t code) const {
    const mpz_class exact = std::clamp<mpz_class>(origin_ + dx_ * x + dy_ * y, 0, one_);
    const double depth = exact.get_d() / one_.get_d();
    if (format_ == DepthFormat::kFloat32) {
      const double stored = std::bit_cast<float>(code);
      const mpz_class off = scaled(mpq_class(stored)) * area2_ - exact;
      // A depth just below a power of two may have been rounded to it.
      const int exponent = std::max(depth == 0 ? -126 : std::ilogb(depth * (1 - 0x1p-52)), -126);
      const double unit = std::ldexp(1.0, exponent - 23);
      return {depth, unit, std::abs(off.get_d()) / one_.get_d() / unit};
    }
    const std::uint32_t most = max_unorm_code(format_);
    const mpz_class off = one_ * code - exact * most;
    return {depth, 1.0 / most, std::abs(off.get_d()) / one_.get_d()};
  }

 private:
  // Of depth and numerator; no depth of float32 has bits below 2^-149.
  static constexpr unsigned kScale = 200;

  static mpz_class scaled(const mpq_class& value) {
    return mpz_class((value.get_num() << kScale) / value.get_den());
  }

  [[nodiscard]] mpq_class offset_of(const Sample& sample) const {
    mpq_class slope(std::max<mpz_class>(abs(dx_), abs(dy_)) * 256, one_);
    slope.canonicalize();
    const float z_max = std::max({sample.z[0], sample.z[1], sample.z[2]});
    const mpq_class unit = format_ != DepthFormat::kFloat32 ? mpq_class(1) / max_unorm_code(format_)
                           : z_max == 0                     ? mpq_class(0)
                                        : mpq_class(std::ldexp(1.0, std::ilogb(z_max) - 23));
    const Command& state = sample.state;
    const mpq_class offset = slope * mpq_class(state.offset_factor) + unit * mpq_class(state.offset_units);
    return state.offset_clamp > 0   ? std::min<mpq_class>(offset, mpq_class(state.offset_clamp))
           : state.offset_clamp < 0 ? std::max<mpq_class>(offset, mpq_class(state.offset_clamp))
                                    : offset;
  }

  DepthFormat format_;
  mpz_class area2_;
  mpz_class one_;         ///< depth 1
  mpz_class origin_ = 0;  ///< at (0, 0)
  mpz_class dx_ = 0;      ///< for a sub-pixel
  mpz_class dy_ = 0;
  mpq_class offset_ = 0;
};

}  // namespace halfspace::testing
