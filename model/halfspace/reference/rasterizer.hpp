/// A textbook rasterizer: a whole frame, one triangle after the other. Slow and plain on purpose: it shares
/// no code with the units. How a triangle becomes fragments is exchangeable (methods.hpp); `exact` is what
/// the units are compared with.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "halfspace/reference/clip.hpp"
#include "halfspace/reference/methods.hpp"
#include "halfspace/reference/options.hpp"
#include "halfspace/scene/frame.hpp"

namespace halfspace::reference {

/// What happened to the triangles of a draw or a depth surface. A triangle is counted once, even if clipping
/// cuts it into several pieces: non_finite + clipped_away + degenerate + culled + drawn = triangles.
struct Counters {
  std::uint64_t triangles = 0;     ///< in the draws, before anything
  std::uint64_t non_finite = 0;    ///< dropped: a coordinate is infinite or not a number
  std::uint64_t clipped_away = 0;  ///< nothing is left inside the clip volume and the guard band
  std::uint64_t degenerate = 0;    ///< no area after snapping
  std::uint64_t culled = 0;        ///< faces the culled way
  std::uint64_t drawn = 0;         ///< the others, whether they cover a sample or not
  std::uint64_t covered_fragments = 0;
  std::uint64_t depth_tested = 0;
  std::uint64_t depth_passed = 0;  ///< with those that are not tested
  std::uint64_t depth_written = 0;
  std::uint64_t quads = 0;       ///< aligned 2x2 blocks with a covered pixel, for each piece of a triangle
  std::uint64_t full_quads = 0;  ///< of these, those with four
  std::uint64_t helper_fragments = 0;  ///< pixels of these blocks that are not covered

  Counters& operator+=(const Counters& other);
};

/// A depth surface after the frame, or a target without one that a draw draws to. Arrays are row by row, row
/// 0 on top. Depth that is never cleared starts at 1.
struct Surface {
  std::uint32_t index = 0;  ///< Target::depth_surface; behind the largest, one by one, targets without one
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint32_t> codes;  ///< depth as stored, see depth_code.hpp; empty where there is none
  std::vector<float> depth;          ///< the same as numbers
  std::vector<std::uint16_t>
      fragments;  ///< fragments that covered the pixel; stays at 65535 when it gets there
  std::vector<std::uint16_t> survivors;  ///< of these, the ones that passed the depth test
  std::vector<Color> colors;  ///< of the fragment that passed last; empty where the method has no colours
  Counters counters;
};

/// An aligned block of 2x2 pixels of which a piece of a triangle covers at least one.
struct Quad {
  std::uint32_t x = 0;  ///< top left pixel
  std::uint32_t y = 0;
  std::uint8_t mask = 0;    ///< covered: bit 0 (x, y), 1 (x + 1, y), 2 (x, y + 1), 3 (x + 1, y + 1)
  std::uint8_t passed = 0;  ///< the same bits after the depth test
  std::array<std::uint32_t, 4> depth{};  ///< codes; 0 where not covered
};

/// Sees what is drawn, in order.
class Observer {
 public:
  virtual ~Observer() = default;
  /// The quads of one piece of a triangle, row by row; draws and triangles of a draw count from 0.
  virtual void piece(std::uint32_t /*draw*/, std::uint32_t /*triangle*/, std::span<const Quad> /*quads*/) {}
  virtual void draw_done(std::uint32_t /*draw*/, const Counters& /*of_draw*/) {}
};

/// All surfaces of `frame` after its last command, by index. Throws InputError where the frame contradicts
/// itself.
[[nodiscard]] std::vector<Surface> rasterize(const Frame& frame, const Options& options,
                                             Observer* observer = nullptr);

/// The same by a method that need not be one of methods(); `options.method` is not looked at.
[[nodiscard]] std::vector<Surface> rasterize(const Frame& frame, const Options& options, const Method& method,
                                             Observer* observer = nullptr);

}  // namespace halfspace::reference
