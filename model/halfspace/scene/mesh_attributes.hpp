/// What the corners of a mesh's triangles have beside their positions: for pictures alone.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "halfspace/scene/image.hpp"

namespace halfspace {

struct Mesh;

inline constexpr std::uint32_t kNoAttribute = 0xFFFFFFFFu;

/// What a coordinate outside [0, 1] of a texture means.
enum class Wrap : std::uint8_t { kRepeat, kMirror, kClamp };

struct Texture {
  std::uint32_t image = 0;
  Wrap wrap_u = Wrap::kRepeat;
  Wrap wrap_v = Wrap::kRepeat;
};

struct Material {
  glm::vec4 base_color{1};  ///< light, not as sRGB stores it
  std::optional<Texture> texture;
};

struct MeshAttributes {
  /// By vertex, or empty; a value that is not finite is none.
  std::vector<glm::vec4> colors;   ///< light
  std::vector<glm::vec2> uvs;      ///< (0, 0) is the upper left corner of an image, v goes down
  std::vector<glm::vec3> normals;  ///< of any length but 0
  /// By corner: its vertex, as Mesh::indices.
  std::vector<std::uint32_t> vertex_of;
  /// By corner: which of `uvs`, of `normals`, or kNoAttribute. Empty: that of its vertex.
  std::vector<std::uint32_t> uv_of;
  std::vector<std::uint32_t> normal_of;
  std::vector<Material> materials;
  std::vector<std::uint32_t> material_of;  ///< by part of the mesh: which of `materials`, or kNoAttribute
  std::vector<Image> images;
};

/// The attributes of a frame that one mesh became: triangle n of the frame is triangle n of the mesh, and the
/// draw that is command n is part n - 1 of the mesh.
struct FrameAttributes {
  std::shared_ptr<const MeshAttributes> mesh;
  glm::dmat4 from_clip{1};  ///< from clip space to the mesh's, less the eye's position
};

/// What a reader collects them with.
class AttributeBuilder {
 public:
  void set_color(std::uint32_t vertex, glm::vec4 color);
  void set_uv(std::uint32_t vertex, glm::vec2 uv);
  void set_normal(std::uint32_t vertex, glm::vec3 normal);

  /// For readers whose corners have attributes of their own: these, and which of them the next corner has.
  void add_uv(glm::vec2 uv) { all_.uvs.push_back(uv); }
  void add_normal(glm::vec3 normal) { all_.normals.push_back(normal); }
  void add_corner(std::uint32_t uv, std::uint32_t normal);
  /// Those up to this number that were not added have neither: they are of lines and points.
  void end_corners(std::size_t corners);
  [[nodiscard]] std::size_t uv_count() const { return all_.uvs.size(); }
  [[nodiscard]] std::size_t normal_count() const { return all_.normals.size(); }

  /// Returns its number.
  std::uint32_t add_material(const Material& material);
  std::uint32_t add_image(Image image);
  /// How many texels more the images may have.
  [[nodiscard]] std::uint64_t texels_left() const { return texels_left_; }

  /// The parts up to this number that have no material so far have this one, or kNoAttribute.
  void end_parts(std::size_t parts, std::uint32_t material) { all_.material_of.resize(parts, material); }

  /// Gives the mesh what was collected, if it is anything that a picture would show.
  void finish(Mesh& mesh) &&;

 private:
  MeshAttributes all_;
  std::uint64_t texels_left_ = kMaxMeshImageTexels;
};

}  // namespace halfspace
