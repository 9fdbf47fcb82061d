/// The front end: from clip-space triangles, lines and points to triangles and thin lines on the sub-pixel
/// grid.
///
/// Clips in homogeneous coordinates against near, far and the guard band, divides, applies the viewport,
/// snaps to nearest even, and finds the polygon offset of the snapped triangle. In double precision: what
/// reaches setup is the correctly rounded position up to a few units of 2^-53. Rules: Vulkan 1.3
/// specification, sections 25.4, 25.7 and 25.11. Lines and points: docs/guides/lines.md.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "halfspace/numerics/depth.hpp"
#include "halfspace/numerics/fill_rule.hpp"
#include "halfspace/scene/clip.hpp"
#include "halfspace/scene/depth_by_sample.hpp"
#include "halfspace/scene/frame.hpp"
#include "halfspace/units/counters.hpp"
#include "halfspace/units/packets.hpp"
#include "halfspace/units/thin_line.hpp"

namespace halfspace {

/// The front end of one draw.
class FrontEnd {
 public:
  /// `format` is that of the surface the draw tests against; none leaves z at 0. `rule`: which sides of a
  /// point own the centres on them. `square_reach`: as numerics/conservative.hpp has it. `centres`: a pixel
  /// has one sample, at its centre; else no depth is resolved sample by sample (depth_by_sample.hpp).
  FrontEnd(const Frame& frame, const Command& draw, DepthFormat format, int sub_pixel_bits, FillRule rule,
           int square_reach = 0, bool centres = true);
  /// With the rule of the draw.
  FrontEnd(const Frame& frame, const Command& draw, DepthFormat format, int sub_pixel_bits);

  /// Window z is z / w * scale + bias, and lies between least and most.
  struct Depth {
    double scale;
    double bias;
    double least;
    double most;
  };
  [[nodiscard]] Depth depth() const { return {z_scale_, z_bias_, z_least_, z_most_}; }
  [[nodiscard]] bool clips_depth() const { return !depth_clamp_; }

  /// A corner of what clipping leaves of a triangle, and the weights of the triangle's vertices in it.
  struct Corner {
    glm::dvec4 clip{0};
    glm::dvec3 weights{0};

    friend Corner operator*(const Corner& a, double factor) {
      return {.clip = a.clip * factor, .weights = a.weights * factor};
    }
    friend Corner operator-(const Corner& a, const Corner& b) {
      return {.clip = a.clip - b.clip, .weights = a.weights - b.weights};
    }
    friend Corner operator/(const Corner& a, double divisor) {
      return {.clip = a.clip / divisor, .weights = a.weights / divisor};
    }
  };

  /// The corners that process() clips triangle `index` to, in the order of its fan: triangle n of the fan has
  /// corners 0, n + 1 and n + 2. Fewer than three, or one with w not above 0, where process() appends none.
  [[nodiscard]] Polygon<Corner> corners(std::uint32_t index) const;

  /// Appends what primitive `index` of the draw becomes. Throws InputError where a vertex is so far outside
  /// the depth range that only its samples one by one have a depth, and they are not at the centres.
  void process(std::uint32_t index, std::vector<ScreenTriangle>& out, FrontEndCounters& counters) const;

 private:
  using Clip = glm::dvec4;
  using Window = glm::dvec3;

  /// What the lines of a primitive have in common.
  struct Outline {
    std::uint32_t index;         ///< of the primitive
    double offset = 0;           ///< polygon offset
    bool positive_area = true;   ///< which way round its triangles are
    std::uint64_t stippled = 0;  ///< the stipple counter
  };
  struct Segment {
    Window a;
    Window b;
  };

  /// Null where it is not finite, which is counted.
  [[nodiscard]] bool read(std::uint32_t at, Clip& vertex, FrontEndCounters& counters) const;
  void add_planes();
  void process_triangle(std::uint32_t index, std::vector<ScreenTriangle>& out,
                        FrontEndCounters& counters) const;
  void process_line(std::uint32_t index, std::vector<ScreenTriangle>& out, FrontEndCounters& counters) const;
  void process_point(std::uint32_t index, std::vector<ScreenTriangle>& out, FrontEndCounters& counters) const;
  /// The part of a line inside the planes; nothing where there is none, which is counted.
  [[nodiscard]] bool clip_line(std::uint32_t index, Segment& segment, FrontEndCounters& counters) const;
  void count_stipple();
  [[nodiscard]] std::uint64_t fragments_long(const Segment& segment) const;
  [[nodiscard]] LinePoint snap(const Window& v) const;
  void emit_outline(const Polygon<Window>& polygon, double offset_unit, std::uint32_t index,
                    std::vector<ScreenTriangle>& out, FrontEndCounters& counters) const;
  void emit_line(const Segment& segment, Outline& outline, std::vector<ScreenTriangle>& out,
                 FrontEndCounters& counters) const;
  void emit_rectangles(const Segment& segment, const Outline& outline, std::vector<ScreenTriangle>& out,
                       FrontEndCounters& counters) const;
  void emit_rectangle(const std::array<LinePoint, 2>& ends, const std::array<double, 2>& z,
                      const LinePoint& side, const Outline& outline, std::vector<ScreenTriangle>& out,
                      FrontEndCounters& counters) const;
  void emit_thin(const Segment& segment, const Outline& outline, std::vector<ScreenTriangle>& out,
                 FrontEndCounters& counters) const;
  void emit_thin_part(ScreenTriangle line, std::array<double, 2> z, double offset,
                      std::vector<ScreenTriangle>& out, FrontEndCounters& counters) const;
  void emit_point(const Window& centre, const Outline& outline, std::vector<ScreenTriangle>& out,
                  FrontEndCounters& counters) const;
  [[nodiscard]] bool is_far(double depth) const { return !(std::abs(depth) < far_); }
  /// The depths and the offset as a packet holds them, or in pieces.
  void emit_snapped(ScreenTriangle triangle, std::array<double, 3> z, double offset,
                    std::vector<ScreenTriangle>& out, FrontEndCounters& counters) const;

  /// Whether any plane cut the polygon.
  template <class Vertex, class Position>
  bool clip_to_planes(Polygon<Vertex>& polygon, const Position& position) const;
  [[nodiscard]] Window to_window(const Clip& v) const;
  void emit_fan(const Polygon<Window>& polygon, std::uint32_t index, std::vector<ScreenTriangle>& out,
                FrontEndCounters& counters) const;
  void emit(const std::array<Window, 3>& corner, double offset_unit, std::uint32_t index,
            std::vector<ScreenTriangle>& out, FrontEndCounters& counters) const;
  [[nodiscard]] const glm::vec4& vertex(std::uint32_t index, std::uint32_t corner) const;
  [[nodiscard]] double offset_unit(const Polygon<Window>& polygon) const;
  [[nodiscard]] double offset_of(const ScreenTriangle& snapped, const std::array<double, 3>& z,
                                 double offset_unit) const;

  const Frame& frame_;
  const Command& draw_;
  DepthFormat format_;
  int sub_pixel_bits_;
  int square_reach_;
  FillRule rule_;
  bool centres_;
  double guard_band_;  ///< pixels to each side of the origin of the window
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
  std::vector<std::uint64_t> stippled_;  ///< by line of a stippled strip: the stipple counter at its start
};

}  // namespace halfspace
