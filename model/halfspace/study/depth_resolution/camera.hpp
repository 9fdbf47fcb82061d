/// What a vertex shader does to a position, in float32: the experiment of N. Reed, "Depth Precision
/// Visualized", 2015 (https://gist.github.com/Reedbeta/ae437a9acb5dc137eabf), after P. Upchurch and M.
/// Desbrun, "Tightening the Precision of Perspective Rendering", Journal of Graphics Tools 16 (1), 2012.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string_view>
#include <vector>

namespace halfspace::study {

enum class Projection : std::uint8_t {
  kStandard,          ///< depth 0 near, 1 far
  kInfinite,          ///< the same without a far plane
  kReversed,          ///< depth 1 near, 0 far
  kReversedInfinite,  ///< the same without a far plane
  kGlStandard,        ///< -w <= z <= w, so depth is z/w / 2 + 1/2
  kGlInfinite,
};
inline constexpr std::array kProjectionNames{"standard",          "infinite",    "reversed",
                                             "reversed infinite", "GL standard", "GL infinite"};
inline constexpr std::size_t kProjections = kProjectionNames.size();

[[nodiscard]] constexpr bool is_reversed(Projection projection) {
  return projection == Projection::kReversed || projection == Projection::kReversedInfinite;
}
[[nodiscard]] constexpr bool is_gl(Projection projection) { return projection >= Projection::kGlStandard; }

enum class Transform : std::uint8_t {
  kProjectionOnly,      ///< the position is in view space
  kViewThenProjection,  ///< a matrix each
  kPrecomposed,         ///< their product, rounded to float32
  kPrecomposedInPairs,  ///< the same; of four products it adds the first two, the last two, and these
};
inline constexpr std::array kTransformNames{"projection only", "view, then projection", "both in one matrix",
                                            "both in one, sums in pairs"};

struct Planes {
  double near;
  double far;
};

/// From positions in view space, which are exact, to clip space.
class Camera {
 public:
  Camera(const Planes& planes, Projection projection, Transform transform);

  /// x and y of clip space are those of view space.
  [[nodiscard]] glm::vec4 clip(const glm::dvec3& view) const;

 private:
  Transform transform_;
  glm::dmat4 world_from_view_;  ///< positions reach the shader in world space, as float32
  glm::mat4 view_from_world_;
  glm::mat4 clip_from_view_;
  glm::mat4 clip_from_world_;
};

/// `pairs` + 1 distances from near to far, at equal steps.
std::vector<double> equal_steps(const Planes& planes, std::size_t pairs);

/// Pairs of distances, one behind the other: the logarithm of the first is uniform between near and far, that
/// of the second's relative distance from it between 2^-20 and 2^-8.
std::vector<double> random_pairs(const Planes& planes, std::size_t pairs);

/// What became of the pairs of neighbours.
struct Confusion {
  std::size_t pairs = 0;
  std::size_t equal = 0;    ///< indistinguishable
  std::size_t swapped = 0;  ///< the farther one in front

  [[nodiscard]] double equal_percent() const {
    return 100.0 * static_cast<double>(equal) / static_cast<double>(pairs);
  }
  [[nodiscard]] double swapped_percent() const {
    return 100.0 * static_cast<double>(swapped) / static_cast<double>(pairs);
  }
};

/// `depths`: of distances, in anything that compares. Pairs begin at every `step`th, and the second is
/// farther.
template <class Depth>
Confusion confusion(const std::vector<Depth>& depths, Projection projection, std::size_t step = 1) {
  Confusion result;
  for (std::size_t i = 0; i + 1 < depths.size(); i += step) {
    const bool falls = depths[i + 1] < depths[i];
    const bool equal = depths[i + 1] == depths[i];
    ++result.pairs;
    result.equal += equal ? 1 : 0;
    result.swapped += !equal && falls != is_reversed(projection) ? 1 : 0;
  }
  return result;
}

}  // namespace halfspace::study
