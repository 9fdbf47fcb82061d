#include "halfspace/scene/mesh_camera.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "halfspace/numerics/error.hpp"
#include "halfspace/scene/quote.hpp"

namespace halfspace {
namespace {

/// What a camera of the file lets be seen: 1 / its half width and half height, at distance 1 if it is a
/// perspective, widened to the picture's aspect ratio: glTF 2.0, 3.10.3, neither crops nor stretches.
glm::dvec2 fit_to_picture(glm::dvec2 half_size, double picture_aspect) {
  const double aspect = std::abs(half_size.x / half_size.y);
  if (picture_aspect > aspect) half_size.x *= picture_aspect / aspect;
  if (picture_aspect < aspect) half_size.y *= aspect / picture_aspect;
  return 1.0 / half_size;
}

/// The matrices of glTF 2.0, 3.10.3.
glm::dmat4 projection_of(const MeshCamera& camera, double picture_aspect) {
  const double near = camera.near;
  glm::dmat4 matrix(0);
  if (camera.fov_y) {
    const double tan_y = std::tan(*camera.fov_y / 2);
    const glm::dvec2 scale =
        fit_to_picture({tan_y * camera.aspect.value_or(picture_aspect), tan_y}, picture_aspect);
    matrix[0][0] = scale.x;
    matrix[1][1] = scale.y;
    matrix[2][2] = camera.far ? (*camera.far + near) / (near - *camera.far) : -1;
    matrix[3][2] = camera.far ? 2 * *camera.far * near / (near - *camera.far) : -2 * near;
    matrix[2][3] = -1;
    return matrix;
  }
  const glm::dvec2 scale = fit_to_picture(camera.half_size, picture_aspect);
  matrix[0][0] = scale.x;
  matrix[1][1] = scale.y;
  matrix[2][2] = 2 / (near - *camera.far);
  matrix[3][2] = (*camera.far + near) / (near - *camera.far);
  matrix[3][3] = 1;
  return matrix;
}

void check_mesh_camera(const MeshCamera& camera, std::string_view name) {
  const auto check = [&](bool is_legal, std::string_view what, double value, std::string_view legal) {
    if (!is_legal) {
      throw InputError(
          fmt::format("{}: camera {}: {} is {}; legal: {}", name, quote(camera.name), what, value, legal));
    }
  };
  if (camera.fov_y) {
    check(*camera.fov_y > 0 && *camera.fov_y < glm::pi<double>(), "yfov", *camera.fov_y,
          "above 0 and below pi");
    const double aspect = camera.aspect.value_or(1);
    check(aspect > 0 && std::isfinite(aspect), "aspectRatio", aspect, "above 0");
    check(camera.near > 0, "znear", camera.near, "above 0");
  } else {
    check(camera.half_size.x != 0 && std::isfinite(camera.half_size.x), "xmag", camera.half_size.x, "not 0");
    check(camera.half_size.y != 0 && std::isfinite(camera.half_size.y), "ymag", camera.half_size.y, "not 0");
    check(camera.near >= 0, "znear", camera.near, "0 or more");
    if (!camera.far) check(false, "zfar", 0, "above znear");
  }
  if (camera.far)
    check(*camera.far > camera.near, "zfar", *camera.far, fmt::format("above znear, {}", camera.near));
  for (int column = 1; column < 4; ++column) {
    const glm::dvec3 axis(camera.world[column]);
    if (!is_finite(axis) || (column < 3 && axis == glm::dvec3(0))) {
      throw InputError(fmt::format("{}: camera {}: {} is {}; legal: finite numbers{}", name,
                                   quote(camera.name), column == 3 ? "its place" : "an axis",
                                   fmt::format("({}, {}, {})", axis.x, axis.y, axis.z),
                                   column == 3 ? "" : ", not all 0"));
    }
  }
}

/// The camera by its name, else by its number.
const MeshCamera& find_camera(const Mesh& mesh, const std::string& wanted, std::string_view name) {
  const MeshCamera* found = nullptr;
  std::string all;
  std::string same;  // numbers
  constexpr std::size_t kShown = 20;
  for (std::size_t i = 0; i < mesh.cameras.size(); ++i) {
    if (i < kShown) all += fmt::format("{}{} {}", all.empty() ? "" : ", ", i, quote(mesh.cameras[i].name));
    if (mesh.cameras[i].name != wanted) continue;
    found = &mesh.cameras[i];
    if (same.size() < 100) same += fmt::format("{}{}", same.empty() ? "" : ", ", i);
  }
  if (mesh.cameras.size() > kShown) all += fmt::format(" and so on to {}", mesh.cameras.size() - 1);
  if (same.find(',') != std::string::npos) {
    throw OptionError(fmt::format("{}: camera is {}, the name of several; legal: a number of {}", name,
                                  quote(wanted), same));
  }
  std::size_t number = 0;
  const char* const end = wanted.data() + wanted.size();
  const auto [last, error] = std::from_chars(wanted.data(), end, number);
  if (found == nullptr && error == std::errc{} && last == end && number < mesh.cameras.size()) {
    found = &mesh.cameras[number];
  }
  if (found == nullptr) {
    throw OptionError(fmt::format("{}: camera is {}; legal: {}", name, quote(wanted),
                                  all.empty() ? "none, since the file has no cameras" : all));
  }
  return *found;
}

}  // namespace

View view_of_mesh_camera(const Mesh& mesh, const std::string& wanted, double picture_aspect,
                         std::span<const glm::dvec3> points, std::string_view name) {
  const MeshCamera& camera = find_camera(mesh, wanted, name);
  check_mesh_camera(camera, name);
  const glm::dvec3 eye(camera.world[3]);
  const glm::dvec3 backward = glm::normalize(glm::dvec3(camera.world[2]));  // scaling is ignored
  const glm::dvec3 up = glm::normalize(glm::dvec3(camera.world[1]));
  if (std::abs(glm::dot(up, backward)) > 1 - 1e-12) {
    throw InputError(fmt::format("{}: camera {}: its y and z axis are parallel; legal: two directions", name,
                                 quote(camera.name)));
  }
  if (std::ranges::all_of(points, [&](glm::dvec3 p) { return glm::dot(eye - p, backward) <= 0; })) {
    throw InputError(fmt::format("{}: camera {} has the whole mesh behind it; legal: some in front", name,
                                 quote(camera.name)));
  }
  return {eye, projection_of(camera, picture_aspect) * glm::lookAtRH(glm::dvec3(0), -backward, up)};
}

}  // namespace halfspace
