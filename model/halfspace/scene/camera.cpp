#include "halfspace/scene/camera.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/ext/quaternion_double.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "halfspace/numerics/error.hpp"
#include "halfspace/scene/mesh_attributes.hpp"
#include "halfspace/scene/mesh_camera.hpp"
#include "halfspace/scene/validate.hpp"

namespace halfspace {
namespace {

const glm::dvec3 kFromFrontRightAbove{0.7, 0.5, 1.0};
constexpr double kFill = 0.9;          // of the half screen, at the vertex that reaches out farthest
constexpr double kDepthMargin = 1e-3;  // relative, of near and far
constexpr double kLeastNearOverFar = 1e-4;
constexpr double kParallel = 0.9999;  // cosine from which a view direction counts as straight up or down
constexpr double kMostParallel = 1 - 1e-12;  // ... and from which a given up tells no direction

std::string to_text(glm::dvec3 p) { return fmt::format("({}, {}, {})", p.x, p.y, p.z); }

void check_camera(const Camera& camera, std::string_view name) {
  if (!(camera.fov_degrees > 0 && camera.fov_degrees < 180)) {
    throw OptionError(
        fmt::format("{}: camera fov is {}; legal: above 0 and below 180 degrees", name, camera.fov_degrees));
  }
  const auto check_size = [&](std::string_view field, std::uint32_t value) {
    if (value < 1 || value > kMaxTargetSize) {
      throw OptionError(
          fmt::format("{}: camera {} is {}; legal: 1 to {} pixels", name, field, value, kMaxTargetSize));
    }
  };
  check_size("width", camera.width);
  check_size("height", camera.height);
  const auto check_point = [&](std::string_view field, const std::optional<glm::dvec3>& point) {
    if (point && !is_finite(*point)) {
      throw OptionError(
          fmt::format("{}: camera {} is {}; legal: finite numbers", name, field, to_text(*point)));
    }
  };
  check_point("eye", camera.eye);
  check_point("at", camera.at);
  check_point("up", camera.up);
  if (camera.up && !(glm::length(*camera.up) > 0)) {
    throw OptionError(
        fmt::format("{}: camera up is {}; legal: a vector that is not 0", name, to_text(*camera.up)));
  }
}

void check_mesh(const Mesh& mesh, std::string_view name) {
  if (mesh.indices.size() > 3 * kMaxMeshTriangles) {
    throw InputError(fmt::format("{}: mesh has {} triangles; legal: at most {}", name,
                                 mesh.indices.size() / 3, kMaxMeshTriangles));
  }
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    if (mesh.indices[i] >= mesh.positions.size()) {
      throw InputError(fmt::format("{}: mesh index {} is {}; legal: below {}", name, i, mesh.indices[i],
                                   mesh.positions.size()));
    }
  }
  for (std::size_t i = 0; i < mesh.parts.size(); ++i) {
    const MeshPart& part = mesh.parts[i];
    const std::uint64_t end = std::uint64_t{part.first_index} + part.index_count;
    if (part.index_count % indices_each(part.primitive) != 0 || end > mesh.indices.size()) {
      throw InputError(fmt::format("{}: mesh part {} is {} indices from {}; legal: whole {} up to {}", name,
                                   i, part.index_count, part.first_index,
                                   part.primitive == Primitive::kTriangles ? "triangles"
                                   : part.primitive == Primitive::kPoints  ? "points"
                                                                           : "lines",
                                   mesh.indices.size()));
    }
  }
}

/// The finite positions that triangles use, once each.
std::vector<glm::dvec3> used_positions(const Mesh& mesh, std::string_view name) {
  std::vector<bool> used(mesh.positions.size());
  for (const std::uint32_t index : mesh.indices) used[index] = true;
  std::vector<glm::dvec3> points;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i] && is_finite(mesh.positions[i])) points.emplace_back(mesh.positions[i]);
  }
  if (points.empty()) {
    throw InputError(fmt::format("{}: mesh has {} triangles and no finite vertex in them; legal: one or more",
                                 name, mesh.indices.size() / 3));
  }
  return points;
}

