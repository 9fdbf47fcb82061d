/// What every reader of meshes builds with, so that the same fault ends alike in all formats.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/scene/mesh.hpp"

namespace halfspace {

class MeshBuilder {
 public:
  /// `name` stands in front of errors.
  explicit MeshBuilder(std::string_view name) : name_(name) {}

  /// Throws InputError unless so many more are legal: for readers that know before they read.
  void check_room(std::uint64_t more_vertices, std::uint64_t more_triangles) const;
  void reserve_vertices(std::uint64_t count);
  /// Memory for so many triangles, or fewer where so many are not legal.
  void reserve_triangles(std::uint64_t count);

  /// A vertex that is not finite is counted, as is every face that has it; they are left out.
  void add_vertex(glm::dvec3 position);
  [[nodiscard]] std::uint32_t vertex_count() const {
    return static_cast<std::uint32_t>(mesh_.positions.size());
  }

  /// A face of these vertices, each below vertex_count(), is cut into triangles. One of fewer than three
  /// corners is left out and counted.
  void add_face(std::span<const std::uint32_t> corners);
  /// The same. `order` becomes the corners of its triangles, three each, as places in `corners`.
  void add_face(std::span<const std::uint32_t> corners, std::vector<std::uint32_t>& order);

  /// Ends a draw: all faces since the last part, if there are any.
  void end_part(std::string part_name);

  [[nodiscard]] std::size_t part_count() const { return mesh_.parts.size(); }

  /// So many of `what`, a plural for people, are not in the mesh.
  void leave_out(std::string_view what, std::uint64_t count = 1);

  void add_camera(MeshCamera camera) { mesh_.cameras.push_back(std::move(camera)); }

  /// Throws InputError when there is no triangle.
  [[nodiscard]] Mesh finish() &&;

 private:
  /// Whether a face becomes triangles; else it is counted.
  bool check_face(std::span<const std::uint32_t> corners);
  [[noreturn]] void refuse_concave(std::size_t corners) const;

  std::string_view name_;
  Mesh mesh_;
  std::uint64_t not_finite_ = 0;  ///< vertices
  std::map<std::string, std::uint64_t, std::less<>> left_out_;
};

}  // namespace halfspace
