#include "halfspace/timing/record/calibrate.hpp"

#include <algorithm>
#include <cstddef>

namespace halfspace {
namespace {

/// Part of the mean diagonal that is added to it: counts that go together have no sharp solution.
constexpr double kRidge = 1e-4;
constexpr double kMostFactor = 5;

using Matrix = std::array<StretchCounts, kStretchCounts>;

/// Solves a x = b for a symmetric, positive definite a, by a = l l^T without roots.
StretchCounts solve(Matrix a, StretchCounts b) {
  for (std::size_t i = 0; i < kStretchCounts; ++i) {
    for (std::size_t row = i + 1; row < kStretchCounts; ++row) {
      const double factor = a[row][i] / a[i][i];
      for (std::size_t k = i; k < kStretchCounts; ++k) {
        a[row][k] -= factor * a[i][k];
      }
      b[row] -= factor * b[i];
    }
  }
  for (std::size_t i = kStretchCounts; i-- > 0;) {
    for (std::size_t k = i + 1; k < kStretchCounts; ++k) {
      b[i] -= a[i][k] * b[k];
    }
    b[i] /= a[i][i];
  }
  return b;
}

}  // namespace

std::vector<double> calibrate(std::span<const double> weights, std::span<const StretchCounts> counts,
                              const StretchCounts& totals) {
  // in parts of the totals, so that all counts matter alike
  std::vector<StretchCounts> parts(counts.begin(), counts.end());
  for (StretchCounts& part : parts) {
    for (std::size_t i = 0; i < kStretchCounts; ++i) {
      part[i] = totals[i] == 0 ? 0 : part[i] / totals[i];
    }
  }
  Matrix a{};
  StretchCounts missing{};
  double trace = 0;
  for (std::size_t i = 0; i < kStretchCounts; ++i) {
    missing[i] = totals[i] == 0 ? 0 : 1;
    for (std::size_t s = 0; s < parts.size(); ++s) {
      missing[i] -= weights[s] * parts[s][i];
      for (std::size_t k = 0; k < kStretchCounts; ++k) {
        a[i][k] += weights[s] * parts[s][i] * parts[s][k];
      }
    }
    trace += a[i][i];
  }
  for (std::size_t i = 0; i < kStretchCounts; ++i) {
    a[i][i] += kRidge * trace / static_cast<double>(kStretchCounts);
  }
  std::vector<double> result(weights.begin(), weights.end());
  if (trace == 0) {
    return result;
  }
  const StretchCounts slope = solve(a, missing);
  for (std::size_t s = 0; s < parts.size(); ++s) {
    double factor = 1;
    for (std::size_t i = 0; i < kStretchCounts; ++i) {
      factor += slope[i] * parts[s][i];
    }
    result[s] *= std::clamp(factor, 1 / kMostFactor, kMostFactor);
  }
  return result;
}

}  // namespace halfspace
