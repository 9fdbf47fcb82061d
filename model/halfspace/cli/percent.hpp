/// Shares for people.
#pragma once

#include <algorithm>
#include <cstdint>

namespace halfspace {

/// 0 of nothing.
inline double percent(std::uint64_t part, std::uint64_t whole) {
  return 100.0 * static_cast<double>(part) / static_cast<double>(std::max<std::uint64_t>(whole, 1));
}

}  // namespace halfspace