glm::dvec3 box_center(std::span<const glm::dvec3> points) {
  glm::dvec3 low = points.front();
  glm::dvec3 high = points.front();
  for (const glm::dvec3& p : points) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  return (low + high) / 2.0;
}

glm::dvec3 up_for(const Camera& camera, glm::dvec3 backward) {
  if (camera.up) return glm::normalize(*camera.up);
  return std::abs(backward.y) > kParallel ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0);
}

/// From the front right, a little above, of a mesh whose up is the camera's: y turned there the shortest way.
glm::dvec3 default_backward(const Camera& camera) {
  const glm::dvec3 backward = glm::normalize(kFromFrontRightAbove);
  if (!camera.up) return backward;
  constexpr glm::dvec3 kY{0, 1, 0};
  const glm::dvec3 up = glm::normalize(*camera.up);
  if (up.y < -kParallel) return {-backward.x, -backward.y, backward.z};  // any half turn is the shortest
  return glm::normalize(glm::dquat(1 + glm::dot(kY, up), glm::cross(kY, up))) * backward;
}

/// How far along `backward` the eye must be from `at` to see every point; above 0.
double fitting_distance(std::span<const glm::dvec3> points, glm::dvec3 at, glm::dvec3 backward,
                        glm::dvec3 above, double tan_x, double tan_y) {
  const glm::dvec3 right = glm::normalize(glm::cross(above, backward));
  const glm::dvec3 up = glm::cross(backward, right);
  double distance = 0;
  for (const glm::dvec3& point : points) {
    const glm::dvec3 p = point - at;
    const double across = std::max(std::abs(glm::dot(p, right)) / tan_x, std::abs(glm::dot(p, up)) / tan_y);
    distance = std::max(distance, glm::dot(p, backward) + across / kFill);
  }
  return distance > 0 ? distance * (1 + kDepthMargin) : 1;
}

/// Near and far are around the points.
View view_of(const Camera& camera, std::span<const glm::dvec3> points, std::string_view name) {
  const double fov_y = glm::radians(camera.fov_degrees);
  const double aspect = static_cast<double>(camera.width) / camera.height;
  const double tan_y = std::tan(fov_y / 2);

  const glm::dvec3 at = camera.at ? *camera.at : box_center(points);
  glm::dvec3 eye;
  if (camera.eye) {
    eye = *camera.eye;
  } else {
    const glm::dvec3 backward = default_backward(camera);
    eye = at +
          backward * fitting_distance(points, at, backward, up_for(camera, backward), tan_y * aspect, tan_y);
  }
  const double distance = glm::length(eye - at);
  if (!(distance > 0)) {
    throw OptionError(
        fmt::format("{}: camera eye and at are both {}; legal: two different points", name, to_text(at)));
  }
  const glm::dvec3 backward = (eye - at) / distance;
  const glm::dvec3 up = up_for(camera, backward);
  if (std::abs(glm::dot(up, backward)) > kMostParallel) {
    throw OptionError(fmt::format("{}: camera up {} is along its line of sight; legal: across it", name,
                                  to_text(*camera.up)));
  }

  double nearest = std::numeric_limits<double>::infinity();
  double farthest = -nearest;
  for (const glm::dvec3& point : points) {
    const double depth = glm::dot(eye - point, backward);
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
  }
  if (!(farthest > 0)) {
    throw OptionError(
        fmt::format("{}: camera eye {} looking at {} has the whole mesh behind it; legal: some in front",
                    name, to_text(eye), to_text(at)));
  }
  const double far = farthest * (1 + kDepthMargin);
  const double near = std::max(nearest * (1 - kDepthMargin), far * kLeastNearOverFar);
  return {eye, glm::perspectiveRH_NO(fov_y, aspect, near, far) * glm::lookAtRH(glm::dvec3(0), -backward, up)};
}

