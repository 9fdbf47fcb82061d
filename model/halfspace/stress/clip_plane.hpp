/// A plane seen in perspective, for scenes that clipping cuts: which pixels must show it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "halfspace/stress/case.hpp"

namespace halfspace::stress {

/// A plane in clip space, by the clip coordinates of three points of it.
struct ClipPlane {
  glm::dvec4 at;  ///< (u, v) = (0, 0)
  glm::dvec4 along_u;
  glm::dvec4 along_v;

  [[nodiscard]] glm::dvec4 point(double u, double v) const { return at + u * along_u + v * along_v; }
};

/// What of the plane is at a position of the screen: its point with x = X w and y = Y w, up to a factor.
struct Seen {
  double u;
  double v;
  double w;  ///< 0 or less: behind the eye
  double z;
};

inline Seen see(const ClipPlane& plane, double x, double y) {
  // (x - X w) and (y - Y w) of at + u along_u + v along_v are 0.
  const auto left = [&](const glm::dvec4& p) { return glm::dvec2(p.x - x * p.w, p.y - y * p.w); };
  const glm::dmat2 matrix(left(plane.along_u), left(plane.along_v));
  const glm::dvec2 uv = glm::inverse(matrix) * -left(plane.at);
  const glm::dvec4 point = plane.point(uv.x, uv.y);
  return {uv.x, uv.y, point.w, point.z / point.w};
}

/// Fragments of each pixel of a square target that a mesh on the plane ought to give: once where |u| and |v|
/// are below `least`, none where one is above `most` or clipping leaves nothing. kUncertain unless the pixels
/// around agree, and on the same reason: a border of the mesh or of the clip volume is near.
inline std::vector<std::int32_t> fragments_of(const ClipPlane& plane, double least, double most,
                                              std::uint32_t size) {
  std::vector<std::int32_t> fragments;
  for (std::uint32_t y = 0; y < size; ++y) {
    for (std::uint32_t x = 0; x < size; ++x) {
      bool inside = true;
      std::array<bool, 7> beyond{true, true, true, true, true, true, true};
      for (const double dy : {-1.0, 0.0, 1.0}) {
        for (const double dx : {-1.0, 0.0, 1.0}) {
          const Seen seen = see(plane, (x + 0.5 + dx) * 2 / size - 1, (y + 0.5 + dy) * 2 / size - 1);
          const bool ahead = seen.w > 1e-3;
          inside &= ahead && seen.z > 1e-4 && seen.z < 1 - 1e-4 && std::abs(seen.u) < least &&
                    std::abs(seen.v) < least;
          const std::array now{seen.w < -1e-3,         seen.z<-1e-4, seen.z> 1 + 1e-4,
                               ahead && seen.u > most, ahead && seen.u < -most,
                               ahead && seen.v > most, ahead && seen.v < -most};
          for (std::size_t i = 0; i < now.size(); ++i) {
            beyond[i] &= now[i];
          }
        }
      }
      const bool outside = std::ranges::find(beyond, true) != beyond.end();
      fragments.push_back(inside ? 1 : outside ? 0 : kUncertain);
    }
  }
  return fragments;
}

}  // namespace halfspace::stress
