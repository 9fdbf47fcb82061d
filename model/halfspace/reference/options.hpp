/// How a frame is drawn.
#pragma once

#include <optional>
#include <string_view>

#include "halfspace/reference/tie_rule.hpp"

namespace halfspace::reference {

/// What a draw does whose shader may change the outcome of the depth test after it ran: one that may discard,
/// writes depth, has side effects or feeds alpha to coverage, unless the program forces early tests.
enum class LateZ {
  kOpaque,   ///< it tests and writes early, like any other
  kNoWrite,  ///< it tests early, and does not write
};

/// Which pixels a triangle has.
enum class Pixels {
  kCentres,  ///< whose centres it covers
  kTouched,  ///< that have a point of it
  kFilled,   ///< that lie in it
};

struct Options {
  std::string_view method = "exact";           ///< one of methods(); anything else throws InputError
  std::optional<TieRule> rule = std::nullopt;  ///< of all draws; none: that of each draw
  int subpixel_bits = 8;                       ///< 4 to 8; anything else throws InputError
  LateZ late_z = LateZ::kOpaque;
  Pixels pixels =
      Pixels::kCentres;  ///< another only with the method `exact`; anything else throws InputError
  int uncertainty = 0;   ///< of touched and filled pixels: how much larger than a pixel its square is on each
                         ///< side, in sub-pixels
  double guard_band = 32;  ///< times the clip volume, in x and in y
  double window_limit =
      32767;  ///< pixels each way from the window origin; tightens the guard band where needed
  bool float32_depth =
      true;  ///< a fragment's depth is rounded to float32 before a unorm format rounds it again
};

}  // namespace halfspace::reference