glm::vec4 to_clip(const View& view, glm::dvec3 position, std::string_view name) {
  if (!is_finite(position)) return glm::vec4(std::numeric_limits<float>::quiet_NaN());
  const glm::dvec4 clip = view.from_eye * glm::dvec4(position - view.eye, 1);
  constexpr double kMost = std::numeric_limits<float>::max();
  for (int i = 0; i < 4; ++i) {
    if (!(std::abs(clip[i]) <= kMost)) {
      throw InputError(fmt::format("{}: mesh vertex {} is {} in clip space; legal: up to {}", name,
                                   to_text(position), clip[i], kMost));
    }
  }
  return glm::vec4(clip);
}

Command clear_command(const Camera& camera) {
  Command clear;
  clear.kind = CommandKind::kClear;
  clear.flags = static_cast<std::uint32_t>(Flag::kClearColor) | static_cast<std::uint32_t>(Flag::kClearDepth);
  clear.scissor = {0, 0, static_cast<std::int32_t>(camera.width), static_cast<std::int32_t>(camera.height)};
  return clear;
}

Command draw_command(const Camera& camera) {
  Command draw;
  draw.kind = CommandKind::kDraw;
  draw.flags = static_cast<std::uint32_t>(Flag::kDepthTest) | static_cast<std::uint32_t>(Flag::kDepthWrite) |
               static_cast<std::uint32_t>(Flag::kNdcZMinusOneToOne) |
               static_cast<std::uint32_t>(Flag::kColorWrite);
  draw.depth_func = DepthFunc::kLess;
  const auto width = static_cast<float>(camera.width);
  const auto height = static_cast<float>(camera.height);
  draw.viewport = {0, height, width, -height};
  return draw;
}

}  // namespace

Frame frame_from_mesh(const Mesh& mesh, const Camera& camera, std::string_view name) {
  check_camera(camera, name);
  check_mesh(mesh, name);
  const std::vector<glm::dvec3> points = used_positions(mesh, name);
  const double aspect = static_cast<double>(camera.width) / camera.height;
  const View view = camera.of_mesh ? view_of_mesh_camera(mesh, *camera.of_mesh, aspect, points, name)
                                   : view_of(camera, points, name);

  Frame frame;
  frame.name = name;
  frame.left_out = mesh.left_out;
  for (const MeshCamera& c : mesh.cameras) frame.cameras.push_back(c.name);
  frame.targets.push_back({.width = camera.width,
                           .height = camera.height,
                           .samples = 1,
                           .depth_format = DepthFormat::kUnorm24,
                           .color_count = 1,
                           .presented = true,
                           .depth_surface = 0});
  frame.commands.push_back(clear_command(camera));
  frame.indices.reserve(mesh.indices.size());

  // Each draw gets the vertices it uses, in order of first use.
  constexpr std::size_t kNoPart = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> part_of(mesh.positions.size(), kNoPart);
  std::vector<std::uint32_t> vertex_of(mesh.positions.size());
  for (std::size_t i = 0; i < mesh.parts.size(); ++i) {
    const MeshPart& part = mesh.parts[i];
    Command draw = draw_command(camera);
    draw.source_event = static_cast<std::uint32_t>(frame.commands.size());
    draw.first_index = static_cast<std::uint32_t>(frame.indices.size());
    draw.index_count = part.index_count;
    draw.primitive = part.primitive;
    draw.first_vertex = static_cast<std::uint32_t>(frame.vertices.size());
    for (const std::uint32_t index : std::span(mesh.indices).subspan(part.first_index, part.index_count)) {
      if (part_of[index] != i) {
        part_of[index] = i;
        vertex_of[index] = draw.vertex_count++;
        frame.vertices.push_back(to_clip(view, mesh.positions[index], name));
      }
      frame.indices.push_back(vertex_of[index]);
    }
    frame.commands.push_back(draw);
  }
  if (mesh.attributes != nullptr) {
    frame.attributes = std::make_shared<const FrameAttributes>(
        FrameAttributes{.mesh = mesh.attributes, .from_clip = glm::inverse(view.from_eye)});
  }
  validate(frame);
  return frame;
}

}  // namespace halfspace
