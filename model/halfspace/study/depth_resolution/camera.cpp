#include "halfspace/study/depth_resolution/camera.hpp"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "halfspace/numerics/split_mix.hpp"

namespace halfspace::study {
namespace {

/// z of clip space is scale times z of view space plus bias; w is z of view space.
struct DepthRow {
  double scale;
  double bias;
};

DepthRow depth_row(const Planes& planes, Projection projection) {
  const auto [near, far] = planes;
  switch (projection) {
    case Projection::kStandard:
      return {far / (far - near), -near * far / (far - near)};
    case Projection::kInfinite:
      return {1, -near};
    case Projection::kReversed:
      return {-near / (far - near), far * near / (far - near)};
    case Projection::kReversedInfinite:
      return {0, near};
    case Projection::kGlStandard:
      return {(far + near) / (far - near), -2 * near * far / (far - near)};
    default:
      return {1, -2 * near};
  }
}

/// No product and sum are fused (-ffp-contract=off).
glm::vec4 transformed(const glm::mat4& m, const glm::vec4& v, bool in_pairs) {
  glm::vec4 result;
  for (int row = 0; row < 4; ++row) {
    const float x = m[0][row] * v.x;
    const float y = m[1][row] * v.y;
    const float z = m[2][row] * v.z;
    const float w = m[3][row] * v.w;
    result[row] = in_pairs ? (x + y) + (z + w) : ((x + y) + z) + w;
  }
  return result;
}

}  // namespace

Camera::Camera(const Planes& planes, Projection projection, Transform transform) : transform_(transform) {
  const DepthRow row = depth_row(planes, projection);
  clip_from_view_ = glm::mat4(1);
  clip_from_view_[2] = {0, 0, static_cast<float>(row.scale), 1};
  clip_from_view_[3] = {0, 0, static_cast<float>(row.bias), 0};
  // Any camera will do: this one is Reed's.
  world_from_view_ = glm::translate(glm::dmat4(1), glm::dvec3(14.9914, 0.832148, 29.7142128));
  world_from_view_ = glm::rotate(world_from_view_, -1.23123123, glm::dvec3(0, 1, 0));
  world_from_view_ = glm::rotate(world_from_view_, 0.474747, glm::dvec3(1, 0, 0));
  view_from_world_ = glm::mat4(glm::inverse(world_from_view_));
  for (int column = 0; column < 4; ++column) {
    clip_from_world_[column] =
        transformed(clip_from_view_, view_from_world_[column], transform == Transform::kPrecomposedInPairs);
  }
}

glm::vec4 Camera::clip(const glm::dvec3& view) const {
  if (transform_ == Transform::kProjectionOnly) {
    return transformed(clip_from_view_, glm::vec4(glm::dvec4(view, 1)), false);
  }
  const glm::vec4 world(world_from_view_ * glm::dvec4(view, 1));
  if (transform_ == Transform::kViewThenProjection) {
    return transformed(clip_from_view_, transformed(view_from_world_, world, false), false);
  }
  return transformed(clip_from_world_, world, transform_ == Transform::kPrecomposedInPairs);
}

std::vector<double> equal_steps(const Planes& planes, std::size_t pairs) {
  std::vector<double> result;
  for (std::size_t i = 0; i <= pairs; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(pairs);
    result.push_back(planes.near + (planes.far - planes.near) * part);
  }
  return result;
}

std::vector<double> random_pairs(const Planes& planes, std::size_t pairs) {
  SplitMix64 random(1);
  std::vector<double> result;
  for (std::size_t i = 0; i < pairs; ++i) {
    const double first = std::exp(random.real(std::log(planes.near), std::log(planes.far)));
    const double apart = std::exp2(random.real(-20, -8));
    result.push_back(first);
    result.push_back(first * (1 + apart));
  }
  return result;
}

}  // namespace halfspace::study
