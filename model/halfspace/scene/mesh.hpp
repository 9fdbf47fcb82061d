/// Meshes of triangles, lines and points, from OBJ, PLY and glTF files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "halfspace/numerics/line_rule.hpp"

namespace halfspace {

inline constexpr std::uint64_t kMaxMeshVertices = std::uint64_t{1} << 25;
inline constexpr std::uint64_t kMaxMeshTriangles = std::uint64_t{1} << 25;

struct MeshAttributes;

/// A run of a mesh's indices: one material or primitive, drawn by one draw.
struct MeshPart {
  std::string name;
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;  ///< a multiple of the primitive's, above 0
  Primitive primitive = Primitive::kTriangles;
};

/// A camera that stands in the mesh's file: it looks along its own -z, with y up.
struct MeshCamera {
  std::string name;
  glm::dmat4 world{1};           ///< its own space to that of the mesh
  std::optional<double> fov_y;   ///< radians; none: a parallel projection
  std::optional<double> aspect;  ///< width / height, of a perspective; none: the picture's
  glm::dvec2 half_size{1};       ///< of a parallel projection, in its own units
  double near = 0;               ///< above 0 for a perspective
  std::optional<double> far;     ///< none: infinite
};

/// Positions in the file's own units, y up; three indices a triangle, two a line, one a point; the parts
/// cover the indices in order.
struct Mesh {
  std::vector<glm::dvec3> positions;
  std::vector<std::uint32_t> indices;  ///< below positions.size()
  std::vector<MeshPart> parts;
  std::vector<MeshCamera> cameras;
  std::vector<std::string> left_out;  ///< what of the file is not in the mesh: "free-form curves (3)"
  /// Colours, texture coordinates, normals and materials; null where none are there or none were asked for.
  std::shared_ptr<const MeshAttributes> attributes;
};

/// What of a file is read.
enum class MeshContent { kGeometry, kAttributes };  ///< triangles alone; the attributes of their corners, too

/// All three coordinates.
[[nodiscard]] bool is_finite(glm::dvec3 position);

/// The mesh in an .obj, .ply, .gltf or .glb file (by extension, as load() takes it; its bytes may be packed
/// by gzip or xz). Polygons are triangulated; a glTF scene's instances are written out. Materials, images and
/// all vertex attributes but the position are passed over unless `content` wants them; whatever else of the
/// file is not in the mesh is listed in `left_out`. Other files are only from the mesh's own folder or below;
/// without attributes none but the buffers of a glTF file. Throws InputError when the file cannot be read, is
/// damaged or contradicts itself, has no triangle, line or point, or has more than
/// kMaxMeshVertices positions or kMaxMeshTriangles of these.
[[nodiscard]] Mesh read_mesh(const std::filesystem::path& path, MeshContent content = MeshContent::kGeometry);

}  // namespace halfspace
