/// The front end: from clip-space triangles to triangles on the sub-pixel grid.
///
/// Clips in homogeneous coordinates against near, far and the guard band, divides, applies the viewport,
/// polygon offset and depth clamp, and snaps to nearest even. In double precision: what reaches setup is the
/// correctly rounded position up to a few units of 2^-53. Rules: Vulkan 1.3 specification,
/// sections 25.4, 25.7 and 25.11.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "halfspace/numerics/depth.hpp"
#include "halfspace/scene/clip.hpp"
#include "halfspace/scene/frame.hpp"
#include "halfspace/units/counters.hpp"
#include "halfspace/units/packets.hpp"

namespace halfspace {

/// The front end of one draw.
class FrontEnd {
 public:
  /// `format` is that of the surface the draw tests against; none leaves z at 0.
  FrontEnd(const Frame& frame, const Command& draw, DepthFormat format, int sub_pixel_bits);

  /// Appends what triangle `index` of the draw becomes.
  void process(std::uint32_t index, std::vector<ScreenTriangle>& out, FrontEndCounters& counters) const;

 private:
  using Clip = glm::dvec4;
  using Window = glm::dvec3;

  [[nodiscard]] Window to_window(const Clip& v) const;
  [[nodiscard]] double offset_of(const Polygon<Window>& polygon) const;
  void emit_within_depth_range(const Polygon<Window>& polygon, std::uint32_t index,
                               std::vector<ScreenTriangle>& out, FrontEndCounters& counters) const;
  void emit_fan(const Polygon<Window>& polygon, std::uint32_t index, std::vector<ScreenTriangle>& out,
                FrontEndCounters& counters) const;
  [[nodiscard]] ScreenVertex snap(const Window& v) const;

  const Frame& frame_;
  const Command& draw_;
  DepthFormat format_;
  double sub_pixels_;
  bool depth_clamp_;
  bool polygon_offset_;
  double z_scale_;  ///< window z = z / w * scale + bias
  double z_bias_;
  double z_least_;  ///< depth is clamped to this range
  double z_most_;
  std::array<Clip, 6> planes_;  ///< inside: dot(plane, v) >= 0
  std::size_t plane_count_ = 0;
};

}  // namespace halfspace
