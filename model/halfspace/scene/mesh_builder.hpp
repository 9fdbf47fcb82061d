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

  /// Lines from each vertex to the next, each below vertex_count(); `closed`: and from the last to the first.
  /// Fewer than two vertices are left out and counted. Lines of a strip share their stipple.
  void add_line_strip(std::span<const std::uint32_t> vertices, bool closed = false);
  void add_line(std::uint32_t start, std::uint32_t end);
  void add_point(std::uint32_t vertex);

  /// Ends a draw: all faces since the last part, if there are any; lines and points are draws of their own
  /// behind it.
  void end_part(const std::string& part_name);

  [[nodiscard]] std::size_t part_count() const { return mesh_.parts.size(); }
  [[nodiscard]] std::size_t index_count() const { return mesh_.indices.size(); }

  /// So many of `what`, a plural for people, are not in the mesh.
  void leave_out(std::string_view what, std::uint64_t count = 1);

  void add_camera(MeshCamera camera) { mesh_.cameras.push_back(std::move(camera)); }

  /// Throws InputError when there is no triangle, line or point.
  [[nodiscard]] Mesh finish() &&;

 private:
  /// Whether all are; where not, `what` is left out.
  bool check_finite(std::span<const std::uint32_t> vertices, std::string_view what);
  void end_part(const std::string& part_name, Primitive primitive, std::vector<std::uint32_t>& indices);
  /// Whether a face becomes triangles; else it is counted.
  bool check_face(std::span<const std::uint32_t> corners);
  [[noreturn]] void refuse_concave(std::size_t corners) const;

  std::string_view name_;
  Mesh mesh_;
  std::vector<std::uint32_t> lines_;   ///< since the last part: two indices each
  std::vector<std::uint32_t> strips_;  ///< the same, of strips
  std::vector<std::uint32_t> points_;
  std::uint64_t not_finite_ = 0;  ///< vertices
  std::map<std::string, std::uint64_t, std::less<>> left_out_;
};

}  // namespace halfspace
