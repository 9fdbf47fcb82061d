/// The yardstick of `bench speed`: the loop of the textbooks. For each triangle it walks the bounding box row
/// by row, adds up three integer edge functions, and tests and writes float32 depth, which is a plane. It has
/// no tiles, no hierarchy and no SIMD, and shares no code with the units.
/// The front end of the machine comes before it.
///
/// It covers exactly the samples that the units cover. Its depth is a plane in single precision, whose
/// rounding lets some fragments pass or fail that pass or fail otherwise in the units.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "halfspace/config/config.hpp"
#include "halfspace/numerics/fill_rule.hpp"
#include "halfspace/scene/frame.hpp"
#include "halfspace/units/packets.hpp"

namespace halfspace {

/// What the front end made of a triangle.
struct ScalarTriangle {
  std::array<std::int32_t, 3> x{};  ///< window coordinates in 1/2^sub_pixel_bits pixel, y down
  std::array<std::int32_t, 3> y{};
  std::array<float, 3> z{};  ///< polygon offset added
  PixelRect within;          ///< the pixels that are drawn
};

/// A draw and its state, a clear of a rectangle, which is drawn, or a clear of a whole surface.
struct ScalarDraw {
  std::uint32_t surface = kNoSurface;
  bool clears = false;  ///< the whole surface, to `least`; no triangles
  bool counts = true;   ///< its fragments count; those of a clear do not
  bool test = false;    ///< off: every fragment passes and none is written
  bool write = false;
  DepthFunc func = DepthFunc::kAlways;
  float least = 0;  ///< depth is kept within least..most
  float most = 1;
  bool front_positive_area = false;
  bool cull_front = false;
  bool cull_back = false;
  FillRule fill_rule = FillRule::kTopLeft;
  std::vector<ScalarTriangle> triangles;
};

struct ScalarCounts {
  std::uint64_t fragments = 0;
  std::uint64_t survivors = 0;
};

/// A frame behind the front end, and the depth surfaces to draw it on.
class ScalarLoop {
 public:
  /// Runs the front end on `frame`, which must be valid, with the sub-pixel bits of `config`.
  ScalarLoop(const Frame& frame, const Config& config);

  /// Fills the surfaces as the clears before the first draw leave them. The time of draw() does not hold
  /// this.
  void clear();
  /// Draws the rest of the frame: set-up, walk, test and write; and clears between draws. Returns the
  /// fragments that passed.
  std::uint64_t draw();
  /// clear() and draw(), and counts fragments too.
  ScalarCounts count();

 private:
  struct Image {
    std::int32_t width = 0;
    std::int32_t height = 0;
    std::vector<float> depth;
  };

  template <bool CountFragments>
  ScalarCounts draw_all();

  int sub_pixel_bits_;
  std::vector<ScalarDraw> draws_;
  std::size_t first_draw_ = 0;  ///< the clears before it are not timed
  std::vector<Image> surfaces_;
};

}  // namespace halfspace
