/// setup: from a snapped triangle to edge equations, bounds and a depth equation, or to the reason it is
/// dropped.
///
/// Edge functions with the fill rule folded into the constant: J. Pineda, "A Parallel Algorithm for Polygon
/// Rasterization", SIGGRAPH 1988.
#pragma once

#include "halfspace/numerics/depth.hpp"
#include "halfspace/numerics/fill_rule.hpp"
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
  PixelRect bounds;                               ///< scissor, viewport and target, in pixels
  DepthFormat depth_format = DepthFormat::kNone;  ///< none: no depth equation is made
  DepthLimits limits{};
  DepthInterpolator interpolator = DepthInterpolator::kPlane;
  bool hi_z = false;    ///< make HiZPlane too, where the interpolator has a plane
  SampleBox samples{};  ///< of a pixel
};

enum class SetupVerdict : std::uint8_t {
  kDrawn,
  kZeroArea,
  kCulled,    ///< faces away
  kNoSample,  ///< its bounding box holds no sample: no pixel has one whose box of samples it meets
  kOutside,   ///< its bounding box misses scissor, viewport or target
};

/// The pixels whose box of samples meets the closed bounding box of the triangle: of one sample at the
/// centre, those whose centres lie in it. Every pixel with a covered sample is among them.
PixelRect sample_bounds(const std::array<ScreenVertex, 3>& v, int sub_pixel_bits,
                        const SampleBox& samples = {});

/// Fills `out` when the verdict is kDrawn. Vertices must be inside the guard band (16 + sub_pixel_bits signed
/// bits). Neither the order of the vertices nor which one comes first changes what is drawn or its depth.
SetupVerdict setup(const ScreenTriangle& in, const SetupState& state, SetupTriangle& out);

}  // namespace halfspace
