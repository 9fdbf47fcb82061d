/// The textbook rasterizer: a whole frame, one triangle after the other, one pixel after the other. Slow and
/// plain on purpose: it shares no code with the units and is what they are compared with.
#pragma once

#include <cstdint>
#include <vector>

#include "halfspace/scene/frame.hpp"

namespace halfspace::reference {

/// What a draw does whose shader may change the outcome of the depth test after it ran: one that may discard,
/// writes depth, has side effects or feeds alpha to coverage, unless the program forces early tests.
enum class LateZ {
  kOpaque,   ///< it tests and writes early, like any other
  kNoWrite,  ///< it tests early, and does not write
};

struct Options {
  int subpixel_bits = 8;  ///< 4 to 8; anything else throws InputError
  LateZ late_z = LateZ::kOpaque;
  double guard_band = 32;  ///< times the clip volume, in x and in y
  double window_limit =
      32767;  ///< pixels each way from the window origin; tightens the guard band where needed
  bool float32_depth =
      true;  ///< a fragment's depth is rounded to float32 before a unorm format rounds it again
};

/// What happened to the triangles of one depth surface. A triangle is counted once, even if clipping cuts it
/// into several pieces: non_finite + clipped_away + degenerate + culled + drawn = triangles.
struct Counters {
  std::uint64_t triangles = 0;     ///< in the draws, before anything
  std::uint64_t non_finite = 0;    ///< dropped: a coordinate is infinite or not a number
  std::uint64_t clipped_away = 0;  ///< nothing is left inside the clip volume and the guard band
  std::uint64_t degenerate = 0;    ///< no area after snapping
  std::uint64_t culled = 0;        ///< faces the culled way
  std::uint64_t drawn = 0;         ///< the others, whether they cover a sample or not
  std::uint64_t covered_fragments = 0;
  std::uint64_t depth_passed = 0;
  std::uint64_t quads = 0;  ///< aligned 2x2 blocks with a covered pixel, for each piece of a triangle
  std::uint64_t helper_fragments = 0;  ///< pixels of these blocks that are not covered
};

/// A depth surface after the frame. Arrays are row by row, row 0 on top. A surface that is never cleared
/// starts at 1.
struct Surface {
  std::uint32_t index = 0;  ///< Target::depth_surface
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint32_t> codes;  ///< depth as stored, see depth_code.hpp
  std::vector<float> depth;          ///< the same in [0,1]
  std::vector<std::uint16_t>
      fragments;  ///< fragments that covered the pixel; stays at 65535 when it gets there
  std::vector<std::uint16_t> survivors;  ///< of these, the ones that passed the depth test
  Counters counters;
};

/// All depth surfaces of `frame` after its last command, by index. Draws without one leave no trace.
/// Throws InputError where the frame contradicts itself.
[[nodiscard]] std::vector<Surface> rasterize(const Frame& frame, const Options& options);

}  // namespace halfspace::reference
