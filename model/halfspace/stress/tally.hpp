/// What the stress campaign counts.
#pragma once

#include <cstdint>

namespace halfspace::stress {

// clang-format off
/// COUNT(name, is_error, meaning)
#define HALFSPACE_STRESS_TALLY(COUNT)                                                                        \
  COUNT(cases,        false, "frames drawn")                                                                 \
  COUNT(triangles,    false, "of these frames")                                                              \
  COUNT(samples,      false, "pairs of a triangle and a sample in its box, and samples judged without triangles") \
  COUNT(missing,      true,  "fragments that are not there: gaps, where triangles tile the plane")           \
  COUNT(extra,        true,  "fragments too many: doubles, where triangles tile the plane")                  \
  COUNT(moved,        true,  "pixels that differ in a frame that must give the same picture")                \
  COUNT(decisions,    false, "tiles rejected or accepted that were judged")                                  \
  COUNT(unsound,      true,  "tiles rejected with a covered sample, or accepted with one that is not")       \
  COUNT(tested,       false, "pixels whose survivors were judged")                                           \
  COUNT(mistested,    true,  "pixels with another number of survivors")                                      \
  COUNT(depths,       false, "depths judged")                                                                \
  COUNT(inexact,      true,  "depths beyond their bound")                                                    \
  COUNT(out_of_range, true,  "depths outside those of the triangle's vertices")                              \
  COUNT(failed,       true,  "frames that were not drawn: an error, or no result")
// clang-format on

struct Tally {
#define FIELD(name, is_error, meaning) std::uint64_t name = 0;  ///< meaning
  HALFSPACE_STRESS_TALLY(FIELD)
#undef FIELD
  double worst_ulps = 0;   ///< of depth, in units of the last place
  double worst_share = 0;  ///< of a depth's bound

  Tally& operator+=(const Tally& other) {
#define FIELD(name, is_error, meaning) name += other.name;
    HALFSPACE_STRESS_TALLY(FIELD)
#undef FIELD
    worst_ulps = worst_ulps > other.worst_ulps ? worst_ulps : other.worst_ulps;
    worst_share = worst_share > other.worst_share ? worst_share : other.worst_share;
    return *this;
  }

  /// Of all kinds.
  [[nodiscard]] std::uint64_t errors() const {
    std::uint64_t sum = 0;
#define FIELD(name, is_error, meaning) sum += is_error ? name : 0;
    HALFSPACE_STRESS_TALLY(FIELD)
#undef FIELD
    return sum;
  }
};

}  // namespace halfspace::stress
