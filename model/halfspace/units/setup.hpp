/// setup: from a snapped triangle to edge equations, bounds and a depth equation, or to the reason it is
/// dropped.
///
/// Edge functions with the fill rule folded into the constant: J. Pineda, "A Parallel Algorithm for Polygon
/// Rasterization", SIGGRAPH 1988.
#pragma once

#include "halfspace/numerics/conservative.hpp"
#include "halfspace/numerics/depth.hpp"
#include "halfspace/numerics/fill_rule.hpp"
#include "halfspace/numerics/line_rule.hpp"
#include "halfspace/numerics/sample_pattern.hpp"
#include "halfspace/units/depth_interpolator.hpp"
#include "halfspace/units/packets.hpp"

namespace halfspace {

/// The state of a draw that setup looks at.
struct SetupState {
  int sub_pixel_bits = 8;  ///< 4 to 8
  bool front_positive_area = false;
  bool cull_front = false;
  bool cull_back = false;
  FillRule fill_rule = FillRule::kTopLeft;
  Conservative conservative =
      Conservative::kOff;                         ///< not off: edges own the pixels whose squares end on them
  int square_reach = 0;                           ///< as conservative.hpp has it
  bool inner_coverage = false;                    ///< early_z needs 2A, also without a depth surface
  PixelRect bounds;                               ///< scissor, viewport and target, in pixels
  DepthFormat depth_format = DepthFormat::kNone;  ///< none: no depth equation is made
  DepthLimits limits{};
  DepthInterpolator interpolator = DepthInterpolator::kPlane;
  bool hi_z = false;                          ///< make HiZPlane too, where the interpolator has a plane
  LineRule line_rule = LineRule::kBresenham;  ///< of thin lines
  int line_width = 1;                         ///< of thin lines, in fragments
  SampleBox samples{};                        ///< of a pixel
};

enum class SetupVerdict : std::uint8_t {
  kDrawn,
  kZeroArea,
  kCulled,    ///< faces away
  kNoSample,  ///< its bounding box holds no sample: no pixel has one whose box of samples it meets
  kOutside,   ///< its bounding box misses scissor, viewport or target
};

/// The pixels whose box of samples meets the closed bounding box of the triangle, grown by `reach` sub-pixels
/// on each side: of one sample at the centre, those whose centres lie in it. Every pixel with a covered
/// sample is among them.
PixelRect sample_bounds(const std::array<ScreenVertex, 3>& v, int sub_pixel_bits, int reach = 0,
                        const SampleBox& samples = {});

/// Twice the signed area, positive clockwise on the screen.
std::int64_t twice_signed_area(const std::array<ScreenVertex, 3>& v);

/// The edge opposite to vertex i of a triangle of positive area, without a fill rule: E / 2A is the vertex's
/// weight.
Edge edge_opposite(const std::array<ScreenVertex, 3>& v, std::size_t i, int sub_pixel_bits);

/// Fills `out` when the verdict is kDrawn. Thin lines go through line_setup(). Vertices must be inside the
/// guard band (16 + sub_pixel_bits signed bits). A triangle without area faces back, and has pixels where
/// they are outer ones, all with the depth of its first vertex. Neither the order of the vertices nor which
/// one comes first changes what is drawn or its depth.
SetupVerdict setup(const ScreenTriangle& in, const SetupState& state, SetupTriangle& out);

}  // namespace halfspace
