/// The front end: from clip-space triangles to triangles on the sub-pixel grid.
///
/// Clips in homogeneous coordinates against near, far and the guard band, divides, applies the viewport,
/// snaps to nearest even, and finds the polygon offset of the snapped triangle. In double precision: what
/// reaches setup is the correctly rounded position up to a few units of 2^-53. Rules: Vulkan 1.3
/// specification, sections 25.4, 25.7 and 25.11.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "halfspace/numerics/depth.hpp"
#include "halfspace/scene/clip.hpp"
#include "halfspace/scene/depth_by_sample.hpp"
#include "halfspace/scene/frame.hpp"
#include "halfspace/units/counters.hpp"
#include "halfspace/units/packets.hpp"

namespace halfspace {

/// The front end of one draw.
class FrontEnd {
 public:
  /// `format` is that of the surface the draw tests against; none leaves z at 0. `centres`: a pixel has one
  /// sample, at its centre; else no depth is resolved sample by sample (depth_by_sample.hpp).
  FrontEnd(const Frame& frame, const Command& draw, DepthFormat format, int sub_pixel_bits,
           bool centres = true);

  /// Window z is z / w * scale + bias, and lies between least and most.
  struct Depth {
    double scale;
    double bias;
    double least;
    double most;
  };
  [[nodiscard]] Depth depth() const { return {z_scale_, z_bias_, z_least_, z_most_}; }
  [[nodiscard]] bool clips_depth() const { return !depth_clamp_; }

  /// Appends what triangle `index` of the draw becomes. Throws InputError where a vertex is so far outside
  /// the depth range that only its samples one by one have a depth, and they are not at the centres.
  void process(std::uint32_t index, std::vector<ScreenTriangle>& out, FrontEndCounters& counters) const;

 private:
  using Clip = glm::dvec4;
  using Window = glm::dvec3;

  [[nodiscard]] Window to_window(const Clip& v) const;
  void emit_fan(const Polygon<Window>& polygon, std::uint32_t index, std::vector<ScreenTriangle>& out,
                FrontEndCounters& counters) const;
  void emit(const std::array<Window, 3>& corner, double offset_unit, std::uint32_t index,
            std::vector<ScreenTriangle>& out, FrontEndCounters& counters) const;
  [[nodiscard]] double offset_unit(const Polygon<Window>& polygon) const;
  [[nodiscard]] double offset_of(const ScreenTriangle& snapped, const std::array<double, 3>& z,
                                 double offset_unit) const;

  const Frame& frame_;
  const Command& draw_;
  DepthFormat format_;
  int sub_pixel_bits_;
  bool centres_;
  double sub_pixels_;
  PixelRect screen_;  ///< the target
  bool depth_clamp_;
  bool polygon_offset_;
  double z_scale_;  ///< window z = z / w * scale + bias
  double z_bias_;
  double z_least_;  ///< the depth range
  double z_most_;
  double far_;                                ///< vertex depths and offsets of this magnitude or more are far
  bool unrestricted_;                         ///< see Command
  DepthRange limits_{.least = 0, .most = 1};  ///< fragments are kept within these
  std::array<Clip, 6> planes_;                ///< inside: dot(plane, v) >= 0
  std::size_t plane_count_ = 0;
};

}  // namespace halfspace
