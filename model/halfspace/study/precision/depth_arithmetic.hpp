/// The arithmetics of depth that the study compares. Each is made of a triangle and a format, and gives the
/// stored code at a covered pixel.
#pragma once

#include <array>
#include <cstdint>

#include "halfspace/numerics/depth.hpp"
#include "halfspace/reference/window.hpp"
#include "halfspace/study/precision/depth_triangle.hpp"
#include "halfspace/units/float_parts.hpp"
#include "halfspace/units/packets.hpp"

namespace halfspace::study {

/// A range of stored codes.
struct CodeRange {
  std::uint32_t least = 0;
  std::uint32_t most = 0;
};

/// The plane through the vertices, in float32 from the gradients to the code. Codes are kept in [0, 1] only.
class FloatPlane {
 public:
  FloatPlane(const DepthTriangle& t, DepthFormat format);
  [[nodiscard]] std::uint32_t code(std::int64_t x, std::int64_t y) const;

 private:
  DepthFormat format_;
  float x0_;
  float y0_;
  float z0_;
  float dx_;
  float dy_;
};

/// The same in double.
class DoublePlane {
 public:
  DoublePlane(const DepthTriangle& t, DepthFormat format);
  [[nodiscard]] std::uint32_t code(std::int64_t x, std::int64_t y) const;

 private:
  DepthFormat format_;
  reference::DepthPlane plane_;
};

/// The plane in words of fixed point, modulo a power of two, as the unit depth_plane has it, for any number
/// of bits below 1. On float32 surfaces 1 is the power of two above the largest vertex depth.
class WordPlane {
 public:
  /// `bits`: those of a unorm code at least; at most 40 there, and 63 on float32 surfaces.
  WordPlane(const DepthTriangle& t, DepthFormat format, int bits);
  [[nodiscard]] std::uint32_t code(std::int64_t x, std::int64_t y) const;

  /// What samples are computed from.
  struct Equation {
    std::array<std::int64_t, 2> from{};  ///< vertex 0, in sub-pixels
    std::int64_t z = 0;                  ///< its word
    Modular dx = 0;                      ///< for a sub-pixel, kGradientFraction bits below the word
    Modular dy = 0;
    CodeRange range{};
  };
  [[nodiscard]] const Equation& equation() const { return eq_; }

 private:
  DepthFormat format_;
  int bits_;
  int exponent_ = 0;
  Equation eq_;
};

/// Weights of the vertices by one reciprocal of the area, as the unit depth_barycentric has it, for any width
/// of the reciprocal.
class Barycentric {
 public:
  /// `width`: 8 to 36.
  Barycentric(const DepthTriangle& t, DepthFormat format, int width);
  [[nodiscard]] std::uint32_t code(std::int64_t x, std::int64_t y) const;

  /// On the scale on which twice the area has `width` bits.
  [[nodiscard]] Int128 scaled(std::int64_t e) const {
    return shift_ >= 0 ? Int128{e} >> shift_ : Int128{e} << -shift_;
  }
  [[nodiscard]] Int128 reciprocal() const { return reciprocal_; }
  [[nodiscard]] const std::array<std::int64_t, 3>& z() const { return z_; }
  [[nodiscard]] const CodeRange& range() const { return range_; }

 private:
  [[nodiscard]] std::uint32_t unorm(const std::array<std::int64_t, 3>& e) const;
  [[nodiscard]] std::uint32_t float32(const std::array<std::int64_t, 3>& e) const;

  DepthTriangle triangle_;
  DepthFormat format_;
  int width_;
  int shift_;
  Int128 reciprocal_;
  std::array<std::int64_t, 3> z_{};  ///< as setup takes them
  CodeRange range_;
};

}  // namespace halfspace::study
