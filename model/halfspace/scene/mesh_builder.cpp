#include "halfspace/scene/mesh_builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "halfspace/numerics/error.hpp"
#include "halfspace/scene/triangulate.hpp"

namespace halfspace {
namespace {

/// Memory for `more` more; at least doubled, so that many calls do not copy again and again.
template <typename T>
void reserve_more(std::vector<T>& list, std::uint64_t more) {
  const std::uint64_t size = list.size() + more;
  if (size > list.capacity()) list.reserve(std::max<std::uint64_t>(size, 2 * list.capacity()));
}

}  // namespace

void MeshBuilder::check_room(std::uint64_t more_vertices, std::uint64_t more_triangles) const {
  const auto check = [&](std::string_view what, std::uint64_t have, std::uint64_t more, std::uint64_t most) {
    if (more > most - have) {
      throw InputError(
          fmt::format("{}: mesh has {} {} or more; legal: at most {}", name_, have + more, what, most));
    }
  };
  check("vertices", mesh_.positions.size(), more_vertices, kMaxMeshVertices);
  const std::uint64_t indices = mesh_.indices.size() + lines_.size() + strips_.size() + points_.size();
  check("triangles", indices / 3, more_triangles, kMaxMeshTriangles);
}

void MeshBuilder::reserve_vertices(std::uint64_t count) {
  check_room(count, 0);
  reserve_more(mesh_.positions, count);
}

void MeshBuilder::reserve_triangles(std::uint64_t count) {
  reserve_more(mesh_.indices, std::min(3 * count, 3 * kMaxMeshTriangles - mesh_.indices.size()));
}

void MeshBuilder::add_vertex(glm::dvec3 position) {
  if (mesh_.positions.size() == kMaxMeshVertices) check_room(1, 0);
  if (!is_finite(position)) ++not_finite_;
  mesh_.positions.push_back(position);
}

bool MeshBuilder::check_face(std::span<const std::uint32_t> corners) {
  if (corners.size() < 3) {
    leave_out("faces with fewer than three corners");
    return false;
  }
  if (!check_finite(corners, "faces with a vertex that is not finite")) return false;
  check_room(0, corners.size() - 2);
  return true;
}

void MeshBuilder::refuse_concave(std::size_t corners) const {
  throw InputError(fmt::format("{}: a face that is not convex has {} corners; legal: at most {}", name_,
                               corners, kMaxConcaveCorners));
}

void MeshBuilder::add_face(std::span<const std::uint32_t> corners) {
  if (!check_face(corners)) return;
  if (corners.size() == 3) {
    for (const std::uint32_t corner : corners) mesh_.indices.push_back(corner);
    return;
  }
  reserve_triangles(corners.size() - 2);
  if (!triangulate(corners, mesh_.positions, mesh_.indices)) refuse_concave(corners.size());
}

void MeshBuilder::add_face(std::span<const std::uint32_t> corners, std::vector<std::uint32_t>& order) {
  order.clear();
  if (!check_face(corners)) return;
  // By its places, which triangulate() sees as it sees the vertices: only positions count.
  std::vector<glm::dvec3> positions;
  std::vector<std::uint32_t> places;
  positions.reserve(corners.size());
  places.reserve(corners.size());
  order.reserve(3 * (corners.size() - 2));
  for (std::uint32_t place = 0; place < corners.size(); ++place) {
    positions.push_back(mesh_.positions[corners[place]]);
    places.push_back(place);
  }
  if (!triangulate(places, positions, order)) refuse_concave(corners.size());
  reserve_triangles(corners.size() - 2);
  for (const std::uint32_t place : order) mesh_.indices.push_back(corners[place]);
}

bool MeshBuilder::check_finite(std::span<const std::uint32_t> vertices, std::string_view what) {
  const bool finite = not_finite_ == 0 || std::ranges::all_of(vertices, [&](std::uint32_t vertex) {
                        return is_finite(mesh_.positions[vertex]);
                      });
  if (!finite) leave_out(what);
  return finite;
}

void MeshBuilder::add_line_strip(std::span<const std::uint32_t> vertices, bool closed) {
  if (vertices.size() < 2) {
    leave_out("lines with fewer than two vertices");
    return;
  }
  check_room(0, vertices.size());
  const std::size_t count = vertices.size() - (closed ? 0 : 1);
  for (std::size_t i = 0; i < count; ++i) {
    const std::array<std::uint32_t, 2> line{vertices[i], vertices[(i + 1) % vertices.size()]};
    if (check_finite(line, "lines with a vertex that is not finite")) {
      strips_.insert(strips_.end(), line.begin(), line.end());
    }
  }
}

void MeshBuilder::add_line(std::uint32_t start, std::uint32_t end) {
  check_room(0, 1);
  const std::array<std::uint32_t, 2> line{start, end};
  if (check_finite(line, "lines with a vertex that is not finite")) {
    lines_.insert(lines_.end(), line.begin(), line.end());
  }
}

void MeshBuilder::add_point(std::uint32_t vertex) {
  check_room(0, 1);
  if (check_finite({&vertex, 1}, "points that are not finite")) points_.push_back(vertex);
}

void MeshBuilder::end_part(const std::string& part_name, Primitive primitive,
                           std::vector<std::uint32_t>& indices) {
  if (indices.empty()) return;
  const auto begin = static_cast<std::uint32_t>(mesh_.indices.size());
  mesh_.indices.insert(mesh_.indices.end(), indices.begin(), indices.end());
  mesh_.parts.push_back({part_name, begin, static_cast<std::uint32_t>(indices.size()), primitive});
  indices.clear();
}

void MeshBuilder::end_part(const std::string& part_name) {
  const auto end = static_cast<std::uint32_t>(mesh_.indices.size());
  const std::uint32_t begin =
      mesh_.parts.empty() ? 0 : mesh_.parts.back().first_index + mesh_.parts.back().index_count;
  if (begin != end) mesh_.parts.push_back({part_name, begin, end - begin});
  end_part(part_name, Primitive::kLines, lines_);
  end_part(part_name, Primitive::kLineStrip, strips_);
  end_part(part_name, Primitive::kPoints, points_);
}

void MeshBuilder::leave_out(std::string_view what, std::uint64_t count) {
  if (count == 0) return;
  const auto found = left_out_.find(what);
  if (found == left_out_.end()) {
    left_out_.emplace(what, count);
  } else {
    found->second += count;
  }
}

Mesh MeshBuilder::finish() && {
  leave_out("vertices that are not finite", not_finite_);
  for (const auto& [what, count] : left_out_) mesh_.left_out.push_back(fmt::format("{} ({})", what, count));
  if (mesh_.indices.empty()) {
    std::string also;
    for (const std::string& text : mesh_.left_out)
      also += fmt::format("{} {}", also.empty() ? ", without" : ",", text);
    throw InputError(
        fmt::format("{}: mesh has {} vertices and 0 triangles{}; legal: 1 triangle, line or point or more",
                    name_, mesh_.positions.size(), also));
  }
  return std::move(mesh_);
}

}  // namespace halfspace
