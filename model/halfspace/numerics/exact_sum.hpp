/// Sums and products of doubles without an error of rounding.
///
/// J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates",
/// Discrete & Computational Geometry 18, 1997, sections 2.2 to 2.5.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace halfspace {

/// What is exact of products: factors of at most 2^500 that are multiples of 2^-537, so that no product
/// overflows and none loses bits below the least double.
inline constexpr int kGreatestFactorLog2 = 500;

/// The rounding error of sum = a + b, itself a double.
inline double error_of_sum(double a, double b, double sum) {
  const double b_part = sum - a;
  return (a - (sum - b_part)) + (b - b_part);
}

/// The rounding error of product = a * b, itself a double.
inline double error_of_product(double a, double b, double product) { return std::fma(a, b, -product); }

/// The most parts that a sum of any doubles can have: each has a bit of its own.
inline constexpr std::size_t kMostParts = 2098;

/// A sum in parts that do not overlap, the least first. There is room for `kMost`: as many as terms, or
/// kMostParts.
template <std::size_t kMost>
class ExactSum {
 public:
  void add(double term) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      const double sum = term + parts_[i];
      const double error = error_of_sum(term, parts_[i], sum);
      if (error != 0) parts_[kept++] = error;
      term = sum;
    }
    if (term != 0) parts_[kept++] = term;
    count_ = kept;
  }

  void add_product(double a, double b) {
    const double product = a * b;
    add(error_of_product(a, b, product));
    add(product);
  }

  /// 1, 0 or -1: the greatest part outweighs the others together.
  [[nodiscard]] int sign() const { return count_ == 0 ? 0 : parts_[count_ - 1] > 0 ? 1 : -1; }

  [[nodiscard]] double rounded() const {
    double sum = 0;
    for (std::size_t i = count_; i-- > 0;) sum += parts_[i];
    return sum;
  }

 private:
  std::array<double, kMost> parts_;
  std::size_t count_ = 0;
};

}  // namespace halfspace
