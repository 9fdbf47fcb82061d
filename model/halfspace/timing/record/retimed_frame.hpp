#pragma once

#include <cstdint>
#include <vector>

namespace halfspace {

/// What a record takes on a machine.
struct RetimedFrame {
  std::uint64_t cycles = 0;
  std::vector<std::uint64_t> draw_end;  ///< by draw, as DrawCycles::end

  friend bool operator==(const RetimedFrame&, const RetimedFrame&) = default;
};

}  // namespace halfspace
