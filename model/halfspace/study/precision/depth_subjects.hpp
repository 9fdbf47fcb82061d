/// The arithmetics of depth as a table.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "halfspace/numerics/depth.hpp"
#include "halfspace/study/precision/depth_triangle.hpp"

namespace halfspace::study {

/// The stored code at a covered pixel.
using DepthAt = std::function<std::uint32_t(std::int64_t x, std::int64_t y)>;

struct DepthSubject {
  std::string name;
  std::string computes;
  std::string kind;     ///< plane or barycentric
  int bits = 0;         ///< of a word below 1, or of the reciprocal; 0: of floating point
  bool unit = false;    ///< of the machine, front end and all; the others are arithmetic alone
  bool unorm = true;    ///< whether it takes the unorm formats
  bool float32 = true;  ///< whether it takes float32
  /// `size` of the target, a power of two.
  std::function<DepthAt(const DepthTriangle& triangle, DepthFormat format, std::uint32_t size)> prepare;

  [[nodiscard]] bool takes(DepthFormat format) const {
    return format == DepthFormat::kFloat32 ? float32 : unorm;
  }
};

[[nodiscard]] const std::vector<DepthSubject>& depth_subjects();

}  // namespace halfspace::study
