/// What a what-if saves: the work of a frame as it is, and as it was changed.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "halfspace/run/run_result.hpp"
#include "halfspace/scene/frame.hpp"
#include "halfspace/whatif/what_if.hpp"

namespace halfspace {

/// The work of a frame that a what-if may change.
struct Work {
  std::uint64_t triangles = 0;  ///< that the front end took
  std::uint64_t fragments = 0;  ///< covered
  std::uint64_t shaded = 0;     ///< passed the depth test in a draw that shades (whatif/draw_ranges.hpp)
  std::uint64_t read = 0;       ///< bytes between the z cache and memory
  std::uint64_t written = 0;
  std::optional<std::uint64_t> cycles;  ///< where the fidelity has time
};

[[nodiscard]] Work work_of(const Frame& frame, const RunResult& result);

struct WhatIfReport {
  std::vector<whatif::Applied> applied;
  Work without;
  Work with;
};

struct WhatIfRow {
  std::string_view name;
  std::string_view help;
  std::uint64_t without = 0;
  std::uint64_t with = 0;

  /// with / without; none where `without` is 0.
  [[nodiscard]] std::optional<double> ratio() const;
};

[[nodiscard]] std::vector<WhatIfRow> rows(const WhatIfReport& report);

}  // namespace halfspace
