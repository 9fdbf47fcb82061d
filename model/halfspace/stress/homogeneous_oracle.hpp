/// Coverage of a triangle in clip space by exact arithmetic, without clipping, division or snapping: where no
/// rounding of these can matter.
///
/// A point of the screen, (x, y, 1) in units of w, is a combination of the vertices' (x, y, w) with weights
/// that are linear in x and y. It is inside if no weight is negative, and seen if z of the combination lies
/// in 0 to 1: M. Olano and T. Greer, "Triangle Scan Conversion using 2D Homogeneous Coordinates", 1997.
#pragma once

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <glm/vec4.hpp>
#include <vector>

#include "halfspace/numerics/sample_pattern.hpp"

namespace halfspace::stress {

enum class Certainty : std::uint8_t { kOutside, kInside, kUncertain };

class HomogeneousTriangle {
 public:
  /// On a square target of `size` pixels. Coordinates must be finite. A vertex's depth is z / w, of 0 to 1.
  HomogeneousTriangle(const std::array<glm::vec4, 3>& vertices, std::uint32_t size, int sub_pixel_bits);

  /// Of a sample of pixel (x, y), and of all points within two sub-pixels of it in x and in y.
  [[nodiscard]] Certainty covers(std::uint32_t x, std::uint32_t y, const SamplePosition& sample = {}) const;

 private:
  /// a x + b y + c in 1/256 pixel; `reach` is what it changes within two sub-pixels each way.
  struct Linear {
    mpz_class a;
    mpz_class b;
    mpz_class c;
    mpz_class reach;
  };
  std::vector<Linear> sides_;  ///< none negative: inside
};

}  // namespace halfspace::stress
